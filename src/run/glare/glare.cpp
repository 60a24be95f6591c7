#include "run/glare/glare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>

#include "base/parallel.h"
#include "transport/light_sampler.h"

namespace stilb::run {
namespace {

using statistics::Estimate;
using transport::Glare;

/// Sources with a smaller share of the glare in a view need no warning.
constexpr double kLeastShareOfGlare = 0.01;
constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr Estimate kUndefinedEstimate{kUndefined, kUndefined, kUndefined, kUndefined};

/// The derivative of a rating by q is this over -q.
constexpr double kPerRelative = 8 / std::numbers::ln10;
/// The rating of this q is 0.
constexpr double kNoGlare = 0.25 * std::numbers::pi;

double rating(double q) {
    return q > 0 ? 8 * std::log10(kNoGlare / q) : std::numeric_limits<double>::infinity();
}

Estimate rated(const Estimate& q) {
    const double lower = rating(q.upper), upper = rating(q.lower);
    if (!(q.value > 0)) return {kUndefined, kUndefined, lower, upper};
    return {rating(q.value), kPerRelative * q.standard_error / q.value, lower, upper};
}

double mean_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The sums of a view over the sources that UGR was made for.
struct UnifiedGlare {
    explicit UnifiedGlare(const Glare& view) : of_replicates(view.direct_of_replicates_lx.size()) {
        for (const transport::GlareSource& source : view.sources) {
            if (source.solid_angle_sr < transport::kLeastGlare_sr) continue;
            sum += source.glare();
            for (std::size_t r = 0; r < of_replicates.size(); ++r)
                of_replicates[r] += source.glare_of_replicates[r];
        }
    }

    double sum = 0;
    std::vector<double> of_replicates;
};

/// Turns the illuminances of reading `j` into q, to first order in the error of the glare.
void set_ratios(const Glare& view, std::size_t j, Campaign::Estimates& all) {
    const std::size_t readings = all.readings.size(), replicates = all.replicate_means.size() / readings;
    const UnifiedGlare in_all(view);
    const bool sees_lamps = in_all.sum > 0;
    const double per_lx = sees_lamps ? 1 / in_all.sum : 0;
    // The run may have ended before all of its replicates began.
    const auto direct_lx = std::span(view.direct_of_replicates_lx).first(replicates);
    const auto glare = std::span(in_all.of_replicates).first(replicates);
    const double mean_glare = mean_of(glare);
    const double q = (all.readings[j].value - mean_of(direct_lx)) * per_lx;
    for (std::size_t r = 0; r < replicates; ++r) {
        double& value = all.replicate_means[r * readings + j];
        value = sees_lamps ? (value - direct_lx[r] - q * (glare[r] - mean_glare)) * per_lx : kNoGlare;
    }
    all.rare_light[j] *= per_lx;
    if (all.bias) all.bias->of_readings[j] *= per_lx;
}

/// Turns q of all readings into ratings, to first order in all but their intervals. Returns their mean, which
/// is undefined where the background of a view may be 0.
Estimate set_ratings(Campaign::Estimates& all, double confidence) {
    const std::size_t readings = all.readings.size();
    std::vector<double> means(all.replicate_means.size() / readings);
    double rare_light = 0, bias = 0;
    bool is_defined = true;
    for (std::size_t j = 0; j < readings; ++j) {
        const double q = all.readings[j].value, slope = kPerRelative / q;
        is_defined = is_defined && all.readings[j].lower > 0;
        for (std::size_t r = 0; r < means.size(); ++r) {
            double& value = all.replicate_means[r * readings + j];
            value = rating(q) - slope * (value - q);
            means[r] += value / static_cast<double>(readings);
        }
        rare_light += slope * all.rare_light[j] / static_cast<double>(readings);
        if (all.bias) bias += (all.bias->of_readings[j] *= slope) / static_cast<double>(readings);
        all.readings[j] = rated(all.readings[j]);
    }
    if (!is_defined) return kUndefinedEstimate;
    Estimate mean = statistics::estimate_from_replicates(means, confidence);
    mean.lower -= rare_light;  // with more light there is less glare
    return statistics::widened(mean, bias);
}

void rate_views(const std::vector<Glare>& views, double confidence, SensorEstimates& estimates) {
    Campaign::Estimates& all = estimates.readings;
    for (std::size_t j = 0; j < views.size(); ++j) set_ratios(views[j], j, all);
    all.readings =
        statistics::estimate_readings({all.replicate_means, views.size()}, confidence, all.rare_light);
    for (std::size_t j = 0; all.bias && j < views.size(); ++j)
        all.readings[j] = statistics::widened(all.readings[j], all.bias->of_readings[j]);
    const statistics::GridSummary ratios = summary_of(all, confidence);
    estimates.summary = {set_ratings(all, confidence), rated(ratios.maximum), rated(ratios.minimum),
                         kUndefinedEstimate, kUndefinedEstimate};
}

/// The lights of a kind of glare source, in all views.
using LightNumbers = std::set<std::uint32_t>;

/// "The solid angle of light "a" and 2 more", and the text.
void warn(const std::string& sensor, std::string_view what, const LightNumbers& numbers, const Scene& scene,
          std::string_view text, std::vector<std::string>& warnings) {
    if (numbers.empty()) return;
    const std::string more = numbers.size() > 1 ? fmt::format(" and {} more", numbers.size() - 1) : "";
    warnings.push_back(fmt::format("sensor \"{}\": {} of light \"{}\"{} {}", sensor, what,
                                   scene.lights[*numbers.begin()].name, more, text));
}

void warn_of_sources(const Sensor& sensor, const std::vector<Glare>& views, const Scene& scene,
                     std::vector<std::string>& warnings) {
    LightNumbers small, large;
    for (const Glare& view : views) {
        double all = 0;
        for (const transport::GlareSource& source : view.sources) all += source.glare();
        for (const transport::GlareSource& source : view.sources) {
            if (source.glare() < kLeastShareOfGlare * all) continue;
            if (source.solid_angle_sr < transport::kLeastGlare_sr) small.insert(source.light);
            if (source.solid_angle_sr > transport::kMostGlare_sr) large.insert(source.light);
        }
    }
    warn(sensor.name, "the solid angle", small, scene,
         "is less than 0.0003 sr, for which UGR was not made: its glare is left out.", warnings);
    warn(sensor.name, "the solid angle", large, scene,
         "is more than 0.1 sr, for which UGR was not made: the rating is not valid.", warnings);
}

void warn_of_points(const Sensor& sensor, const Scene& scene, std::vector<std::string>& warnings) {
    LightNumbers points;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        if (location_of(scene.lights[i]) == LightLocation::point) points.insert(i);
    }
    warn(sensor.name, "the glare", points, scene,
         fmt::format(
             "is missing from {}: a point has no luminous area. Give a luminaire an opening, and use a "
             "light of type \"sphere\" or \"area\" in place of a point.",
             sensor.quantity().name),
         warnings);
}

void warn_of_dim_views(const Sensor& sensor, const SensorEstimates& illuminances,
                       std::vector<std::string>& warnings) {
    const auto& readings = illuminances.readings.readings;
    const auto dim = std::ranges::count_if(
        readings, [](double lx) { return lx < kLeastDaylight_lx; }, &Estimate::value);
    if (dim == 0) return;
    warnings.push_back(
        fmt::format("sensor \"{}\": the illuminance at the eye is below {:g} lx in {} of {} "
                    "views, for which DGP was not made: it may be too low.",
                    sensor.name, kLeastDaylight_lx, dim, readings.size()));
}

/// The sources that glare most first.
GlareView described(Glare view, double illuminance_lx, const Scene& scene) {
    GlareView result{(illuminance_lx - mean_of(view.direct_of_replicates_lx)) / std::numbers::pi, {}};
    std::ranges::stable_sort(view.sources, std::ranges::greater{}, &transport::GlareSource::glare);
    for (const transport::GlareSource& source : view.sources)
        result.sources.push_back({scene.lights[source.light].name, source.luminance_cd_m2,
                                  source.solid_angle_sr, source.position_index,
                                  source.solid_angle_sr >= transport::kLeastGlare_sr});
    return result;
}

}  // namespace

GlareViews::GlareViews(std::span<const Sensor> sensors, const PictureSetting& setting, std::size_t replicates,
                       math::RandomKey key)
    : views_(sensors.size()), daylight_views_(sensors.size()) {
    const transport::LightSampler lights(setting.scene, setting.caster);
    for (std::size_t s = 0; s < sensors.size(); ++s) {
        if (const auto* ugr = std::get_if<Ugr>(&sensors[s].kind)) {
            views_[s].resize(ugr->eyes.size());
            parallel_for(ugr->eyes.size(), [&](std::size_t j) {
                views_[s][j] = find_glare(ugr->eyes[j], setting.scene, setting.caster, lights, key.derived(j),
                                          replicates);
            });
        }
        if (const auto* dgp = std::get_if<Dgp>(&sensors[s].kind)) {
            for (std::size_t j = 0; j < dgp->eyes.size(); ++j) {
                daylight_views_[s].push_back(
                    find_daylight_glare(dgp->eyes[j], dgp->threshold_cd_m2, setting, lights, key.derived(j)));
            }
        }
    }
}

void GlareViews::rate(std::span<SensorEstimates> estimates, double confidence) const {
    for (std::size_t s = 0; s < views_.size(); ++s) {
        if (!views_[s].empty()) rate_views(views_[s], confidence, estimates[s]);
        if (!daylight_views_[s].empty()) rate_daylight(daylight_views_[s], confidence, estimates[s]);
    }
}

std::vector<std::string> GlareViews::warnings(const Scene& scene, std::span<const Sensor> sensors,
                                              std::span<const SensorEstimates> illuminances) const {
    std::vector<std::string> warnings;
    for (std::size_t s = 0; s < views_.size(); ++s) {
        if (!sensors[s].rates_glare()) continue;
        warn_of_sources(sensors[s], views_[s], scene, warnings);
        if (!daylight_views_[s].empty()) warn_of_dim_views(sensors[s], illuminances[s], warnings);
        warn_of_points(sensors[s], scene, warnings);
    }
    return warnings;
}

std::vector<GlareView> GlareViews::described_views(std::size_t sensor, const SensorEstimates& illuminances,
                                                   const Scene& scene) const {
    std::vector<GlareView> all;
    for (std::size_t j = 0; j < views_[sensor].size(); ++j)
        all.push_back(described(views_[sensor][j], illuminances.readings.readings[j].value, scene));
    return all;
}

}  // namespace stilb::run
