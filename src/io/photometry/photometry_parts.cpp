#include "io/photometry/photometry_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stilb::io {
namespace {

/// The largest credible intensity: a laser of a watt with a divergence of a milliradian has 1e9 cd.
constexpr double kGreatestIntensityCd = 1e12;

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Length of the UTF-8 sequence at the start of `text`; 0 for an invalid one, or a control character of two
/// bytes.
std::size_t utf8_length(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text[0]);
    if (lead < 0x80) return 1;
    const std::size_t length = lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
    if (length == 0 || length > text.size()) return 0;
    const std::string_view rest = text.substr(1, length - 1);
    if (!std::all_of(rest.begin(), rest.end(), is_continuation)) return 0;
    const auto second = static_cast<unsigned char>(text[1]);
    const bool below_range = (lead == 0xC2 || lead == 0xE0) ? second < 0xA0 : lead == 0xF0 && second < 0x90;
    const bool above_range = lead == 0xED ? second >= 0xA0 : lead == 0xF4 && second >= 0x90;
    return below_range || above_range ? 0 : length;
}

}  // namespace

std::vector<std::string_view> split_lines(std::string_view content) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (content.starts_with(kByteOrderMark)) content.remove_prefix(kByteOrderMark.size());
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

std::string printable(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const std::size_t length = utf8_length(text.substr(i));
        if (length == 1 || (length == 0 && byte < 0xA0)) {
            result += byte < 0x20 || byte >= 0x7F ? ' ' : text[i];
        } else if (length == 0) {
            result += {static_cast<char>(0xC0 | (byte >> 6)), static_cast<char>(0x80 | (byte & 0x3F))};
        } else {
            result += text.substr(i, length);
        }
        i += std::max<std::size_t>(length, 1);
    }
    return std::string(trimmed(result));
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
                     const std::string& file) {
    double peak = 0;
    for (const auto& [number, line] : numbers) {
        const double intensity = factor * number;
        if (number < 0) {
            throw InputError(fmt::format("intensity {} is negative: it must be 0 or more", number),
                             {file, line});
        }
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
