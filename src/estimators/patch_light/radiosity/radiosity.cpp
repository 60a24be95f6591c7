// Radiosity for readings and pictures: radiosity_solution.h has how the patches are lit, patch_readings.h
// what is made of it.
//
// Nothing is left to chance, so there are no standard errors. What is wrong is the patches: light that varies
// over one, form factors from its middle. Nobody knows by how much; smaller patches tell.
#include "estimators/patch_light/radiosity/radiosity.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "base/error.h"
#include "estimators/limits.h"
#include "estimators/patch_light/patch_picture.h"
#include "estimators/patch_light/patch_readings.h"
#include "estimators/patch_light/radiosity/radiosity_solution.h"

namespace stilb::estimators {
namespace {

constexpr std::string_view kName = "radiosity";

void require_known_first_shot(const Scene& scene, FirstShotVariant variant) {
    require_first_shot_of_points(scene, variant != FirstShotVariant::none, kName);
    if (variant == FirstShotVariant::on_the_fly) {
        throw InputError(
            "method radiosity cannot do with --first-shot on-the-fly: it needs the light of small lights as "
            "means over patches. Use incoming.");
    }
}

/// The patches and their light.
struct LitPatches {
    LitPatches(const Scene& scene, const rays::RayCaster& caster, const PatchOptions& options,
               int max_reflections)
        : transport(checked(scene, options, max_reflections), caster, options),
          solution(solve_radiosity(transport)) {}

    PatchTransport transport;
    RadiositySolution solution;

  private:
    static const Scene& checked(const Scene& scene, const PatchOptions& options, int max_reflections) {
        require_diffuse(scene, kName);
        require_no_light_from_outside(scene, kName);
        require_all_reflections(max_reflections, kName);
        require_known_first_shot(scene, options.first_shot.variant.value_or(kUsualFirstShot));
        return scene;
    }
};

/// Samples of a point's hemisphere: Sobol' points, the same ones in every run.
constexpr std::uint64_t kBlocks = 32, kSamplesOfABlock = 128;

/// Beside the known part: sums over fixed directions from points, and points on lights.
ReadingSums sum_readings(const PatchReadings& readings, const PatchLight& light) {
    std::vector<ReadingSums> blocks(kBlocks, ReadingSums(readings.known_part().size()));
    tbb::parallel_for(std::uint64_t{0}, kBlocks, [&](std::uint64_t block) {
        for (std::uint64_t i = 0; i < kSamplesOfABlock; ++i) {
            readings.add(light, math::RandomKey{}, block * kSamplesOfABlock + i, blocks[block]);
        }
    });
    ReadingSums sums(readings.known_part().size());
    for (const ReadingSums& block : blocks) {
        for (std::size_t j = 0; j < sums.sum.size(); ++j) sums.sum[j] += block.sum[j];
        sums.invalid += block.invalid;
    }
    return sums;
}

class Radiosity final : public Estimator {
  public:
    explicit Radiosity(const EstimatorInput& input) {
        const LitPatches patches(input.scene, input.caster, input.patches, input.max_reflections);
        const PatchReadings readings(patches.transport, input.measurands);
        const ReadingSums sums = sum_readings(readings, patches.solution.light);
        for (std::size_t j = 0; j < sums.sum.size(); ++j) {
            values_.push_back(readings.known_part()[j] + sums.sum[j] * (1. / (kBlocks * kSamplesOfABlock)));
        }
        invalid_ = sums.invalid;
        rays_ = patches.solution.rays;
        report_ = patches.transport.report();
    }

    void run_batch(const Batch&, ReadingSums& sums) const override {
        sums.rays += rays_;
        sums.invalid += invalid_;
    }
    std::span<const Rgb> known_part() const override { return values_; }
    std::uint64_t batch_granularity() const override { return 1; }
    double rays_per_sample() const override { return 1; }
    std::vector<std::string> warnings() const override { return {}; }
    std::optional<PatchReport> patch_report() const override { return report_; }

  private:
    std::vector<Rgb> values_;
    std::uint64_t invalid_ = 0, rays_ = 0;
    PatchReport report_;
};

class RadiosityPicture final : public PictureEstimator {
  public:
    explicit RadiosityPicture(const PictureInput& input)
        : tracing_(input),
          patches_(input.scene, input.caster, input.patches, input.max_reflections),
          sides_cd_m2_(VisibleSides(patches_.transport, tracing_.view.position())
                           .mean_cd_m2(patches_.solution.light.cd_m2(), 1)) {}

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<PatchPass>(tracing_, patches_.transport, pass, sides_cd_m2_);
    }
    std::vector<std::string> warnings() const override { return {}; }
    std::optional<PatchReport> patch_report() const override { return patches_.transport.report(); }

  private:
    PictureTracing tracing_;
    LitPatches patches_;
    std::vector<FloatRgb> sides_cd_m2_;
};

}  // namespace

std::unique_ptr<Estimator> make_radiosity_estimator(const EstimatorInput& input) {
    return std::make_unique<Radiosity>(input);
}

std::unique_ptr<PictureEstimator> make_radiosity_picture(const PictureInput& input) {
    return std::make_unique<RadiosityPicture>(input);
}

}  // namespace stilb::estimators
