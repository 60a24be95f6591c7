
#include "patches/visibility/bundle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "patches/visibility/opengl.h"
#include "stilb/error.h"

namespace stilb::patches {

namespace {

constexpr double kRelativeTolerance = 0x1p-19;
/// The cosine below which surfaces count as edge-on: they are crossed too seldom to matter.
constexpr double kLeastCosine = 1e-3;

}  // namespace

CoincidentCrossings::CoincidentCrossings(const Patches& patches, const Bounds& bounds, const Vec3& direction)
    : patches_(patches), direction_(direction), tolerance_m_(kRelativeTolerance * bounds.half_extent()) {}

void CoincidentCrossings::remove_from(std::vector<Crossing>& crossings) const {
    const auto same = [&](const Crossing& before, const Crossing& after) { return is_same(before, after); };
    crossings.erase(std::unique(crossings.begin(), crossings.end(), same), crossings.end());
}

bool CoincidentCrossings::is_same(const Crossing& before, const Crossing& after) const {
    const double gap_m = double{after.distance} - double{before.distance};
    // Comparing all normals takes time, and most crossings are far apart.
    if (gap_m * kLeastCosine > tolerance_m_) return false;
    return patches_.is_front(before.side) == patches_.is_front(after.side) &&
           gap_m * std::abs(dot(direction_, patches_.normal_of(after.side))) <= tolerance_m_;
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
    throw InputError(
        fmt::format("the spacing of a bundle's rays is {} m, too small to cover {} m by at most {} rays. Use "
                    "{:.2g} m or more.",
                    spacing_m, extent_m, kMostLines, extent_m / kMostLines));
}

}  // namespace

void CrossedLines::clear() {
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
    depth_m = 2 * half_w;
}

namespace {

/// A packet is a square of the grid, whose rays are the most coherent.
constexpr int kTile = 4;
static_assert(kTile * kTile == kPacketWidth);

/// The parallel rays of a tile.
class GridRays {
  public:
    GridRays(const LineGrid& grid, const Vec3& direction) : grid_(grid) {
        template_.direction_x.fill(packet_direction(direction.x));
        template_.direction_y.fill(packet_direction(direction.y));
        template_.direction_z.fill(packet_direction(direction.z));
        template_.end.fill(std::numeric_limits<float>::infinity());
    }

    Vec3 origin(int x0, int y0, int lane) const { return grid_.origin(x0 + lane % kTile, y0 + lane / kTile); }

    RayPacket packet(int x0, int y0) const {
        RayPacket rays = template_;
        for (int lane = 0; lane < kPacketWidth; ++lane) {
            const Vec3 from = origin(x0, y0, lane);
            rays.origin_x[lane] = static_cast<float>(from.x);
            rays.origin_y[lane] = static_cast<float>(from.y);
            rays.origin_z[lane] = static_cast<float>(from.z);
        }
        return rays;
    }

    /// The lanes that are on the grid.
    LaneMask lanes(int x0, int y0) const {
        LaneMask lanes{};
        for (int lane = 0; lane < kPacketWidth; ++lane) {
            const bool is_on_grid = x0 + lane % kTile < grid_.width && y0 + lane / kTile < grid_.height;
            lanes[lane] = is_on_grid ? -1 : 0;
        }
        return lanes;
    }

  private:
    const LineGrid& grid_;
    RayPacket template_;
};

}  // namespace

void RayBundles::cast(const Bundle& bundle, const LineVisitor& visit) const {
    const LineGrid grid(bounds_, bundle);
    const Patches& patches = caster_.patches();
    const GridRays rays(grid, bundle.frame.w);
    const CoincidentCrossings coincident(patches, bounds_, bundle.frame.w);
    PacketCrossings crossings;
    CrossedLines lines;
    for (int y = 0; y < grid.height; y += kTile) {
        for (int x = 0; x < grid.width; x += kTile) {
            caster_.all(rays.packet(x, y), rays.lanes(x, y), crossings);
            lines.clear();
            for (int lane = 0; lane < kPacketWidth; ++lane) {
                coincident.remove_from(crossings[lane]);
                lines.add(patches.center + rays.origin(x, y, lane), crossings[lane]);
            }
            if (lines.count() > 0) visit(lines);
        }
    }
}

std::unique_ptr<Bundles> make_bundles(BufferBackend backend, const PatchCaster& caster) {
    if (backend == BufferBackend::rays) return std::make_unique<RayBundles>(caster);
    return std::make_unique<OpenGlBundles>(caster.patches());
}

}  // namespace stilb::patches
