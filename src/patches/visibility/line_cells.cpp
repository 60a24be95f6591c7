#include "patches/visibility/line_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace stilb::patches {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLinesPerSquaredEdge = 8;
/// Lines begin before the patches by this share of the largest coordinate, for rounding.
constexpr double kRelativeMargin = 0x1p-18;

}  // namespace

LineCells::LineCells(const Patches& patches, const Frame& frame) : patches_(patches), frame_(frame) {
    seen_.reserve(patches.count());
    for (const Triangle& corners : patches.corners) {
        Bounds along;
        double squared_edge_m2 = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 corner(patches.vertices[corners[k]]), next(patches.vertices[corners[(k + 1) % 3]]);
            along.include(frame.to_local(corner));
            squared_edge_m2 = std::max(squared_edge_m2, squared_length(next - corner));
        }
        seen_.push_back({{along.min.x, along.min.y},
                         {along.max.x, along.max.y},
                         along.min.z,
                         along.max.z,
                         1 / squared_edge_m2});
    }
}

void LineCells::for_each(const std::function<void(const LineCell&)>& visit) const {
    Numbers all(seen_.size());
    std::iota(all.begin(), all.end(), 0u);
    divide({{-kInfinity, -kInfinity}, {kInfinity, kInfinity}}, all, visit);
}

void LineCells::divide(LineCell cell, const Numbers& numbers,
                       const std::function<void(const LineCell&)>& visit) const {
    if (numbers.empty()) return;
    cell = shrunk(cell, numbers);
    if (set_lines(cell, numbers)) {
        cell.start_m = start_of(cell, numbers);
        return visit(cell);
    }
    const std::size_t axis = cell.size(0) > cell.size(1) ? 0 : 1;
    const double middle = (cell.min[axis] + cell.max[axis]) / 2;
    LineCell lower = cell, upper = cell;
    lower.max[axis] = upper.min[axis] = middle;
    Numbers part;
    std::ranges::copy_if(numbers, std::back_inserter(part),
                         [&](std::uint32_t n) { return seen_[n].min[axis] < middle; });
    divide(lower, part, visit);
    part.clear();
    std::ranges::copy_if(numbers, std::back_inserter(part),
                         [&](std::uint32_t n) { return seen_[n].max[axis] >= middle; });
    divide(upper, part, visit);
}

LineCell LineCells::shrunk(const LineCell& cell, const Numbers& numbers) const {
    LineCell small = cell;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        double min = kInfinity, max = -kInfinity;
        for (const std::uint32_t n : numbers) {
            min = std::min(min, seen_[n].min[axis]);
            max = std::max(max, seen_[n].max[axis]);
        }
        small.min[axis] = std::max(min, cell.min[axis]);
        small.max[axis] = std::min(max, cell.max[axis]);
    }
    return small;
}

bool LineCells::set_lines(LineCell& cell, const Numbers& numbers) const {
    double sum = 0;
    for (const std::uint32_t n : numbers) sum += seen_[n].per_squared_edge;
    const double spacing_m = std::sqrt(static_cast<double>(numbers.size()) / sum / kLinesPerSquaredEdge);
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const double count = std::ceil(cell.size(axis) / spacing_m);
        if (count > LineCell::kMostAlongEdge) return false;
        cell.lines[axis] = std::max(1, static_cast<int>(count));
    }
    return true;
}

double LineCells::start_of(const LineCell& cell, const Numbers& numbers) const {
    double least = kInfinity;
    for (const std::uint32_t n : numbers) least = std::min(least, least_w_in(cell, n));
    const double largest = std::max({std::abs(least), std::abs(cell.min[0]), std::abs(cell.max[0]),
                                     std::abs(cell.min[1]), std::abs(cell.max[1])});
    return least - kRelativeMargin * largest;
}

/// Large patches reach far beyond the cell: their plane tells where they are in it.
double LineCells::least_w_in(const LineCell& cell, std::uint32_t patch) const {
    const Seen& seen = seen_[patch];
    const Vec3 normal = frame_.to_local(Vec3(patches_.normals[patch]));
    const Vec3 corner = frame_.to_local(Vec3(patches_.vertices[patches_.corners[patch][0]]));
    if (normal.z == 0) return seen.least_w;
    double least = kInfinity;
    for (const double u : {cell.min[0], cell.max[0]}) {
        for (const double v : {cell.min[1], cell.max[1]}) {
            least = std::min(least,
                             corner.z - (normal.x * (u - corner.x) + normal.y * (v - corner.y)) / normal.z);
        }
    }
    return std::clamp(least, seen.least_w, seen.most_w);
}

}  // namespace stilb::patches
