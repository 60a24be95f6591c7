// Shares of the light by its angle, as data sheets give them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "base/rgb.h"

namespace stilb::materials {

/// Rows with linear interpolation between them, or a single one for light along the normal.
struct SharesByAngle {
    struct Row {
        double degrees = 0;  ///< to the normal
        Rgb share;
    };
    std::vector<Row> rows;  ///< ascending; empty where nothing is given

    static SharesByAngle along_normal(const Rgb& share) { return {{{0, share}}}; }
    bool is_given() const { return !rows.empty(); }
    bool is_along_normal() const { return rows.size() == 1; }
    /// By the rows; the first and the last one hold beyond them.
    Rgb at(double degrees) const;
    /// The first row whose angle does not exceed that of the row before; the number of rows where there is
    /// none.
    std::size_t first_out_of_order() const;
    static constexpr std::string_view kOutOfOrder = "its angle does not exceed that of the row before.";
};

/// Whether a parameter has a value: all but tables have one.
template <typename Value>
bool is_given(const Value&) {
    return true;
}
inline bool is_given(const SharesByAngle& shares) { return shares.is_given(); }

/// Of the angles.
inline constexpr Range kDegreesToNormal{0, 90, "from 0 to 90 degrees"};
/// As the functions of base/field.h.
void expect_inside(const SharesByAngle& shares, const Range& range, const std::string& path);

}  // namespace stilb::materials
