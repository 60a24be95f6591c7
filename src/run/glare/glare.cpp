#include "run/glare/glare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "base/parallel.h"
#include "transport/light_sampler.h"

namespace stilb::run {
namespace {

using statistics::Estimate;
using statistics::kUndefined;
using statistics::kUndefinedEstimate;
using transport::Glare;

/// Sources with a smaller share of the glare in a view need no warning.
constexpr double kLeastShareOfGlare = 0.01;

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

bool is_small(const transport::GlareSource& source) {
    return source.solid_angle_sr < transport::kLeastGlare_sr;
}
bool is_large(const transport::GlareSource& source) {
    return source.solid_angle_sr > transport::kMostGlare_sr;
}

/// Which sources in the field of view of UGR: those that it counts, or also those that are too small for it.
enum class Sources { counted, all };

bool includes(Sources sources, const transport::GlareSource& source) {
    return source.is_in_field && (sources == Sources::all || !is_small(source));
}

/// The sums of a view over its sources.
struct UnifiedGlare {
    UnifiedGlare(const Glare& view, Sources sources) : of_replicates(view.direct_of_replicates_lx.size()) {
        for (const transport::GlareSource& source : view.sources) {
            if (!includes(sources, source)) continue;
            sum += source.glare();
            for (std::size_t r = 0; r < of_replicates.size(); ++r)
                of_replicates[r] += source.glare_of_replicates[r];
        }
    }

    double sum = 0;
    std::vector<double> of_replicates;
};

/// Turns the illuminances of reading `j` into q, to first order in the error of the glare.
void set_ratios(const Glare& view, Sources sources, std::size_t j, Campaign::Estimates& all) {
    const std::size_t readings = all.readings.size(), replicates = all.replicate_means.size() / readings;
    const UnifiedGlare in_all(view, sources);
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

void rate_views(const std::vector<Glare>& views, Sources sources, double confidence,
                SensorEstimates& estimates) {
    Campaign::Estimates& all = estimates.readings;
    for (std::size_t j = 0; j < views.size(); ++j) set_ratios(views[j], sources, j, all);
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

/// What UGR was not made for, in the field of view: small and large sources with a share of the glare that
/// matters, and points.
struct Unrated {
    explicit Unrated(const std::vector<Glare>& views) {
        for (const Glare& view : views) {
            const double all = UnifiedGlare(view, Sources::all).sum;
            for (const transport::GlareSource& source : view.sources) {
                if (!source.is_in_field || source.glare() < kLeastShareOfGlare * all) continue;
                if (is_small(source)) small.insert(source.light);
                if (is_large(source)) large.insert(source.light);
            }
            for (const transport::GlareSource& point : view.points) {
                if (point.is_in_field) points.insert(point.light);
            }
            for (const ObjectId diffuser : view.diffusers) diffusers.insert(diffuser);
        }
    }

    LightNumbers small, large, points;
    std::set<ObjectId> diffusers;
};

/// "light "a" and 2 more".
std::string names_of(const LightNumbers& numbers, const Scene& scene) {
    const std::string more = numbers.size() > 1 ? fmt::format(" and {} more", numbers.size() - 1) : "";
    return fmt::format("light \"{}\"{}", scene.lights[*numbers.begin()].name, more);
}

/// "The solid angle of light "a" and 2 more", and the text.
void warn(const std::string& sensor, std::string_view what, const LightNumbers& numbers, const Scene& scene,
          std::string_view text, std::vector<std::string>& warnings) {
    if (numbers.empty()) return;
    warnings.push_back(
        fmt::format("sensor \"{}\": {} of {} {}", sensor, what, names_of(numbers, scene), text));
}

/// "object "a" and 2 more may glare by the light that it scatters as it lets it through".
std::string text_on_diffusers(const std::set<ObjectId>& diffusers, const Scene& scene) {
    const std::string more = diffusers.size() > 1 ? fmt::format(" and {} more", diffusers.size() - 1) : "";
    return fmt::format("object \"{}\"{} may glare by the light that it scatters as it lets it through",
                       scene.object(*diffusers.begin()).name, more);
}

void warn_of_sources(const Sensor& sensor, const Unrated& unrated, const Scene& scene,
                     std::vector<std::string>& warnings) {
    warn(sensor.name, "the solid angle", unrated.small, scene,
         "is less than 0.0003 sr, for which UGR was not made: its glare is left out.", warnings);
    warn(sensor.name, "the solid angle", unrated.large, scene,
         "is more than 0.1 sr, for which UGR was not made: the rating is not valid.", warnings);
}

/// The points in front of eyes.
LightNumbers points_of(const std::vector<DaylightView>& views) {
    LightNumbers points;
    for (const DaylightView& view : views) {
        for (const transport::GlareSource& point : view.lamps.points) points.insert(point.light);
    }
    return points;
}

void warn_of_points(const Sensor& sensor, const LightNumbers& points, const Scene& scene,
                    std::vector<std::string>& warnings) {
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

GlareStanding unified_standing(const transport::GlareSource& source) {
    if (!source.is_in_field) return GlareStanding::outside;
    if (is_small(source)) return GlareStanding::small;
    return is_large(source) ? GlareStanding::large : GlareStanding::counted;
}

/// The sources that glare most first, those that are not counted and points last. `standing_of`: of a source.
std::vector<GlareSource> described(const Glare& view, const Scene& scene, const auto& standing_of) {
    std::vector<transport::GlareSource> sources = view.sources;
    std::ranges::stable_sort(sources, std::ranges::greater{}, [&](const transport::GlareSource& source) {
        return std::pair(is_counted(standing_of(source)), source.glare());
    });
    std::vector<GlareSource> all;
    const auto add = [&](const transport::GlareSource& source, GlareStanding standing) {
        all.push_back({scene.lights[source.light].name, source.luminance_cd_m2, source.solid_angle_sr,
                       source.position_index, standing});
    };
    for (const transport::GlareSource& source : sources) add(source, standing_of(source));
    for (const transport::GlareSource& point : view.points) add(point, GlareStanding::point);
    return all;
}

GlareView described(const Glare& view, double illuminance_lx, const Scene& scene) {
    const double background_lx = illuminance_lx - mean_of(view.direct_of_replicates_lx);
    return {background_lx / std::numbers::pi, {}, described(view, scene, unified_standing)};
}

GlareView described(const DaylightView& view, const Scene& scene) {
    return {{}, view.threshold_cd_m2, described(view.lamps, scene, [&](const transport::GlareSource& source) {
                const bool is_dim = source.luminance_cd_m2 < view.threshold_cd_m2;
                return is_dim ? GlareStanding::dim : GlareStanding::counted;
            })};
}

/// Of a rating that nobody knows.
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr Estimate kUnknown{kInfinite, 0, kInfinite, kInfinite};

/// Rates views by what UGR counts; `complete` has the small sources, too, and is unknown with large ones and
/// points.
void rate_unified(const std::vector<Glare>& views, double confidence, SensorEstimates& estimates) {
    const Unrated unrated(views);
    std::optional<statistics::GridSummary> complete;
    if (!unrated.large.empty() || !unrated.points.empty() || !unrated.diffusers.empty()) {
        complete = {kUnknown, kUnknown, kUnknown, kUndefinedEstimate, kUndefinedEstimate};
    } else if (!unrated.small.empty()) {
        SensorEstimates in_all = estimates;
        rate_views(views, Sources::all, confidence, in_all);
        complete = in_all.summary;
    }
    rate_views(views, Sources::counted, confidence, estimates);
    estimates.complete = complete;
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
        if (!views_[s].empty()) rate_unified(views_[s], confidence, estimates[s]);
        if (!daylight_views_[s].empty()) rate_daylight(daylight_views_[s], confidence, estimates[s]);
    }
}

std::vector<std::string> GlareViews::warnings(const Scene& scene, std::span<const Sensor> sensors,
                                              std::span<const SensorEstimates> illuminances) const {
    std::vector<std::string> warnings;
    for (std::size_t s = 0; s < views_.size(); ++s) {
        if (!sensors[s].rates_glare()) continue;
        const Unrated unrated(views_[s]);
        warn_of_sources(sensors[s], unrated, scene, warnings);
        if (!unrated.diffusers.empty())
            warnings.push_back(fmt::format("sensor \"{}\": {}: UGR counts it as background.", sensors[s].name,
                                           text_on_diffusers(unrated.diffusers, scene)));
        if (!daylight_views_[s].empty()) warn_of_dim_views(sensors[s], illuminances[s], warnings);
        warn_of_points(sensors[s], unrated.points, scene, warnings);
        warn_of_points(sensors[s], points_of(daylight_views_[s]), scene, warnings);
    }
    return warnings;
}

std::vector<GlareView> GlareViews::described_views(std::size_t sensor, const SensorEstimates& illuminances,
                                                   const Scene& scene) const {
    std::vector<GlareView> all;
    for (std::size_t j = 0; j < views_[sensor].size(); ++j)
        all.push_back(described(views_[sensor][j], illuminances.readings.readings[j].value, scene));
    for (const DaylightView& view : daylight_views_[sensor]) all.push_back(described(view, scene));
    return all;
}

std::string GlareViews::reason_of_doubt(std::size_t sensor, const SensorEstimates& ratings,
                                        const Scene& scene) const {
    const Unrated unrated(views_[sensor]);
    std::vector<std::string> reasons;
    if (!unrated.points.empty())
        reasons.push_back(fmt::format("{} has no luminous area", names_of(unrated.points, scene)));
    if (!unrated.diffusers.empty()) reasons.push_back(text_on_diffusers(unrated.diffusers, scene));
    if (!unrated.large.empty())
        reasons.push_back(fmt::format("{} is more than 0.1 sr, for which UGR was not made",
                                      names_of(unrated.large, scene)));
    if (!unrated.small.empty()) {
        const Estimate& in_all = ratings.complete->maximum;
        const std::string with_them =
            std::isfinite(in_all.value) ? fmt::format(": with it the rating is {:.1f}", in_all.value) : "";
        reasons.push_back(fmt::format("{} is less than 0.0003 sr, for which UGR was not made, and left out{}",
                                      names_of(unrated.small, scene), with_them));
    }
    return fmt::format("{}", fmt::join(reasons, "; "));
}

}  // namespace stilb::run
