// Item buffers by rays and by OpenGL are the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "patches/backends.h"
#include "patches/rooms.h"
#include "patches/visibility/item_buffer.h"
#include "patches/visibility/opengl.h"

namespace stilb::patches {
namespace {

/// The patches that rays next to a pixel's middle meet, 1/128 of a pixel away in sixteen directions.
std::set<std::uint32_t> patches_around(const PatchCaster& caster, const ItemBufferLayout& layout,
                                       const BufferFace& face, int x, int y, const Viewpoint& viewpoint) {
    RayPacket rays;
    LaneMask lanes;
    lanes.fill(-1);
    const Vec3 origin = viewpoint.position - caster.patches().center;
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kPacketWidth,
                     away = layout.pixel_size() / 128;
        const Vec3 direction =
            viewpoint.frame.to_world(layout.pixel(face, x, y).direction +
                                     away * std::cos(angle) * face.right + away * std::sin(angle) * face.up);
        set_ray(rays, i, origin, direction);
    }
    std::set<std::uint32_t> met;
    for (const std::uint32_t side : caster.closest(rays, lanes).sides)
        met.insert(caster.patches().patch_of(side));
    return met;
}

bool have_a_common_corner(const Patches& patches, std::uint32_t p, std::uint32_t q) {
    return std::ranges::any_of(patches.corners[p], [&](std::uint32_t a) {
        return std::ranges::any_of(patches.corners[q], [&](std::uint32_t b) {
            return Vec3(patches.vertices[a]) == Vec3(patches.vertices[b]);
        });
    });
}

/// What OpenGL may see at a boundary: a patch that meets there. It need not be one that rays next to it meet:
/// at the outline of an object a patch that is seen edge-on, or lies hidden behind the outline, may stick out
/// of it by the rounding, with either side.
bool is_explained(const Patches& patches, const std::set<std::uint32_t>& around, std::uint32_t side) {
    if (side == kNoSide || around.size() < 2) return false;
    return std::ranges::any_of(around, [&](std::uint32_t patch) {
        return have_a_common_corner(patches, patch, patches.patch_of(side));
    });
}

struct Disagreement {
    std::size_t at_boundaries = 0;  ///< pixels whose right or upper neighbour shows another side
    std::size_t differ = 0, unexplained = 0;
};

Disagreement disagreement(const Patches& patches, const ItemBufferLayout& layout,
                          const Viewpoint& viewpoint) {
    const PatchCaster caster(patches);
    RayItemBuffers rays(caster);
    OpenGlItemBuffers opengl(patches);
    const auto by_rays = filled(rays, layout, viewpoint), by_opengl = filled(opengl, layout, viewpoint);
    Disagreement found;
    for (const BufferFace& face : layout.faces()) {
        for (int y = 0; y < face.height; ++y) {
            for (int x = layout.first_column(face, y); x < face.width; ++x) {
                const auto seen = [&](int i, int j) { return by_rays[face.pixel_at(i, j)]; };
                const bool has_other_neighbour = (x + 1 < face.width && seen(x + 1, y) != seen(x, y)) ||
                                                 (y + 1 < face.height && seen(x, y + 1) != seen(x, y));
                found.at_boundaries += has_other_neighbour ? 1 : 0;
                const std::uint32_t other = by_opengl[face.pixel_at(x, y)];
                if (seen(x, y) == other) continue;
                ++found.differ;
                const auto around = patches_around(caster, layout, face, x, y, viewpoint);
                found.unexplained += is_explained(patches, around, other) ? 0 : 1;
            }
        }
    }
    return found;
}

/// The two are the same picture, but for pixels whose middle lies on the boundary between patches: OpenGL
/// rounds corners to 1/256 of a pixel, so about one in a hundred at boundaries may differ.
TEST(ItemBufferBackends, AgreeButForTheEdgesOfPatches) {
    if (const auto why_not = missing_opengl()) GTEST_SKIP() << *why_not;
    const Patches patches = make_patches(furnished_room(), 0.12);
    for (const BufferShape shape :
         {BufferShape::cube, BufferShape::hemicube, BufferShape::cubic_tetrahedron}) {
        for (const int resolution : {64, 512, 2048}) {
            const auto found = disagreement(patches, {shape, resolution}, point_in_room());
            EXPECT_EQ(found.unexplained, 0u) << name_of(shape) << ", " << resolution;
            EXPECT_LT(found.differ, found.at_boundaries / 50) << name_of(shape) << ", " << resolution;
        }
    }
}

/// A sheet a millimetre above the floor, in few large patches, from above and from a hand's breadth above the
/// floor: depth is told apart over the whole range.
TEST(ItemBufferBackends, AgreeOnSheetsThatLieCloseTogether) {
    if (const auto why_not = missing_opengl()) GTEST_SKIP() << *why_not;
    Scene scene = empty_room();
    add_object(scene, Rectangle{{0.7, 0.6, 0.001}, {3.5, 0.1, 0}, {-0.1, 2.9, 0}}, diffuse(0.5));
    const Patches patches = make_patches(scene, 10);
    for (const Vec3& place : {Vec3{2.3, 1.9, 2.9}, {0.2, 0.3, 0.1}, {4.9, 3.9, 0.01}}) {
        const Viewpoint viewpoint{place, point_in_room().frame};
        const auto found = disagreement(patches, {BufferShape::cube, 1024}, viewpoint);
        EXPECT_EQ(found.unexplained, 0u) << place.z;
        EXPECT_LT(found.differ, found.at_boundaries / 50) << place.z;
    }
}

}  // namespace
}  // namespace stilb::patches
