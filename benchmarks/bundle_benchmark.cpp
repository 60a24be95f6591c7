// Bundles against their bound: bare rtcIntersect16 loops over the same rays, which are ready in memory and of
// which nothing is made. Once for what each ray meets first, and once for all that it meets, by starting anew
// behind every hit until all rays have left. One thread; OpenGL with whatever its driver takes.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "best_time.h"
#include "patches/visibility/bundle.h"
#include "patches/visibility/opengl.h"
#include "rooms.h"
#include "stilb/error.h"

namespace stilb {
namespace {

constexpr int kRepetitions = 5;
constexpr int kTile = 4;

/// The patches as Embree has them in PatchCaster, built here once more so that the loops see nothing of
/// Stilb.
class BareScene {
  public:
    explicit BareScene(const patches::Patches& patches)
        : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                 sizeof(patches::Float3), patches.vertices.size());
        std::ranges::copy(patches.vertices, static_cast<patches::Float3*>(vertices));
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   patches.corners.data(), 0, sizeof(Triangle), patches.count());
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    ~BareScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    BareScene(const BareScene&) = delete;
    BareScene& operator=(const BareScene&) = delete;

    /// Of the lanes that are set, those that met something.
    LaneMask intersect(RTCRayHit16& rays, const LaneMask& lanes) const {
        std::ranges::fill(rays.hit.geomID, RTC_INVALID_GEOMETRY_ID);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        rtcIntersect16(lanes.data(), scene_, &context, &rays);
        LaneMask met;
        for (int i = 0; i < kPacketWidth; ++i) {
            met[i] = lanes[i] != 0 && rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID ? -1 : 0;
        }
        return met;
    }

  private:
    RTCDevice device_;
    RTCScene scene_;
};

/// Whole tiles only; at the rims of the grid rays are missing then.
std::vector<RayPacket> packets_of(const patches::LineGrid& grid, const Vec3& direction) {
    std::vector<RayPacket> packets;
    for (int y = 0; y + kTile <= grid.height; y += kTile) {
        for (int x = 0; x + kTile <= grid.width; x += kTile) {
            RayPacket& rays = packets.emplace_back();
            for (int lane = 0; lane < kPacketWidth; ++lane) {
                const Vec3 from = grid.origin(x + lane % kTile, y + lane / kTile);
                rays.origin_x[lane] = static_cast<float>(from.x);
                rays.origin_y[lane] = static_cast<float>(from.y);
                rays.origin_z[lane] = static_cast<float>(from.z);
            }
            rays.direction_x.fill(static_cast<float>(direction.x));
            rays.direction_y.fill(static_cast<float>(direction.y));
            rays.direction_z.fill(static_cast<float>(direction.z));
            rays.end.fill(std::numeric_limits<float>::infinity());
        }
    }
    return packets;
}

struct Measured {
    std::size_t crossings = 0;
    double time_s = 0;

    double per_second() const { return static_cast<double>(crossings) / time_s; }
};

/// Times `work`, which returns a number of crossings.
template <typename Work>
Measured measured(const Work& work) {
    Measured result;
    result.time_s = best_time_s(kRepetitions, [&] { result.crossings = work(); });
    return result;
}

std::size_t count_of(const LaneMask& lanes) {
    return static_cast<std::size_t>(std::ranges::count(lanes, -1));
}

constexpr auto kAllLanes = [] {
    LaneMask lanes;
    lanes.fill(-1);
    return lanes;
}();

Measured bare_first_hits(const BareScene& scene, const std::vector<RayPacket>& packets) {
    return measured([&] {
        std::size_t hits = 0;
        for (const RayPacket& packet : packets) {
            RTCRayHit16 rays;
            std::memcpy(&rays.ray, &packet, sizeof packet);
            hits += count_of(scene.intersect(rays, kAllLanes));
        }
        return hits;
    });
}

Measured bare_all_hits(const BareScene& scene, const std::vector<RayPacket>& packets) {
    constexpr float step_m = 4e-6F;
    return measured([&] {
        std::size_t hits = 0;
        for (const RayPacket& packet : packets) {
            RTCRayHit16 rays;
            std::memcpy(&rays.ray, &packet, sizeof packet);
            LaneMask lanes = kAllLanes;
            while (count_of(lanes = scene.intersect(rays, lanes)) > 0) {
                hits += count_of(lanes);
                for (int i = 0; i < kPacketWidth; ++i) {
                    rays.ray.tnear[i] = rays.ray.tfar[i] + step_m;
                    rays.ray.tfar[i] = std::numeric_limits<float>::infinity();
                }
            }
        }
        return hits;
    });
}

Measured by(const patches::Bundles& bundles, const patches::Bundle& bundle) {
    return measured([&] {
        std::size_t crossings = 0;
        bundles.cast(bundle, [&](const patches::CrossedLines& lines) {
            for (std::size_t i = 0; i < lines.count(); ++i) crossings += lines.line(i).sides.size();
        });
        return crossings;
    });
}

/// Who draws, or why nobody does.
std::string renderer() {
    try {
        return patches::OpenGlBundles(patches::Patches{}).renderer();
    } catch (const InputError& error) {
        return error.what();
    }
}

/// [ms], or nothing where there is no OpenGL.
std::string opengl_ms(const patches::Patches& patches, const patches::Bundle& bundle) {
    try {
        return fmt::format("{:.1f}", 1e3 * by(patches::OpenGlBundles(patches), bundle).time_s);
    } catch (const InputError&) {
        return "-";
    }
}

void report(const Scene& scene, double count) {
    const patches::Patches patches = patches::make_patches(scene, patches::patch_size_m(scene, count));
    const patches::PatchCaster caster(patches);
    const BareScene bare(patches);
    const patches::Bundle bundle{Frame::around(normalized(Vec3{0.3, -0.5, 0.8})), 6.0 / 800, {0.3, 0.7}};
    const auto packets = packets_of(patches::LineGrid(bounds_of(patches), bundle), bundle.frame.w);
    const Measured first = bare_first_hits(bare, packets), all = bare_all_hits(bare, packets);
    const Measured rays = by(patches::RayBundles(caster), bundle);
    fmt::print("{:10} {:8.1f} {:11.1f} {:11.1f} {:11.1f} {:9.2f} {:9.2f} {:9.1f} {:>9}\n", patches.count(),
               static_cast<double>(all.crossings) / static_cast<double>(first.crossings),
               1e-6 * first.per_second(), 1e-6 * all.per_second(), 1e-6 * rays.per_second(),
               rays.per_second() / first.per_second(), rays.per_second() / all.per_second(),
               1e3 * rays.time_s, opengl_ms(patches, bundle));
}

}  // namespace
}  // namespace stilb

int main() {
    fmt::print(
        "A bundle of 800 x 800 rays or so, best of {}   [million crossings per second; ms]; OpenGL by {}\n",
        stilb::kRepetitions, stilb::renderer());
    fmt::print("{:>10} {:>8} {:>11} {:>11} {:>11} {:>9} {:>9} {:>9} {:>9}\n", "patches", "layers",
               "bare first", "bare all", "bundle", "/first", "/all", "rays", "OpenGL");
    for (const double count : {1e4, 1e5, 1e6}) stilb::report(stilb::make_room(8), count);
    for (const double count : {1e5, 1e6}) stilb::report(stilb::make_room(200), count);
}
