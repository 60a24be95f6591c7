// Path tracing from every measuring point, with next-event estimation: the naive twin of local estimation.
//
//   E(x) = E_direct + integral over the hemisphere of L_r(y, y->x) cos(theta_x) dw        (theory 2, T.1b
//   with k = 0)
//
// by one cosine-distributed ray and the path that it begins, for each sample and point by itself. Finite
// variance for bounded BRDFs. Not made: light that leaves a point-like source and meets a mirror before
// anything else.
#include "estimators/path.h"

#include <cmath>

#include "estimators/direct_light.h"
#include "estimators/gather.h"
#include "estimators/limits.h"

namespace stilb {
namespace {

class PathEstimator final : public Estimator {
  public:
    explicit PathEstimator(const EstimatorInput& input)
        : scene_(input.scene),
          caster_(input.caster),
          points_(input.points.begin(), input.points.end()),
          max_reflections_(input.max_reflections),
          lights_(scene_, caster_),
          tracer_(scene_, caster_, lights_) {
        for (const MeasuringPoint& point : points_) {
            known_part_lx_.push_back(direct_from_points_lx(point, caster_, lights_));
        }
    }

    void run_batch(const Batch& batch, ReadingSums& sums) const override {
        for (std::size_t j = 0; j < points_.size(); ++j) {
            const RandomKey key = batch.key.derived(j);
            for (std::uint64_t i = batch.first; i < batch.first + batch.count; ++i) {
                SampleStream stream(key, i);
                const Spectrum direct = sample_direct_from_areas_lx(points_[j], caster_, lights_, stream);
                const Spectrum sample =
                    direct + sample_gathered_lx(points_[j], 0, max_reflections_, caster_, tracer_, stream);
                sums.add(j, sample);
            }
        }
    }

    std::span<const Spectrum> known_part_lx() const override { return known_part_lx_; }
    std::uint64_t batch_granularity() const override { return 1; }
    double rays_per_sample() const override { return 10.0 * static_cast<double>(points_.size()); }
    std::vector<std::string> warnings() const override {
        return mirror_warnings(scene_,
                               "path tracing cannot make light that leaves a point or photometry light and "
                               "meets a mirror before anything else");
    }

  private:
    const Scene& scene_;
    const RayCaster& caster_;
    std::vector<MeasuringPoint> points_;
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
