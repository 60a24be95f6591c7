// The plane across the lines of a bundle, divided as the patches are: for scenes in which things lie far
// apart, or are of very different sizes.
//
// Cells are rectangles that cover the projections of all patches, and of what lies between them as little as
// possible. A rectangle is shrunk to what is in it and halved, until a grid of four by four lines at most is
// as fine as its patches need: spacing L / sqrt(8), which is about two lines across a patch of longest edge
// L, as everywhere; L^2 is the harmonic mean over the patches in the cell, so that small patches decide.
//
// The cells follow from the direction and the patches alone. So where the offset of the grids is uniform,
// sums over all lines, each with its cell's cross-section for a line, are as unbiased as with one grid.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/vec.h"
#include "patches/patches.h"

namespace stilb::patches {

/// Along the axes u, v and w of a bundle, relative to Patches::center [m].
struct LineCell {
    static constexpr int kMostAlongEdge = 4;

    std::array<double, 2> min{}, max{};  ///< along u and v
    double start_m = 0;                  ///< along w: all patches in the cell lie behind
    std::array<int, 2> lines{};          ///< along u and v

    double size(std::size_t axis) const { return max[axis] - min[axis]; }
};

/// Keeps a reference to the patches.
class LineCells {
  public:
    /// w is the direction of the lines.
    LineCells(const Patches& patches, const Frame& frame);

    /// Calls `visit` for each cell with patches, one after the other.
    void for_each(const std::function<void(const LineCell&)>& visit) const;

  private:
    /// A patch as the lines see it.
    struct Seen {
        std::array<double, 2> min, max;
        double least_w = 0, most_w = 0;
        double per_squared_edge = 0;  ///< 1 / L^2 [1/m2]
    };
    using Numbers = std::vector<std::uint32_t>;

    void divide(LineCell cell, const Numbers& numbers,
                const std::function<void(const LineCell&)>& visit) const;
    LineCell shrunk(const LineCell& cell, const Numbers& numbers) const;
    /// Sets the cell's lines, and returns whether they are few enough.
    bool set_lines(LineCell& cell, const Numbers& numbers) const;
    double start_of(const LineCell& cell, const Numbers& numbers) const;
    /// The least w of a patch within the cell.
    double least_w_in(const LineCell& cell, std::uint32_t patch) const;

    const Patches& patches_;
    Frame frame_;
    std::vector<Seen> seen_;
};

}  // namespace stilb::patches
