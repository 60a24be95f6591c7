// Shares of the light by its angle, as data sheets give them.
#pragma once

#include <string>
#include <vector>

#include "base/field.h"
#include "base/rgb.h"

namespace stilb::materials {

/// Rows with linear interpolation between them, or a single one for light along the normal.
struct SharesByAngle {
    struct Row {
        double degrees = 0;  ///< to the normal
        Rgb share;

        bool operator==(const Row&) const = default;
    };
    std::vector<Row> rows;  ///< ascending; empty where nothing is given

    static SharesByAngle along_normal(const Rgb& share) { return {{{0, share}}}; }
    bool is_given() const { return !rows.empty(); }
    bool is_along_normal() const { return rows.size() == 1; }
    /// By the rows; the first and the last one hold beyond them.
    Rgb at(double degrees) const;
    bool operator==(const SharesByAngle&) const = default;
};

/// As the functions of base/field.h. Angles must ascend from 0 to at most 90 degrees.
void expect_inside(const SharesByAngle& shares, const Range& range, const std::string& path);

}  // namespace stilb::materials
