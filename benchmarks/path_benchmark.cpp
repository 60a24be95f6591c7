// Pictures by method path against their bound: the ray caster's packets on the rays of such paths, which are
// ready in memory and of which nothing is made. One thread, processor time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <vector>

#include "estimators/estimator_list.h"
#include "materials/diffuse.h"
#include "rooms.h"
#include "transport/light_sampler.h"
#include "transport/weights.h"

namespace stilb {
namespace {

constexpr int kPixels = 256;  ///< along an edge of the picture
constexpr int kRepetitions = 7;
constexpr int kReflections = 1000;

/// 3 x 3 x 3 m with two boxes and a panel under the ceiling; everything reflects half of the light.
Scene make_boxes() {
    Scene scene;
    scene.name = "room with boxes";
    scene.materials.push_back({"wall", Diffuse{Rgb::grey(0.5)}});
    const auto add = [&](const char* name, const Shape& shape) {
        scene.objects.push_back({name, shape, {MaterialId{0}}});
    };
    add("room", Box{{0, 0, 0}, {3, 3, 3}});
    add("tall", Box{{0.5, 1.7, 0}, {1.2, 2.4, 1.6}});
    add("low", Box{{1.7, 0.9, 0}, {2.5, 1.7, 0.8}});
    add("panel", Rectangle{{1.2, 1.2, 2.99}, {0, 0.6, 0}, {0.6, 0, 0}});
    scene.lights.push_back({"panel", AreaLight{ObjectId{3}, Rgb::grey(2600)}});
    return scene;
}

Camera make_camera() {
    Camera camera;
    camera.position = {1.5, 0.05, 1.5};
    camera.target = {1.5, 3, 1.3};
    camera.fov_deg = 80;
    camera.resolution = {kPixels, kPixels};
    return camera;
}

double processor_s() {
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Packets of sixteen: rays to next hits, and segments to lights.
struct PreparedRays {
    std::vector<rays::RayHitPacket> camera, reflected;
    std::vector<RayPacket> first_segments, segments;

    void add(std::vector<rays::RayHitPacket>& packets, std::size_t& count, const rays::Ray& ray,
             const Vec3& center) {
        const std::size_t lane = count++ % kPacketWidth;
        if (lane == 0) packets.emplace_back();
        packets.back().ray.set(lane, ray.origin - center, ray.direction,
                               std::numeric_limits<float>::infinity());
    }
    void add(std::vector<RayPacket>& packets, std::size_t& count, const rays::Segment& segment,
             const Vec3& center) {
        const std::size_t lane = count++ % kPacketWidth;
        if (lane == 0) packets.emplace_back();
        packets.back().set(lane, segment.from - center, segment.to - segment.from, 1);
    }
};

/// The rays of one pass, by a plain walk; round after round, as the method has them.
PreparedRays prepare_rays(const Scene& scene, const rays::RayCaster& caster) {
    struct Walk {
        rays::Ray ray;
        Rgb throughput = Rgb::grey(1);
    };
    const transport::LightSampler lights(scene, caster);
    const sensors::CameraView view(make_camera());
    const Rgb reflectance = scene.materials.front().material.get_if<Diffuse>()->reflectance;
    math::SampleStream stream(math::RandomKey{5}, 0, 0);
    PreparedRays prepared;
    std::size_t camera = 0, reflected = 0, first_segments = 0, segments = 0;
    for (int y = 0; y < kPixels; ++y) {
        for (int left = 0; left < kPixels; left += 256) {
            std::vector<Walk> walks;
            for (int x = left; x < left + 256; ++x)
                walks.push_back({{view.position(), *view.direction_at(x + 0.5, y + 0.5)}});
            for (bool is_first = true; !walks.empty(); is_first = false) {
                std::vector<Walk> next;
                for (const Walk& walk : walks) {
                    if (is_first) {
                        prepared.add(prepared.camera, camera, walk.ray, caster.center());
                    } else {
                        prepared.add(prepared.reflected, reflected, walk.ray, caster.center());
                    }
                    const auto hit = caster.closest(walk.ray.origin, walk.ray.direction);
                    if (!hit) continue;
                    const auto light = lights.sample_one_light(*hit, stream);
                    if (light && dot(light->direction, hit->normal) > 0) {
                        prepared.add(is_first ? prepared.first_segments : prepared.segments,
                                     is_first ? first_segments : segments, {hit->lifted, light->source_point},
                                     caster.center());
                    }
                    const double survival =
                        transport::patient_survival_probability(walk.throughput, reflectance);
                    if (stream.next() >= survival) continue;
                    const auto [u1, u2] = stream.next_two();
                    const Vec3 direction =
                        Frame::around(hit->normal).to_world(math::sample_cosine_hemisphere(u1, u2).direction);
                    next.push_back(
                        {{hit->lifted, direction}, walk.throughput * reflectance * (1 / survival)});
                }
                walks = std::move(next);
            }
        }
    }
    return prepared;
}

void trace(std::vector<rays::RayHitPacket>& packets, rays::Coherence coherence,
           const rays::RayCaster& caster) {
    LaneMask all;
    all.fill(-1);
    for (rays::RayHitPacket& packet : packets) {
        packet.ray.end.fill(std::numeric_limits<float>::infinity());
        caster.closest(packet, all, coherence);
    }
}

void trace(std::vector<RayPacket>& packets, rays::Coherence coherence, const rays::RayCaster& caster) {
    LaneMask all;
    all.fill(-1);
    for (RayPacket& packet : packets) {
        packet.end.fill(1);
        caster.occlude(packet, all, coherence);
    }
}

void compare(const Scene& scene) {
    const rays::RayCaster caster(scene);
    const estimators::Problem problem{.scene = scene,
                                      .caster = caster,
                                      .max_reflections = kReflections,
                                      .preparation_key = {},
                                      .camera = make_camera()};
    const auto estimator = estimators::make_path(problem);
    const auto blocks = estimators::blocks_of({kPixels, kPixels});
    PreparedRays prepared = prepare_rays(scene, caster);
    double best_path_s = std::numeric_limits<double>::infinity(), best_bare_s = best_path_s;
    for (int repetition = 0; repetition < kRepetitions; ++repetition) {
        double start = processor_s();
        const auto pass = estimator->start({math::RandomKey{1}, static_cast<std::uint64_t>(repetition)});
        for (const estimators::PixelBlock& block : blocks) {
            estimators::Tally pixels(block.pixels());
            pass->sample(block, pixels);
        }
        best_path_s = std::min(best_path_s, processor_s() - start);
        start = processor_s();
        trace(prepared.camera, rays::Coherence::coherent, caster);
        trace(prepared.first_segments, rays::Coherence::coherent, caster);
        trace(prepared.reflected, rays::Coherence::scattered, caster);
        trace(prepared.segments, rays::Coherence::scattered, caster);
        best_bare_s = std::min(best_bare_s, processor_s() - start);
    }
    const double million = 1e-6 * kPixels * kPixels;
    fmt::print("{:18} {:10.2f} {:10.2f} {:8.2f}\n", scene.name, million / best_path_s, million / best_bare_s,
               best_bare_s / best_path_s);
}

}  // namespace
}  // namespace stilb

int main() {
    fmt::print("Pictures by path, one thread, best of 7   [million samples / s]\n{:18} {:>10} {:>10} {:>8}\n",
               "", "path", "bare", "ratio");
    stilb::compare(stilb::make_boxes());
    stilb::compare(stilb::make_room(30));
}
