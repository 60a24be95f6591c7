#include "run/glare/daylight_glare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace stilb::run {
namespace {

using statistics::Estimate;

constexpr double kOfIlluminance = 5.87e-5, kOfGlare = 0.0918, kOffset = 0.16, kExponent = 1.87;
/// A place brighter than so many times the mean of the view is a source of glare, by default.
constexpr double kTimesMean = 5;

double dgp(double illuminance_lx, double glare) {
    return kOfIlluminance * illuminance_lx +
           kOfGlare * std::log10(1 + glare / std::pow(illuminance_lx, kExponent)) + kOffset;
}

/// With the errors of both, to first order, in quadrature.
Estimate dgp_estimate(const Estimate& illuminance, const Estimate& glare) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (!(illuminance.value > 0)) return {none, none, none, none};
    const double ratio = glare.value / std::pow(illuminance.value, kExponent);
    const double per_glare =
        kOfGlare / std::numbers::ln10 / (1 + ratio) / std::pow(illuminance.value, kExponent);
    const double per_lx = kOfIlluminance - per_glare * kExponent * glare.value / illuminance.value;
    const double less_lx = illuminance.value - illuminance.lower,
                 more_lx = illuminance.upper - illuminance.value;
    const double value = dgp(illuminance.value, glare.value);
    return {value, std::hypot(per_lx * illuminance.standard_error, per_glare * glare.standard_error),
            value - std::hypot(per_lx * (per_lx > 0 ? less_lx : more_lx),
                               per_glare * (glare.value - glare.lower)),
            value + std::hypot(per_lx * (per_lx > 0 ? more_lx : less_lx),
                               per_glare * (glare.upper - glare.value))};
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
    for (std::size_t j = 0; j < readings; ++j) {
        const OfReplicates sums = sums_of(views[j]);
        const Estimate sum = statistics::estimate_from_replicates(sums, confidence);
        all.readings[j] = dgp_estimate(all.readings[j], sum);
        const OfReplicates widened = widened_to(replicates, sums, sum.value);
        for (std::size_t r = 0; r < replicates; ++r) {
            double& value = all.replicate_means[r * readings + j];
            value = dgp(value, widened[r % kGlareReplicates]);
        }
    }
    all.bias.reset();  // the intervals contain it
    estimates.summary = statistics::summarize_grid({all.replicate_means, readings}, confidence);
}

}  // namespace stilb::run
