
#include "estimators/patch_light/first_shot/shadow_rays.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <functional>

#include "base/parallel.h"

namespace stilb::estimators {

namespace {

/// A different key for every position of every side.
math::RandomKey key_at(math::RandomKey key, std::uint32_t side, const Vec3& position) {
    key = key.derived(side);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        key = key.derived(std::bit_cast<std::uint64_t>(position[axis]));
    }
    return key;
}

}  // namespace

Vec3 lifted_off(const Scene& scene, const patches::Patches& patches, const rays::RayCaster& caster,
                std::uint32_t side, const Vec3& position) {
    Vec3 normal = patches.normal_of(side), start = position;
    const ObjectId object = patches.object_of(patches.patch_of(side));
    if (const auto* sphere = std::get_if<Sphere>(&scene.object(object).shape)) {
        const Vec3 outwards = normalized(position - sphere->center);
        start = sphere->center + sphere->radius * outwards;
        normal = patches.is_front(side) ? outwards : -outwards;
    }
    if (const auto* harmonics = std::get_if<Harmonics>(&scene.object(object).shape)) {
        const Vec3 direction = position - harmonics->center, outwards = harmonics->normal_towards(direction);
        start = harmonics->point_towards(direction);
        normal = patches.is_front(side) ? outwards : -outwards;
    }
    return start + caster.offset_m(start, caster.lift().largest_size_m()) * normal;
}

void ShadowRays::add_reflected_by(const Material& material, std::uint32_t side, const Vec3& position,
                                  math::RandomKey key, std::span<const Vec3> outs,
                                  std::span<Rgb> sums) const {
    if (reflects_nothing(material)) return;
    const Frame frame = frame_of(patches_, side);
    const SurfacePoint at{position, frame.w, lifted_off(scene_, patches_, caster_, side, position)};
    const math::RandomKey key_here = key_at(key, side, position);
    const auto for_each_arrival = [&](const auto& visit) {
        for (std::size_t i = 0; i < lights_.lights.size(); ++i) {
            const std::size_t points = lights_.lights[i].samples;
            for (std::size_t k = 0; k < points; ++k) {
                const auto light = sampler_.sample_incident(
                    i, {position}, math::SampleStream(key_here.derived(i), k).next_two());
                const auto sample = transport::direct_sample(light, at);
                if (!sample) continue;
                visit(light->direction, sample->illuminance_lx * caster_.transmittance(sample->segment) *
                                            (1 / static_cast<double>(points)));
            }
        }
    };
    reflect(material, frame, for_each_arrival, outs, sums);
}

namespace {

/// Tests visibility from the sides' middles.
class LineOfSightFollower {
  public:
    LineOfSightFollower(const Scene& scene, const rays::RayCaster& caster, const patches::Patches& patches,
                        std::span<const LightSample> samples, const FirstShotFactors& factors,
                        double small_sr)
        : scene_(scene),
          caster_(caster),
          patches_(patches),
          samples_(samples),
          factors_(factors),
          small_sr_(small_sr) {}

    std::size_t missed(std::uint32_t side) const {
        const auto seen = factors_.of(side);
        auto next = seen.begin();
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < samples_.size(); ++i) {
            if (next != seen.end() && next->sample == i) {
                ++next;
            } else if (is_small_and_lit(side, samples_[i])) {
                ++count;
            }
        }
        return count;
    }

  private:
    bool is_small_and_lit(std::uint32_t side, const LightSample& sample) const {
        const std::uint32_t patch = patches_.patch_of(side);
        const Vec3 middle = patches_.middle(patch), offset = middle - sample.viewpoint.position;
        const double squared = squared_length(offset), distance = std::sqrt(squared);
        const double cosine = -dot(offset, patches_.normal_of(side)) / distance;
        if (!(cosine > 0) || patches_.areas_m2[patch] * cosine > small_sr_ * squared) return false;
        const Vec3 local = sample.viewpoint.frame.to_local(offset / distance);
        if (!(sample.intensity_cd({local, 0, local.z}) > 0)) return false;
        return !caster_.occluded(lifted_off(scene_, patches_, caster_, side, middle),
                                 sample.viewpoint.position);
    }

    const Scene& scene_;
    const rays::RayCaster& caster_;
    const patches::Patches& patches_;
    std::span<const LightSample> samples_;
    const FirstShotFactors& factors_;
    double small_sr_;
};

}  // namespace

std::size_t count_missed(const Scene& scene, const rays::RayCaster& caster, const patches::Patches& patches,
                         std::span<const LightSample> samples, const FirstShotFactors& factors,
                         int resolution, const Monitor& monitor) {
    // The pixel size in the middle of a cube's face, where pixels are largest.
    const double small_sr = 16. / (static_cast<double>(resolution) * resolution);
    const LineOfSightFollower follower(scene, caster, patches, samples, factors, small_sr);
    const std::size_t sides = 2 * patches.count(), step = 1 + sides * samples.size() / kMostPairs;
    constexpr std::size_t chunk = 256;
    std::atomic<std::size_t> count = 0;
    parallel_for((sides + chunk - 1) / chunk, [&](std::size_t number) {
        const std::size_t begin = number * chunk, end = std::min(begin + chunk, sides);
        monitor.report("first shot: sides without pixels",
                       static_cast<double>(begin) / static_cast<double>(sides));
        for (std::size_t side = (begin + step - 1) / step * step; side < end; side += step)
            count += follower.missed(static_cast<std::uint32_t>(side));
    });
    return step * count;
}

}  // namespace stilb::estimators
