#include "materials/shares_by_angle.h"

#include <fmt/format.h>

#include <algorithm>

namespace stilb::materials {

Rgb SharesByAngle::at(double degrees) const {
    const auto above = std::ranges::upper_bound(rows, degrees, {}, &Row::degrees);
    if (above == rows.begin()) return rows.front().share;
    if (above == rows.end()) return rows.back().share;
    const Row& below = *(above - 1);
    const double fraction = (degrees - below.degrees) / (above->degrees - below.degrees);
    return below.share * (1 - fraction) + above->share * fraction;
}

std::size_t SharesByAngle::first_out_of_order() const {
    const auto found = std::ranges::adjacent_find(
        rows, [](const Row& row, const Row& next) { return !(next.degrees > row.degrees); });
    return found == rows.end() ? rows.size() : static_cast<std::size_t>(found - rows.begin()) + 1;
}

void expect_inside(const SharesByAngle& shares, const Range& range, const std::string& path) {
    for (std::size_t i = 0; i < shares.rows.size(); ++i) {
        const std::string row = fmt::format("{}[{}]", path, i);
        stilb::expect_inside(shares.rows[i].degrees, kDegreesToNormal, row + "[0]");
        stilb::expect_inside(shares.rows[i].share, range, shares.is_along_normal() ? path : row + "[1]");
    }
    const std::size_t wrong = shares.first_out_of_order();
    if (wrong < shares.rows.size()) fail_at(fmt::format("{}[{}]", path, wrong), SharesByAngle::kOutOfOrder);
}

}  // namespace stilb::materials
