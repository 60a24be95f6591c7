#include "run/glare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>

#include "base/parallel.h"
#include "transport/glare.h"

namespace stilb::run {
namespace {

using statistics::Estimate;
using transport::Glare;

/// Sources with a smaller share of the glare in a view need no warning.
constexpr double kLeastShareOfGlare = 0.01;
constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

double ugr(double glare, double background_lx) {
    return 8 * std::log10(0.25 * std::numbers::pi * glare / background_lx);
}

/// The rating with the errors of illuminance, direct light and glare, each half-width in quadrature.
Estimate rating_of(const Estimate& illuminance, const Glare& view, double confidence) {
    const Estimate direct = statistics::estimate_from_replicates(view.direct_of_replicates_lx, confidence);
    const Estimate glare = statistics::estimate_from_replicates(view.glare_of_replicates, confidence);
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
    LightNumbers small, large, points;
    for (const Glare& view : views) {
        double all = 0;
        for (const transport::GlareSource& source : view.sources) all += source.glare();
        for (const transport::GlareSource& source : view.sources) {
            if (source.glare() < kLeastShareOfGlare * all) continue;
            if (source.solid_angle_sr < transport::kLeastGlare_sr) small.insert(source.light);
            if (source.solid_angle_sr > transport::kMostGlare_sr) large.insert(source.light);
        }
    }
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        if (location_of(scene.lights[i]) == LightLocation::point) points.insert(i);
    }
    warn(sensor.name, "the solid angle", small, scene,
         "is less than 0.0003 sr, for which UGR was not made: its glare is left out.", warnings);
    warn(sensor.name, "the solid angle", large, scene,
         "is more than 0.1 sr, for which UGR was not made: the rating is not valid.", warnings);
    warn(sensor.name, "the glare", points, scene,
         "is missing from UGR: a point has no luminous area. Give a luminaire an opening, and use a light of "
         "type "
         "\"sphere\" or \"area\" in place of a point.",
         warnings);
}

/// The sources that glare most first.
GlareView described(Glare view, double illuminance_lx, const Scene& scene) {
    GlareView result{(illuminance_lx - view.direct_lx) / std::numbers::pi, {}};
    std::ranges::stable_sort(view.sources, std::ranges::greater{}, &transport::GlareSource::glare);
    for (const transport::GlareSource& source : view.sources)
        result.sources.push_back({scene.lights[source.light].name, source.luminance_cd_m2,
                                  source.solid_angle_sr, source.position_index,
                                  source.solid_angle_sr >= transport::kLeastGlare_sr});
    return result;
}

}  // namespace

SensorResult with_glare_ratings(const SensorResult& illuminances, const Scene& scene,
                                const rays::RayCaster& caster, double confidence, math::RandomKey key,
                                std::vector<std::string>& warnings) {
    const auto& eyes = std::get<Ugr>(illuminances.sensor.kind).eyes;
    const transport::LightSampler lights(scene, caster);
    std::vector<Glare> views(eyes.size());
    parallel_for(eyes.size(), [&](std::size_t j) {
        views[j] = find_glare(eyes[j], scene, caster, lights, key.derived(j));
    });
    SensorResult result = illuminances;
    for (std::size_t j = 0; j < eyes.size(); ++j) {
        const Estimate& illuminance = illuminances.readings[j].estimate;
        result.readings[j] = {rating_of(illuminance, views[j], confidence), {}};
        result.glare.push_back(described(views[j], illuminance.value, scene));
    }
    for (std::size_t i = 0; i < result.replicate_means.size(); ++i) {
        const Glare& view = views[i % eyes.size()];
        double glare = 0;
        for (const double of_replicate : view.glare_of_replicates)
            glare += of_replicate / static_cast<double>(view.glare_of_replicates.size());
        double& mean = result.replicate_means[i];
        mean = glare > 0 ? ugr(glare, mean - view.direct_lx) : 0;
    }
    result.summary = statistics::summarize_grid({result.replicate_means, eyes.size()}, confidence);
    warn_of_sources(result.sensor, views, scene, warnings);
    return result;
}

}  // namespace stilb::run
