#include "io/photometry/photometry_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/photometry/photometry_parts.h"
#include "io/text/text.h"
#include "lights/opening_shape.h"

namespace stilb::io {
namespace {

bool is_tilt_line(std::string_view line) { return trimmed(line).starts_with("TILT="); }

/// EULUMDAT begins with a name, then four lines of one number each.
bool looks_like_eulumdat(const std::vector<std::string_view>& lines) {
    if (lines.size() < 5) return false;
    return std::all_of(lines.begin() + 1, lines.begin() + 4,
                       [](std::string_view line) { return parse_number(trimmed(line)).has_value(); });
}

}  // namespace

PhotometryFile read_photometry_file(const std::filesystem::path& path) {
    return read_photometry(read_text_file(path), path.string());
}

PhotometryFile read_photometry(std::string_view content, const std::string& name) {
    const auto lines = split_lines(content);
    if (std::any_of(lines.begin(), lines.end(), is_tilt_line)) return read_ies(content, name);
    if (looks_like_eulumdat(lines)) return read_eulumdat(content, name);
    throw InputError(
        "not a luminaire file: neither IES LM-63 (which has a line that starts with TILT=) nor EULUMDAT "
        "(whose lines 2 to 4 are "
        "numbers)",
        {name, 0});
}

FluxAgreement check_flux(const PhotometryFile& file, double integral_lm) {
    using Classification = FluxAgreement::Classification;
    constexpr double kTolerance = FluxAgreement::kTolerance;
    if (file.stated_flux_lm > 0) {
        const double stated = file.stated_flux_lm;
        const bool agrees = std::abs(integral_lm - stated) <= kTolerance * stated;
        return {agrees ? Classification::Agrees : Classification::Differs, integral_lm, stated};
    }
    if (file.lamp_flux_lm > 0) {
        const bool below = integral_lm <= (1 + kTolerance) * file.lamp_flux_lm;
        return {below ? Classification::BelowLampFlux : Classification::AboveLampFlux, integral_lm,
                file.lamp_flux_lm};
    }
    return {Classification::NothingStated, integral_lm, 0};
}

std::string FluxAgreement::description() const {
    const double percent = stated_lm > 0 ? 100 * (integral_lm / stated_lm - 1) : 0;
    switch (classification) {
        case Classification::NothingStated:
            return fmt::format("the integral is {:.4g} lm; the file states no flux", integral_lm);
        case Classification::Agrees:
        case Classification::Differs:
            return fmt::format(
                "file and integral {}: the integral, {:.4g} lm, is {:.1f} % {} the stated {:.4g} lm",
                classification == Classification::Agrees ? "agree" : "differ", integral_lm, std::abs(percent),
                percent < 0 ? "below" : "above", stated_lm);
        case Classification::BelowLampFlux:
            return fmt::format("the integral, {:.4g} lm, is {:.1f} % of the lamps' {:.4g} lm", integral_lm,
                               100 + percent, stated_lm);
        case Classification::AboveLampFlux:
            break;
    }
    return fmt::format(
        "file and integral differ: the integral, {:.4g} lm, is {:.1f} % above the lamps' {:.4g} lm",
        integral_lm, percent, stated_lm);
}

std::optional<std::string> opening_warning(const PhotometryFile& file) {
    const auto& [length, width, height] = file.opening_m;
    const double largest_m = std::max({std::abs(length), std::abs(width), std::abs(height)});
    const bool is_likely = largest_m >= lights::kSmallestOpening_m && largest_m <= lights::kLargestOpening_m;
    if (largest_m == 0 || is_likely) return std::nullopt;
    return fmt::format(
        "the luminous opening is {:.3g} m large, as that of no luminaire. The file probably states it in "
        "another "
        "unit: in a scene, give it in metres by the key opening of the light",
        largest_m);
}

std::vector<std::string> photometry_warnings(const PhotometryFile& file, const PhotometricSolid& solid) {
    using Classification = FluxAgreement::Classification;
    std::vector<std::string> warnings = file.warnings;
    const FluxAgreement flux = check_flux(file, solid.flux_lm());
    if (flux.classification == Classification::Differs ||
        flux.classification == Classification::AboveLampFlux)
        warnings.push_back(flux.description());
    return warnings;
}

}  // namespace stilb::io
