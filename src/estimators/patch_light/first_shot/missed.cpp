#include "estimators/patch_light/first_shot/missed.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>

#include "estimators/patch_light/first_shot/shadow_rays.h"

namespace stilb::estimators {
namespace {

/// Looks from the sides' middles.
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
        const Vec3 middle = patches_.middle(patch), way = middle - sample.viewpoint.position;
        const double squared = squared_length(way), distance = std::sqrt(squared);
        const double cosine = -dot(way, patches_.normal_of(side)) / distance;
        if (!(cosine > 0) || patches_.areas_m2[patch] * cosine > small_sr_ * squared) return false;
        const Vec3 local = sample.viewpoint.frame.to_local(way / distance);
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
    // Of four pixels in the middle of a cube's face, where they are largest.
    const double small_sr = 16. / (static_cast<double>(resolution) * resolution);
    const LineOfSightFollower follower(scene, caster, patches, samples, factors, small_sr);
    using Range = tbb::blocked_range<std::uint32_t>;
    return tbb::parallel_reduce(
        Range(0, static_cast<std::uint32_t>(2 * patches.count())), std::size_t{0},
        [&](const Range& sides, std::size_t count) {
            monitor.report("first shot: sides without pixels",
                           static_cast<double>(sides.begin()) / static_cast<double>(2 * patches.count()));
            for (std::uint32_t side = sides.begin(); side != sides.end(); ++side)
                count += follower.missed(side);
            return count;
        },
        std::plus<>());
}

}  // namespace stilb::estimators
