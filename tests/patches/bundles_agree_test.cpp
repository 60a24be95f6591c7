// Bundles by rays and by OpenGL are the same.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "patches/backends.h"
#include "patches/rooms.h"
#include "patches/visibility/bundle.h"
#include "patches/visibility/opengl.h"

namespace stilb::patches {
namespace {

using Sides = std::vector<std::uint32_t>;

/// Per line of the grid, row by row. Lines that meet nothing have no sides.
class MetByLines {
  public:
    MetByLines(const Bundles& bundles, const LineGrid& grid, const Bundle& bundle, const Vec3& center)
        : width_(grid.width), sides_(static_cast<std::size_t>(grid.width) * grid.height) {
        bundles.cast(bundle, [&](const CrossedLines& lines) {
            for (std::size_t i = 0; i < lines.count(); ++i) {
                const CrossedLine line = lines.line(i);
                const Vec3 place = (line.origin - center - grid.first) / bundle.spacing_m;
                Sides& sides = sides_.at(
                    index(std::lround(dot(place, bundle.frame.u)), std::lround(dot(place, bundle.frame.v))));
                EXPECT_TRUE(sides.empty());
                sides.assign(line.sides.begin(), line.sides.end());
            }
        });
    }
    const Sides& at(int x, int y) const { return sides_.at(index(x, y)); }

  private:
    std::size_t index(long x, long y) const { return static_cast<std::size_t>(y * width_ + x); }

    long width_;
    std::vector<Sides> sides_;
};

/// Whether rays around a line, 1/128 of the spacing away, do not all meet the same.
bool is_at_boundary(const PatchCaster& caster, const Vec3& origin, const Bundle& bundle) {
    RayPacket rays;
    LaneMask lanes;
    lanes.fill(-1);
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kPacketWidth;
        const double away_m = bundle.spacing_m / 128;
        const Vec3 from =
            origin + away_m * (std::cos(angle) * bundle.frame.u + std::sin(angle) * bundle.frame.v);
        set_ray(rays, i, from, bundle.frame.w);
    }
    PacketCrossings crossings;
    caster.all(rays, lanes, crossings);
    std::set<Sides> ways;
    for (const auto& of_lane : crossings) {
        Sides way;
        for (const Crossing& crossing : of_lane) way.push_back(crossing.side);
        ways.insert(way);
    }
    return ways.size() > 1;
}

/// The two meet the same, but for lines that go through the boundary between patches: OpenGL rounds corners
/// to 1/256 of the spacing, and each layer adds its boundaries.
TEST(BundleBackends, AgreeButForTheEdgesOfPatches) {
    if (const auto why_not = missing_opengl()) GTEST_SKIP() << *why_not;
    const Patches patches = make_patches(room_without_overlaps(), 0.12);
    const PatchCaster caster(patches);
    const RayBundles rays(caster);
    const OpenGlBundles opengl(patches);
    for (const double spacing_m : {0.1, 0.01, 0.0025}) {
        const Bundle bundle{point_in_room().frame, spacing_m, {0.3, 0.8}};
        const LineGrid grid(bounds_of(patches), bundle);
        const MetByLines by_rays(rays, grid, bundle, patches.center);
        const MetByLines by_opengl(opengl, grid, bundle, patches.center);
        std::size_t at_boundaries = 0, differ = 0, unexplained = 0;
        for (int y = 1; y < grid.height; ++y) {
            for (int x = 1; x < grid.width; ++x) {
                const Sides& met = by_rays.at(x, y);
                if (met != by_rays.at(x - 1, y) || met != by_rays.at(x, y - 1)) ++at_boundaries;
                if (met == by_opengl.at(x, y)) continue;
                ++differ;
                if (!is_at_boundary(caster, grid.origin(x, y), bundle)) ++unexplained;
            }
        }
        EXPECT_EQ(unexplained, 0u) << spacing_m;
        EXPECT_LT(differ, at_boundaries / 50) << spacing_m;
    }
}

}  // namespace
}  // namespace stilb::patches
