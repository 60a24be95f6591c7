#include "patches/visibility/ray_bundles.h"

#include <limits>

#include "patches/visibility/coincident_crossings.h"

namespace stilb::patches {
namespace {

/// A packet is a square of the grid, whose rays stay closest together.
constexpr int kTile = 4;
static_assert(kTile * kTile == kPacketWidth);

/// The rays of a tile. All go the same way.
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

    /// Those that are on the grid.
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

}  // namespace stilb::patches
