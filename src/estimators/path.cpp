// Path tracing from every measuring point, with next-event estimation: the naive twin of local estimation.
//
//   E(x) = E_direct + integral over the hemisphere of L_r(y, y->x) cos(theta_x) dw        (theory 2, T.1b
//   with k = 0)
//
// by one cosine-distributed ray and the path that it begins, for each sample and point by itself. Finite
// variance for bounded BRDFs. Not made: light that leaves a point-like source and meets a mirror before
// anything else.
#include "estimators/path.h"

#include <numbers>

#include "base/sampling.h"
#include "estimators/direct_light.h"
#include "estimators/limits.h"
#include "estimators/packed_points.h"
#include "estimators/path_tracer.h"

namespace stilb {
namespace {

class PathEstimator final : public Estimator {
  public:
    explicit PathEstimator(const EstimatorInput& input)
        : scene_(input.scene),
          caster_(input.caster),
          points_(packed(input.measurands, caster_)),
          max_reflections_(input.max_reflections),
          lights_(scene_, caster_),
          tracer_(scene_, caster_, lights_),
          known_part_lx_(direct_from_points_lx(points_, caster_, lights_)) {}

    void run_batch(const Batch& batch, ReadingSums& sums) const override {
        for (const PackedPoint& point : points_) {
            const RandomKey key = batch.key.derived(point.reading);
            for (std::uint64_t i = batch.first; i < batch.first + batch.count; ++i) {
                SampleStream stream(key, i);
                const Spectrum direct = sample_direct_from_areas_lx(point, caster_, lights_, stream);
                sums.add(point.reading, direct + sample_reflected_lx(point, stream));
            }
        }
    }

    std::span<const Spectrum> known_part_lx() const override { return known_part_lx_; }
    /// Enough for a first look at the error not to miss what few paths find.
    std::uint64_t batch_granularity() const override { return 64; }
    double rays_per_sample() const override { return 10.0 * static_cast<double>(points_.size()); }
    std::vector<std::string> warnings() const override {
        return mirror_warnings(scene_,
                               "path tracing cannot make light that leaves a point or photometry light and "
                               "meets a mirror before anything else");
    }

  private:
    Spectrum sample_reflected_lx(const PackedPoint& point, SampleStream& stream) const {
        const auto [u1, u2] = stream.next_two();
        const Vec3 direction =
            Frame::around(point.normal).to_world(sample_cosine_hemisphere(u1, u2).direction);
        const auto hit = caster_.closest(point.lifted, direction);
        if (!hit) return {};
        return std::numbers::pi * tracer_.luminance_without_direct(*hit, direction, max_reflections_, stream);
    }

    const Scene& scene_;
    const RayCaster& caster_;
    PackedPoints points_;
    int max_reflections_;
    LightSampler lights_;
    PathTracer tracer_;
    std::vector<Spectrum> known_part_lx_;
};

}  // namespace

std::unique_ptr<Estimator> make_path_estimator(const EstimatorInput& input) {
    return std::make_unique<PathEstimator>(input);
}

}  // namespace stilb
