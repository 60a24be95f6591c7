#include "run/glare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>

#include "base/parallel.h"
#include "run/glare_picture.h"
#include "run/options.h"
#include "transport/receiver.h"

namespace stilb::run {
namespace {

using statistics::Estimate;
using transport::Glare;
using transport::kGlareReplicates;

/// Sources with a smaller share of the glare in a view need no warning.
constexpr double kLeastShareOfGlare = 0.01;
constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

/// The rating of one view.
struct Rating {
    Estimate estimate;
    /// Of one replicate, with its illuminance at the eye.
    std::function<double(double illuminance_lx, std::size_t replicate)> of_replicate;
};

/// The sensor's result with ratings in place of illuminances.
SensorResult with_ratings(const SensorResult& illuminances, const std::vector<Rating>& ratings,
                          double confidence) {
    SensorResult result = illuminances;
    for (std::size_t j = 0; j < ratings.size(); ++j) result.readings[j] = {ratings[j].estimate, {}};
    for (std::size_t i = 0; i < result.replicate_means.size(); ++i) {
        double& mean = result.replicate_means[i];
        mean = ratings[i % ratings.size()].of_replicate(mean, i / ratings.size());
    }
    result.summary = statistics::summarize_grid({result.replicate_means, ratings.size()}, confidence);
    return result;
}

std::vector<Glare> find_lamps(const std::vector<MeasuringPoint>& eyes, const Scene& scene,
                              const rays::RayCaster& caster, math::RandomKey key) {
    const transport::LightSampler lights(scene, caster);
    std::vector<Glare> views(eyes.size());
    parallel_for(eyes.size(), [&](std::size_t j) {
        views[j] = find_glare(eyes[j], scene, caster, lights, key.derived(j));
    });
    return views;
}

double ugr(double glare, double background_lx) {
    return 8 * std::log10(0.25 * std::numbers::pi * glare / background_lx);
}

/// The rating with the errors of illuminance, direct light and glare, each half-width in quadrature.
/// `glare`: of the lamps that are not too small.
Estimate ugr_estimate(const Estimate& illuminance, const Estimate& direct, const Estimate& glare) {
    if (!(glare.value > 0)) return {};
    const double background_lx = illuminance.value - direct.value;
    if (!(background_lx > 0)) return {kUndefined, kUndefined, kUndefined, kUndefined};
    const double value = ugr(glare.value, background_lx);
    const double direct_half = direct.upper - direct.value;
    const double more_lx = std::hypot(illuminance.upper - illuminance.value, direct_half),
                 less_lx = std::hypot(illuminance.value - illuminance.lower, direct_half);
    const double per_relative = 8 / std::numbers::ln10;
    const double of_glare = per_relative * (glare.upper - glare.value) / glare.value;
    const double relative_error =
        std::hypot(std::hypot(illuminance.standard_error, direct.standard_error) / background_lx,
                   glare.standard_error / glare.value);
    // Where the background may be 0, there is no upper end.
    const double brighter = value - ugr(glare.value, background_lx + more_lx);
    const double darker = less_lx < background_lx ? ugr(glare.value, background_lx - less_lx) - value
                                                  : std::numeric_limits<double>::infinity();
    return {value, per_relative * relative_error, value - std::hypot(brighter, of_glare),
            value + std::hypot(darker, of_glare)};
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

Rating unified_rating(const Estimate& illuminance, const Glare& view, double confidence) {
    const auto estimate = [&](const auto& replicates) {
        return statistics::estimate_from_replicates(replicates, confidence);
    };
    const Estimate glare = estimate(view.glare_of_replicates([](const transport::GlareSource& source) {
        return source.solid_angle_sr >= transport::kLeastGlare_sr;
    }));
    return {ugr_estimate(illuminance, estimate(view.direct_of_replicates_lx), glare),
            [sum = glare.value, direct_lx = view.direct_lx](double illuminance_lx, std::size_t) {
                return sum > 0 ? ugr(sum, illuminance_lx - direct_lx) : 0;
            }};
}

// The Daylight Glare Probability

constexpr double kOfIlluminance = 5.87e-5, kOfGlare = 0.0918, kOffset = 0.16, kExponent = 1.87;
/// A place brighter than so many times the mean of the view is a source of glare, by default.
constexpr double kTimesMean = 5;
/// Below, the probability was not made for.
constexpr double kLeastIlluminance_lx = 380;

double dgp(double illuminance_lx, double glare) {
    return kOfIlluminance * illuminance_lx +
           kOfGlare * std::log10(1 + glare / std::pow(illuminance_lx, kExponent)) + kOffset;
}

/// With the errors of both, to first order, in quadrature.
Estimate dgp_estimate(const Estimate& illuminance, const Estimate& glare) {
    if (!(illuminance.value > 0)) return {kUndefined, kUndefined, kUndefined, kUndefined};
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

/// `replicates`: of the illuminance. Those of the glare, which are fewer, take turns, with deviations from
/// their mean that keep its error.
Rating daylight_rating(const Estimate& illuminance, const Glare& view, const BrightParts& bright,
                       std::size_t replicates, double confidence) {
    auto glare = view.glare_of_replicates([&](const transport::GlareSource& source) {
        return source.luminance_cd_m2 >= bright.threshold_cd_m2;
    });
    for (std::size_t r = 0; r < kGlareReplicates; ++r) glare[r] += bright.glare_of_replicates[r];
    const Estimate sum = statistics::estimate_from_replicates(glare, confidence);
    const double widening = std::sqrt(static_cast<double>(replicates) / kGlareReplicates);
    for (double& of_replicate : glare)
        of_replicate = std::max(0.0, sum.value + widening * (of_replicate - sum.value));
    return {dgp_estimate(illuminance, sum), [glare](double illuminance_lx, std::size_t replicate) {
                return dgp(illuminance_lx, glare[replicate % kGlareReplicates]);
            }};
}

}  // namespace

SensorResult with_unified_ratings(const SensorResult& illuminances, const Scene& scene,
                                  const rays::RayCaster& caster, double confidence, math::RandomKey key,
                                  std::vector<std::string>& warnings) {
    const std::vector<Glare> views =
        find_lamps(std::get<Ugr>(illuminances.sensor.kind).eyes, scene, caster, key);
    std::vector<Rating> ratings;
    for (std::size_t j = 0; j < views.size(); ++j)
        ratings.push_back(unified_rating(illuminances.readings[j].estimate, views[j], confidence));
    warn_of_sources(illuminances.sensor, views, scene, warnings);
    warn_of_points(illuminances.sensor, scene, warnings);
    return with_ratings(illuminances, ratings, confidence);
}

std::vector<std::vector<BrightParts>> find_bright_parts(std::span<const Sensor> sensors, const Scene& scene,
                                                        const rays::RayCaster& caster,
                                                        const RunOptions& options, const Monitor& monitor) {
    const PictureSetting setting{scene, caster, options.bounces.value_or(transport::kUnlimited), options.seed,
                                 monitor};
    std::vector<std::vector<BrightParts>> all(sensors.size());
    for (std::size_t s = 0; s < sensors.size(); ++s) {
        const auto* sensor = std::get_if<Dgp>(&sensors[s].kind);
        if (!sensor) continue;
        for (const MeasuringPoint& eye : sensor->eyes) {
            const EyePicture picture = picture_at(eye, setting);
            const double threshold_cd_m2 =
                sensor->threshold_cd_m2.value_or(kTimesMean * picture.mean_luminance_cd_m2());
            all[s].push_back({threshold_cd_m2, glare_above(picture, threshold_cd_m2)});
        }
    }
    return all;
}

SensorResult with_daylight_probabilities(const SensorResult& illuminances,
                                         const std::vector<BrightParts>& bright, const Scene& scene,
                                         const rays::RayCaster& caster, double confidence,
                                         math::RandomKey key, std::vector<std::string>& warnings) {
    const std::vector<Glare> views =
        find_lamps(std::get<Dgp>(illuminances.sensor.kind).eyes, scene, caster, key);
    const std::size_t replicates = illuminances.replicate_means.size() / views.size();
    std::vector<Rating> ratings;
    std::size_t dim = 0;
    for (std::size_t j = 0; j < views.size(); ++j) {
        const Estimate& illuminance = illuminances.readings[j].estimate;
        dim += illuminance.value < kLeastIlluminance_lx;
        ratings.push_back(daylight_rating(illuminance, views[j], bright[j], replicates, confidence));
    }
    if (dim > 0) {
        warnings.push_back(
            fmt::format("sensor \"{}\": the illuminance at the eye is below {:g} lx in {} of {} views, for "
                        "which DGP was not made: it may be too low.",
                        illuminances.sensor.name, kLeastIlluminance_lx, dim, views.size()));
    }
    warn_of_points(illuminances.sensor, scene, warnings);
    return with_ratings(illuminances, ratings, confidence);
}

}  // namespace stilb::run
