#include "run/glare/daylight_glare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace stilb::run {
namespace {

using statistics::Estimate;
using statistics::kUndefinedEstimate;

constexpr double kOfIlluminance = 5.87e-5, kOfGlare = 0.0918, kOffset = 0.16, kExponent = 1.87;
/// A place brighter than so many times the mean of the view is a source of glare, by default.
constexpr double kTimesMean = 5;

/// The probability, and how it changes with its two parts, at their means.
struct DgpAtMeans {
    /// `glare`: the sum over all sources. Without any, the probability has no term of them, also in the dark.
    DgpAtMeans(double illuminance, double glare) : illuminance_lx(illuminance), glare_sum(glare) {
        const double scale = std::pow(std::max(0.0, illuminance_lx), kExponent);
        if (glare_sum > 0) {
            per_glare = kOfGlare / std::numbers::ln10 / (scale + glare_sum);
            per_lx -= per_glare * kExponent * glare_sum / illuminance_lx;
            value += kOfGlare * std::log10(1 + glare_sum / scale);
        }
        value += kOfIlluminance * illuminance_lx;
    }

    /// Whether both are seen: a source is one of light.
    bool is_defined() const { return illuminance_lx > 0 || glare_sum <= 0; }
    /// To first order.
    double near(double illuminance, double glare) const {
        return value + per_lx * (illuminance - illuminance_lx) + per_glare * (glare - glare_sum);
    }

    double illuminance_lx, glare_sum;
    double value = kOffset, per_lx = kOfIlluminance, per_glare = 0;
};

/// With the errors of both, to first order, in quadrature.
Estimate dgp_estimate(const DgpAtMeans& dgp, const Estimate& illuminance, const Estimate& glare) {
    const double less_lx = illuminance.value - illuminance.lower,
                 more_lx = illuminance.upper - illuminance.value;
    return {dgp.value,
            std::hypot(dgp.per_lx * illuminance.standard_error, dgp.per_glare * glare.standard_error),
            dgp.value - std::hypot(dgp.per_lx * (dgp.per_lx > 0 ? less_lx : more_lx),
                                   dgp.per_glare * (glare.value - glare.lower)),
            dgp.value + std::hypot(dgp.per_lx * (dgp.per_lx > 0 ? more_lx : less_lx),
                                   dgp.per_glare * (glare.upper - glare.value))};
}

using OfReplicates = std::array<double, kGlareReplicates>;

/// The sums over all sources of a view.
OfReplicates sums_of(const DaylightView& view) {
    OfReplicates sums = view.bright;
    for (const transport::GlareSource& source : view.lamps.sources) {
        if (source.luminance_cd_m2 < view.threshold_cd_m2) continue;
        for (std::size_t r = 0; r < kGlareReplicates; ++r) sums[r] += source.glare_of_replicates[r];
    }
    return sums;
}

/// The replicates of the sum, which are fewer than those of the illuminance, take turns, with deviations from
/// their mean that keep its error.
OfReplicates widened_to(std::size_t replicates, const OfReplicates& sums, double mean) {
    const double widening = std::sqrt(static_cast<double>(replicates) / kGlareReplicates);
    OfReplicates widened;
    std::ranges::transform(sums, widened.begin(),
                           [&](double sum) { return std::max(0.0, mean + widening * (sum - mean)); });
    return widened;
}

}  // namespace

DaylightView find_daylight_glare(const MeasuringPoint& eye, std::optional<double> threshold_cd_m2,
                                 const PictureSetting& setting, const transport::LightSampler& lights,
                                 math::RandomKey key) {
    const EyePicture picture = picture_at(eye, setting);
    DaylightView view;
    view.lamps = transport::find_glare(eye, setting.scene, setting.caster, lights, key, kGlareReplicates);
    view.threshold_cd_m2 = threshold_cd_m2.value_or(kTimesMean * picture.mean_luminance_cd_m2());
    view.bright = glare_above(picture, view.threshold_cd_m2);
    return view;
}

void rate_daylight(std::span<const DaylightView> views, double confidence, SensorEstimates& estimates) {
    Campaign::Estimates& all = estimates.readings;
    const std::size_t readings = views.size(), replicates = all.replicate_means.size() / readings;
    bool is_defined = true;
    for (std::size_t j = 0; j < readings; ++j) {
        const OfReplicates sums = sums_of(views[j]);
        const Estimate sum = statistics::estimate_from_replicates(sums, confidence);
        const DgpAtMeans dgp(all.readings[j].value, sum.value);
        is_defined = is_defined && dgp.is_defined();
        all.readings[j] = dgp.is_defined() ? dgp_estimate(dgp, all.readings[j], sum) : kUndefinedEstimate;
        const OfReplicates widened = widened_to(replicates, sums, sum.value);
        for (std::size_t r = 0; r < replicates; ++r) {
            double& value = all.replicate_means[r * readings + j];
            value = dgp.near(value, widened[r % kGlareReplicates]);
        }
    }
    all.bias.reset();  // the intervals contain it
    constexpr Estimate none = kUndefinedEstimate;
    estimates.summary = is_defined ? statistics::summarize_grid({all.replicate_means, readings}, confidence)
                                   : statistics::GridSummary{none, none, none, none, none};
}

}  // namespace stilb::run
