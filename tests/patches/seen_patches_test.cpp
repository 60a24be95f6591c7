// What item buffers see, by rays and by OpenGL: all of a closed scene, every patch with its solid angle.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>

#include "exact/configuration_factors.h"
#include "patches/backends.h"
#include "patches/rooms.h"

namespace stilb::patches {
namespace {

struct Accumulated {
    std::vector<double> by_side;  ///< integral of 1 (points) or of the cosine over what is seen of the side
    double everywhere = 0;
    std::size_t lost_pixels = 0;
};

Accumulated accumulated(const Patches& patches, const ItemBufferLayout& layout,
                        const std::vector<std::uint32_t>& sides) {
    Accumulated sums{std::vector<double>(2 * patches.count())};
    layout.for_each_pixel([&](std::size_t index, const BufferPixel& pixel) {
        const double weight = layout.shape() == BufferShape::cube ? 1 : pixel.cosine;
        if (sides[index] == kNoSide) {
            ++sums.lost_pixels;
            return;
        }
        sums.by_side[sides[index]] += weight * pixel.solid_angle_sr;
        sums.everywhere += weight * pixel.solid_angle_sr;
    });
    return sums;
}

class SeenPatches : public testing::TestWithParam<BufferBackend> {
  protected:
    void SetUp() override {
        if (GetParam() == BufferBackend::rays) return;
        if (const auto why_not = missing_opengl()) GTEST_SKIP() << *why_not;
    }
    void look_at(const Scene& scene, double patch_size_m) {
        patches_ = make_patches(scene, patch_size_m);
        caster_.emplace(patches_);
        buffers_ = make_item_buffers(GetParam(), *caster_);
    }
    Accumulated seen(const ItemBufferLayout& layout, const Viewpoint& viewpoint) {
        return accumulated(patches_, layout, filled(*buffers_, layout, viewpoint));
    }

    Patches patches_;
    std::optional<PatchCaster> caster_;
    std::unique_ptr<ItemBuffers> buffers_;
};

/// Of the triangle seen from `place` [Van Oosterom, Strackee 1983].
double solid_angle_sr(const std::array<Vec3, 3>& triangle, const Vec3& place) {
    const Vec3 a = triangle[0] - place, b = triangle[1] - place, c = triangle[2] - place;
    const double la = length(a), lb = length(b), lc = length(c);
    const double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    return 2 * std::atan2(std::abs(dot(a, cross(b, c))), denominator);
}

std::array<Vec3, 3> triangle_of(const Patches& patches, std::uint32_t patch) {
    return {patches.position(patch, {1, 0, 0}), patches.position(patch, {0, 1, 0}),
            patches.position(patch, {0, 0, 1})};
}

/// sum A_j r_ij = 1 for an isotropic point light; sum cos dW = pi over half spaces.
TEST_P(SeenPatches, FillTheWholeViewOfAClosedScene) {
    look_at(furnished_room(), 0.12);
    for (const int resolution : {64, 256, 1024}) {
        const double error = 5.0 / (resolution * resolution);
        const auto points = seen({BufferShape::cube, resolution}, point_in_room());
        EXPECT_EQ(points.lost_pixels, 0u);
        EXPECT_NEAR(points.everywhere / (4 * kPi), 1, error);
        for (const BufferShape shape : {BufferShape::hemicube, BufferShape::cubic_tetrahedron}) {
            const auto half = seen({shape, resolution}, point_in_room());
            EXPECT_EQ(half.lost_pixels, 0u);
            EXPECT_NEAR(half.everywhere / kPi, 1, error) << name_of(shape);
        }
    }
}

/// Every patch of an empty room by its exact solid angle. Pixels at its boundary are counted wholly or not at
/// all, so that the error of all falls with the pixel size at least.
TEST_P(SeenPatches, HaveTheirSolidAngle) {
    look_at(empty_room(), 0.7);
    const Viewpoint viewpoint = point_in_room();
    std::vector<double> error;
    for (const int resolution : {64, 256, 1024}) {
        const auto sums = seen({BufferShape::cube, resolution}, viewpoint);
        double wrong = 0;
        for (std::uint32_t p = 0; p < patches_.count(); ++p) {
            wrong += std::abs(sums.by_side[p] - solid_angle_sr(triangle_of(patches_, p), viewpoint.position));
        }
        error.push_back(wrong / (4 * kPi));
    }
    EXPECT_LT(error[0], 0.1);
    EXPECT_GT(error[0] / error[1], 4);
    EXPECT_GT(error[1] / error[2], 4);
}

/// The same for the cosine's integral, by Lambert's formula.
TEST_P(SeenPatches, HaveTheirConfigurationFactor) {
    look_at(empty_room(), 0.7);
    const Viewpoint viewpoint = point_in_room();
    for (const BufferShape shape : {BufferShape::hemicube, BufferShape::cubic_tetrahedron}) {
        std::vector<double> error;
        for (const int resolution : {64, 256, 1024}) {
            const auto sums = seen({shape, resolution}, viewpoint);
            double wrong = 0;
            for (std::uint32_t p = 0; p < patches_.count(); ++p) {
                wrong += std::abs(sums.by_side[p] -
                                  exact::illuminance_by_polygon_lx({viewpoint.position, viewpoint.frame.w},
                                                                   triangle_of(patches_, p), 1));
            }
            error.push_back(wrong / kPi);
        }
        EXPECT_LT(error[0], 0.1) << name_of(shape);
        EXPECT_GT(error[0] / error[1], 4) << name_of(shape);
        EXPECT_GT(error[1] / error[2], 4) << name_of(shape);
    }
}

/// A light sample in a corner of each patch of emitters that are flush with a ceiling, reach into a corner of
/// the room, stand free or are round: it does not see its own surface nor past a wall, and its whole flux
/// arrives: sum_j e_ij A_j = pi S_i / 3 for a luminance of 1.
TEST_P(SeenPatches, TakeAllLightOfASampleOnAnEmitter) {
    Scene scene = furnished_room();
    const auto first_light = static_cast<std::uint32_t>(scene.objects.size());
    add_area_light(scene, Rectangle{{2, 1, 3}, {0, 0.9, 0}, {0.6, 0, 0}}, Rgb::grey(1));
    add_area_light(scene, Rectangle{{5, 4, 2.2}, {0, -0.7, 0}, {0, 0, 0.8}}, Rgb::grey(1));
    add_area_light(scene, Box{{2, 3, 1.5}, {2.2, 3.3, 1.6}}, Rgb::grey(1));
    add_area_light(scene, Sphere{{1.2, 3, 2}, 0.12}, Rgb::grey(1));
    look_at(scene, 0.4);
    constexpr std::array<math::Barycentric, 3> corners{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (std::uint32_t p = patches_.first_of_object[first_light]; p < patches_.count(); ++p) {
        const auto sums = seen({BufferShape::hemicube, 32}, viewpoint_on(patches_, p, corners[p % 3]));
        EXPECT_EQ(sums.lost_pixels, 0u) << p;
        EXPECT_NEAR(sums.everywhere, kPi, 4e-3 * kPi) << p;
        const std::uint32_t object = index_of(patches_.object_of(p));
        const auto own = std::span(sums.by_side)
                             .subspan(patches_.first_of_object[object], patches_.first_of_object[object + 1] -
                                                                            patches_.first_of_object[object]);
        EXPECT_EQ(std::ranges::count(own, 0.0), std::ssize(own)) << p;
    }
}

/// From inside of a room all fronts; of a table top the side that one is on.
TEST_P(SeenPatches, ShowTheSideThatFacesTheViewer) {
    look_at(furnished_room(), 0.2);
    const ItemBufferLayout layout(BufferShape::cube, 128);
    constexpr std::uint32_t table = 2;
    for (const double height_m : {0.4, 1.7}) {
        const auto sums = seen(layout, {{2.4, 2, height_m}, Frame::around({0, 0, 1})});
        double front = 0, back = 0, hidden = 0;
        for (std::uint32_t p = 0; p < patches_.count(); ++p) {
            const bool is_table = patches_.object_of(p) == ObjectId{table};
            const bool is_disk = patches_.object_of(p) == ObjectId{4};
            if (is_table) front += sums.by_side[p], back += sums.by_side[patches_.other_side(p)];
            if (is_table || is_disk) continue;
            hidden += sums.by_side[patches_.other_side(p)];
        }
        EXPECT_GT(height_m > 0.75 ? front : back, 0.5);
        EXPECT_EQ(height_m > 0.75 ? back : front, 0);
        EXPECT_LT(hidden, 1e-3) << "a pixel or two at outlines, by OpenGL";
    }
}

TEST_P(SeenPatches, AreNoneInAnEmptyScene) {
    look_at(Scene{}, 1);
    EXPECT_EQ(seen({BufferShape::cube, 16}, point_in_room()).lost_pixels, 6u * 16 * 16);
}

INSTANTIATE_TEST_SUITE_P(Both, SeenPatches, testing::Values(BufferBackend::rays, BufferBackend::opengl),
                         name_of_backend);

}  // namespace
}  // namespace stilb::patches
