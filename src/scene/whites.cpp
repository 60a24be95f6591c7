#include "scene/whites.h"

#include <algorithm>
#include <vector>

#include "lights/colour_temperature.h"

namespace stilb::scene {
namespace {

constexpr double kShareThatCounts = 0.05;
constexpr double kLargestDistance = 0.01;
/// Candles. Still warmer colours, down to pure red, are as near to the black body's.
constexpr double kWarmestWhite_k = 1800;

struct White {
    double temperature_k = 0;
    Rgb flux_lm;
};

struct Whites {
    std::vector<White> lamps;  ///< from warm to cool
    std::vector<White> environment;
};

Whites whites_of(const Scene& scene) {
    Whites whites;
    for (const Light& light : scene.lights) {
        const Rgb flux = flux_lm(scene, light);
        if (!(flux.luminance() > 0)) continue;
        const auto [temperature_k, distance] = lights::correlated_temperature(flux);
        if (distance > kLargestDistance || temperature_k < kWarmestWhite_k) continue;
        const bool is_lamp = location_of(light) != LightLocation::infinity;
        (is_lamp ? whites.lamps : whites.environment).push_back({temperature_k, flux});
    }
    std::ranges::stable_sort(whites.lamps, {}, &White::temperature_k);
    return whites;
}

double total_lm(const std::vector<White>& whites) {
    double sum = 0;
    for (const White& white : whites) sum += white.flux_lm.luminance();
    return sum;
}

/// Leaves the warmest and the coolest ones out that hardly count.
std::vector<White> without_ends(const std::vector<White>& from_warm_to_cool) {
    const double total = total_lm(from_warm_to_cool);
    double before = 0;
    std::vector<White> middle;
    for (const White& white : from_warm_to_cool) {
        const double after = before + white.flux_lm.luminance();
        if (after > kShareThatCounts * total && before < (1 - kShareThatCounts) * total)
            middle.push_back(white);
        before = after;
    }
    return middle;
}

Rgb unit_luminance(const White& white) { return white.flux_lm * (1 / white.flux_lm.luminance()); }

}  // namespace

WhiteRange whites_of_lights(const Scene& scene) {
    const auto [lamps, environment] = whites_of(scene);
    std::vector<White> whites = without_ends(lamps);
    const double lamps_lm = total_lm(lamps);
    for (const White& white : environment) {
        const double lm = white.flux_lm.luminance();
        if (lm > kShareThatCounts * (lamps_lm + lm)) whites.push_back(white);
    }
    if (whites.empty()) return {};
    const auto [warmest, coolest] = std::ranges::minmax_element(whites, {}, &White::temperature_k);
    return {unit_luminance(*warmest), unit_luminance(*coolest)};
}

}  // namespace stilb::scene
