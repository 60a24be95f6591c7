#include "materials/shares_by_angle.h"

#include <fmt/format.h>

#include <algorithm>

namespace stilb::materials {
namespace {

constexpr Range kDegrees{0, 90, "from 0 to 90 degrees"};

}  // namespace

Rgb SharesByAngle::at(double degrees) const {
    const auto above = std::ranges::upper_bound(rows, degrees, {}, &Row::degrees);
    if (above == rows.begin()) return rows.front().share;
    if (above == rows.end()) return rows.back().share;
    const Row& below = *(above - 1);
    const double fraction = (degrees - below.degrees) / (above->degrees - below.degrees);
    return below.share * (1 - fraction) + above->share * fraction;
}

void expect_inside(const SharesByAngle& shares, const Range& range, const std::string& path) {
    for (std::size_t i = 0; i < shares.rows.size(); ++i) {
        const auto& [degrees, share] = shares.rows[i];
        const std::string row = fmt::format("{}[{}]", path, i);
        stilb::expect_inside(degrees, kDegrees, row + "[0]");
        stilb::expect_inside(share, range, shares.is_along_normal() ? path : row + "[1]");
        if (i > 0 && !(degrees > shares.rows[i - 1].degrees))
            fail_at(row, fmt::format("the angle {} does not exceed that of the row before, {}.", degrees,
                                     shares.rows[i - 1].degrees));
    }
}

}  // namespace stilb::materials
