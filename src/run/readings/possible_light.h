// The light that the samples of a reading may all have missed.
#pragma once

#include <cstdint>
#include <vector>

#include "estimators/estimator.h"
#include "sensors/sensor.h"
#include "transport/light_sampler.h"

namespace stilb::run {

/// Keeps references to the scene and to the caster.
class PossibleLight {
  public:
    PossibleLight(const Scene& scene, const rays::RayCaster& caster, int max_reflections,
                  const estimators::Estimator& estimator);

    /// About the light that so many samples of a reading may all have missed, though surfaces reflect it to
    /// the reading [lx or cd/m2]. `largest`: the largest contribution of reflected light that one of them has
    /// found; smaller ones do not count.
    double missed(const Measurand& measurand, double largest, std::uint64_t samples) const;

  private:
    /// A place that a particle of a lamp has met.
    struct Lit {
        SurfacePoint point;
        double reflectance = 0, lx = 0;
        double reflected_lm = 0;  ///< of the particle

        /// The contribution of a sample that meets the place, by a ray that is cosine-distributed.
        double sample_lx() const { return reflectance * lx; }
    };
    void find_lit(const estimators::Estimator& estimator);
    double missed_lx(SurfacePoint at, double largest_lx, std::uint64_t samples) const;
    /// The unshadowed light of all lamps: a sample, and an estimate that is 0 only where there is none.
    double sampled_lx(const SurfacePoint& at, math::SampleStream& stream) const;
    double all_lx(const SurfacePoint& at) const;
    /// For places that a point sees: the cosines over the squared distance [1/m2]; else 0.
    double seen_per_m2(const SurfacePoint& at, const Lit& lit) const;
    /// The mean light that lit places reflect, over those that are seen from there; 0 without any.
    double seen_lx(const SurfacePoint& at) const;
    /// The light of the brightest places that only few of the samples meet.
    double rare_lx(const SurfacePoint& at, double largest_lx, std::uint64_t samples) const;

    const Scene& scene_;
    const rays::RayCaster& caster_;
    transport::LightSampler lights_;
    std::vector<Bounds> reflecting_;  ///< of the objects that reflect light
    std::vector<Lit> lit_;
    std::vector<Lit> met_by_chance_;  ///< of these; the brightest first
};

}  // namespace stilb::run
