
#include "patches/visibility/bundle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "patches/visibility/opengl.h"
#include "stilb/error.h"

namespace stilb::patches {

namespace {

constexpr double kRelativeTolerance = 0x1p-19;
/// The cosine below which surfaces count as edge-on: they are crossed too seldom to matter.
constexpr double kLeastCosine = 1e-3;
/// The square of a scene's size over the area of its surfaces above which there are cells.
constexpr double kSparse = 32;

}  // namespace

void CoincidentCrossings::remove_from(std::vector<Crossing>& crossings, double half_extent_m) const {
    const auto same = [&](const Crossing& before, const Crossing& after) {
        return is_same(before, after, half_extent_m);
    };
    crossings.erase(std::unique(crossings.begin(), crossings.end(), same), crossings.end());
}

void CoincidentCrossings::remove_from(std::vector<Crossing>& crossings, const Vec3& origin) const {
    const auto same = [&](const Crossing& before, const Crossing& after) {
        const Vec3 at = origin + double{after.distance} * direction_;
        return is_same(before, after, std::max(largest_coordinate(origin), largest_coordinate(at)));
    };
    crossings.erase(std::unique(crossings.begin(), crossings.end(), same), crossings.end());
}

bool CoincidentCrossings::is_same(const Crossing& before, const Crossing& after, double coordinate_m) const {
    const double gap_m = double{after.distance} - double{before.distance};
    const double tolerance_m = kRelativeTolerance * coordinate_m;
    // Comparing all normals takes time, and most crossings are far apart.
    if (gap_m * kLeastCosine > tolerance_m) return false;
    return patches_.is_front(before.side) == patches_.is_front(after.side) &&
           gap_m * std::abs(dot(direction_, patches_.normal_of(after.side))) <= tolerance_m;
}

namespace {

/// The margin before and behind the patches, for rounding.
constexpr double kRelativeMargin = 0x1p-18;

double half_extent_along(const Vec3& axis, const Vec3& half) {
    return std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z;
}

int line_count(double extent_m, double spacing_m) {
    const double count = std::ceil(extent_m / spacing_m);
    if (spacing_m > 0 && count <= kMostLines) return static_cast<int>(count);
    throw InputError(fmt::format(
        "the spacing of a bundle's rays is {:.3g} m, too small to cover {:.4g} m by at most {} rays. Use "
        "larger patches, for a spacing of {:.2g} m or more.",
        spacing_m, extent_m, kMostLines, extent_m / kMostLines));
}

}  // namespace

void CrossedLines::start(double line_area_m2) {
    line_area_m2_ = line_area_m2;
    origins_.clear();
    first_crossing_.resize(1);
    sides_.clear();
    distances_m_.clear();
}

void CrossedLines::add(const Vec3& origin, std::span<const Crossing> crossings) {
    if (crossings.empty()) return;
    origins_.push_back(origin);
    for (const Crossing& crossing : crossings) {
        sides_.push_back(crossing.side);
        distances_m_.push_back(crossing.distance);
    }
    first_crossing_.push_back(sides_.size());
}

LineGrid::LineGrid(const Bounds& bounds, const Bundle& bundle) {
    if (bounds.is_empty()) return;
    const auto& [u, v, w] = bundle.frame;
    const Vec3 middle = bounds.middle(), half = bounds.max - middle;
    const double half_u = half_extent_along(u, half), half_v = half_extent_along(v, half);
    const double half_w = half_extent_along(w, half) + kRelativeMargin * bounds.half_extent();
    width = line_count(2 * half_u, bundle.spacing_m);
    height = line_count(2 * half_v, bundle.spacing_m);
    step_x = bundle.spacing_m * u;
    step_y = bundle.spacing_m * v;
    first =
        middle - half_u * u - half_v * v - half_w * w + bundle.offset[0] * step_x + bundle.offset[1] * step_y;
    line_area_m2 = bundle.spacing_m * bundle.spacing_m;
    depth_m = 2 * half_w;
}

LineGrid::LineGrid(const LineCell& cell, const Bundle& bundle) : width(cell.lines[0]), height(cell.lines[1]) {
    const auto& [u, v, w] = bundle.frame;
    const double step_u = cell.size(0) / width, step_v = cell.size(1) / height;
    step_x = step_u * u;
    step_y = step_v * v;
    first = cell.min[0] * u + cell.min[1] * v + cell.start_m * w + bundle.offset[0] * step_x +
            bundle.offset[1] * step_y;
    line_area_m2 = step_u * step_v;
}

namespace {

/// A packet is a square of the grid, whose rays are the most coherent.
constexpr int kTile = 4;
static_assert(kTile * kTile == kPacketWidth);
static_assert(kTile == LineCell::kMostAlongEdge);

/// Casts the parallel rays of tiles.
class TileCaster {
  public:
    TileCaster(const PatchCaster& caster, const Vec3& direction) : caster_(caster), direction_(direction) {
        template_.direction_x.fill(packet_direction(direction.x));
        template_.direction_y.fill(packet_direction(direction.y));
        template_.direction_z.fill(packet_direction(direction.z));
        template_.end.fill(std::numeric_limits<float>::infinity());
    }

    /// The lines of the tile whose first line is (x0, y0), as far as they are on the grid.
    /// `reach_of(origin)` is what CoincidentCrossings::remove_from takes for a line.
    template <typename Reach>
    const CrossedLines& cast(const LineGrid& grid, int x0, int y0, const Reach& reach_of) {
        RayPacket packet = template_;
        LaneMask lanes{};
        std::array<Vec3, kPacketWidth> origins;
        for (int lane = 0; lane < kPacketWidth; ++lane) {
            const int x = x0 + lane % kTile, y = y0 + lane / kTile;
            const Vec3 from = origins[lane] = grid.origin(x, y);
            packet.origin_x[lane] = static_cast<float>(from.x);
            packet.origin_y[lane] = static_cast<float>(from.y);
            packet.origin_z[lane] = static_cast<float>(from.z);
            lanes[lane] = x < grid.width && y < grid.height ? -1 : 0;
        }
        caster_.all(packet, lanes, crossings_);
        lines_.start(grid.line_area_m2);
        for (int lane = 0; lane < kPacketWidth; ++lane) {
            coincident_.remove_from(crossings_[lane], reach_of(origins[lane]));
            lines_.add(caster_.patches().center + origins[lane], crossings_[lane]);
        }
        return lines_;
    }

  private:
    const PatchCaster& caster_;
    Vec3 direction_;
    RayPacket template_;
    CoincidentCrossings coincident_{caster_.patches(), direction_};
    PacketCrossings crossings_;
    CrossedLines lines_;
};

}  // namespace

RayBundles::RayBundles(const PatchCaster& caster) : caster_(caster), bounds_(bounds_of(caster.patches())) {
    const std::vector<float>& areas_m2 = caster.patches().areas_m2;
    const double area_m2 = std::accumulate(areas_m2.begin(), areas_m2.end(), 0.0);
    const double extent_m = 2 * bounds_.half_extent();
    has_cells_ = extent_m > 2 * scene::kLargeHalfExtent_m || extent_m * extent_m > kSparse * area_m2;
}

void RayBundles::cast(const Bundle& bundle, const LineVisitor& visit) const {
    return has_cells_ ? cast_cells(bundle, visit) : cast_uniform(bundle, visit);
}

void RayBundles::cast_uniform(const Bundle& bundle, const LineVisitor& visit) const {
    const LineGrid grid(bounds_, bundle);
    TileCaster tiles(caster_, bundle.frame.w);
    const double half_extent_m = bounds_.half_extent();
    for (int y = 0; y < grid.height; y += kTile) {
        for (int x = 0; x < grid.width; x += kTile) {
            const CrossedLines& lines = tiles.cast(grid, x, y, [&](const Vec3&) { return half_extent_m; });
            if (lines.count() > 0) visit(lines);
        }
    }
}

void RayBundles::cast_cells(const Bundle& bundle, const LineVisitor& visit) const {
    TileCaster tiles(caster_, bundle.frame.w);
    LineCells(caster_.patches(), bundle.frame).for_each([&](const LineCell& cell) {
        const CrossedLines& lines =
            tiles.cast(LineGrid(cell, bundle), 0, 0, [](const Vec3& origin) { return origin; });
        if (lines.count() > 0) visit(lines);
    });
}

std::unique_ptr<Bundles> make_bundles(BufferBackend backend, const PatchCaster& caster) {
    if (backend == BufferBackend::rays) return std::make_unique<RayBundles>(caster);
    return std::make_unique<OpenGlBundles>(caster.patches());
}

}  // namespace stilb::patches
