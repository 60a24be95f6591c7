#include "io/photometry/photometry_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace stilb::io {
namespace {

/// The largest credible intensity: a laser of a watt with a divergence of a milliradian has 1e9 cd.
constexpr double kGreatestIntensityCd = 1e12;
/// Of the largest intensity: what a goniometer's dark current may leave below 0.
constexpr double kGreatestNoise = 0.01;

}  // namespace

std::vector<std::string_view> split_lines(std::string_view content) {
    content = without_byte_order_mark(content);
    while (!content.empty() && content.back() == '\x1A') content.remove_suffix(1);

    std::vector<std::string_view> lines;
    while (!content.empty()) {
        const std::size_t end = std::min(content.find_first_of("\r\n"), content.size());
        lines.push_back(content.substr(0, end));
        content.remove_prefix(end);
        if (content.starts_with("\r\n")) {
            content.remove_prefix(2);
        } else if (!content.empty()) {
            content.remove_prefix(1);
        }
    }
    return lines;
}

std::optional<double> stated_power_w(std::optional<double> number) {
    return number && *number > 0 && std::isfinite(*number) ? number : std::nullopt;
}

std::vector<double> checked_angles(const std::vector<LocatedNumber>& numbers, std::string_view what,
                                   double least, double greatest, const std::string& file) {
    std::vector<double> angles;
    for (const auto& [angle, line] : numbers) {
        if (angle < least || angle > greatest) {
            throw InputError(fmt::format("{} {} is out of range: {} to {} degrees are allowed", what, angle,
                                         least, greatest),
                             {file, line});
        }
        if (!angles.empty() && angle - angles.back() < PhotometricSolid::kSmallestStepDeg) {
            throw InputError(
                fmt::format("{} {} follows {}: the angles must increase", what, angle, angles.back()),
                {file, line});
        }
        angles.push_back(angle);
    }
    return angles;
}

void set_intensities(PhotometricSolid::Grid& grid, const std::vector<LocatedNumber>& numbers, double factor,
                     const std::string& file, std::vector<std::string>& warnings) {
    double largest = 0, peak = 0;
    for (const LocatedNumber& number : numbers) largest = std::max(largest, number.value);
    std::size_t noisy = 0;
    double lowest = 0;
    for (const auto& [number, line] : numbers) {
        if (number < -kGreatestNoise * largest) {
            throw InputError(fmt::format("intensity {} is negative: it must be 0 or more", number),
                             {file, line});
        }
        noisy += number < 0;
        lowest = std::min(lowest, number);
        const double intensity = factor * std::max(number, 0.0);
        if (!(intensity <= kGreatestIntensityCd)) {
            throw InputError(
                fmt::format("intensity {} cd (factors included) is too large for a luminaire: at most "
                            "{} cd are allowed",
                            intensity, kGreatestIntensityCd),
                {file, line});
        }
        peak = std::max(peak, intensity);
        grid.intensity_cd.push_back(intensity);
    }
    if (!(peak > 0)) throw InputError("all intensities are 0: the luminaire would emit no light", {file, 0});
    if (noisy > 0) {
        warnings.push_back(fmt::format("{} intensit{} negative, down to {} (the largest is {}): read as 0",
                                       noisy, noisy == 1 ? "y is" : "ies are", lowest, largest));
    }
}

void check_range(const std::vector<double>& angles_deg, std::span<const double> first,
                 std::span<const double> last, std::string_view what, std::string_view format,
                 std::vector<std::string>& warnings) {
    const auto is_among = [](double angle, std::span<const double> allowed) {
        return std::ranges::any_of(allowed, [&](double one) { return same_angle(angle, one); });
    };
    if (is_among(angles_deg.front(), first) && is_among(angles_deg.back(), last)) return;
    warnings.push_back(
        fmt::format("the {} run from {} to {} degrees: {} wants them to run from {} to {}. The directions "
                    "beyond them get no "
                    "light",
                    what, angles_deg.front(), angles_deg.back(), format, fmt::join(first, " or "),
                    fmt::join(last, " or ")));
}

void mirror_at_last_plane(PhotometricSolid::Grid& grid) {
    const std::size_t rings = grid.polar_deg.size();
    const double mirror = grid.planes_deg.back();
    for (std::size_t plane = grid.planes_deg.size() - 1; plane-- > 0;) {
        grid.planes_deg.push_back(2 * mirror - grid.planes_deg[plane]);
        for (std::size_t ring = 0; ring < rings; ++ring) {
            grid.intensity_cd.push_back(grid.intensity_cd[plane * rings + ring]);
        }
    }
}

void mirror_at_first_plane(PhotometricSolid::Grid& grid) {
    PhotometricSolid::Grid mirrored{grid.type, {}, grid.polar_deg, {}};
    const auto rings = static_cast<std::ptrdiff_t>(grid.polar_deg.size());
    for (std::size_t plane = grid.planes_deg.size(); plane-- > 0;) {
        mirrored.planes_deg.push_back(-grid.planes_deg[plane]);
        const auto first = grid.intensity_cd.begin() + static_cast<std::ptrdiff_t>(plane) * rings;
        mirrored.intensity_cd.insert(mirrored.intensity_cd.end(), first, first + rings);
    }
    mirror_at_last_plane(mirrored);
    grid = std::move(mirrored);
}

void close_circle(PhotometricSolid::Grid& grid) {
    const double turn_on = grid.planes_deg.front() + 360;
    if (same_angle(grid.planes_deg.back(), turn_on)) return;
    grid.planes_deg.push_back(turn_on);
    for (std::size_t ring = 0; ring < grid.polar_deg.size(); ++ring) {
        grid.intensity_cd.push_back(grid.intensity_cd[ring]);
    }
}

bool same_angle(double a_deg, double b_deg) {
    return std::abs(a_deg - b_deg) < PhotometricSolid::kSmallestStepDeg;
}

}  // namespace stilb::io
