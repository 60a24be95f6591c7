// Where the pixels of item buffers are: their solid angles and cosines add up.
#include "patches/visibility/item_buffer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stilb/error.h"

namespace stilb::patches {
namespace {

constexpr std::array kShapes{BufferShape::cube, BufferShape::hemicube, BufferShape::cubic_tetrahedron};

struct Sums {
    double solid_angle_sr = 0, projected_sr = 0;
    std::size_t pixels = 0;
};

Sums sums_over(const ItemBufferLayout& layout) {
    Sums sums;
    layout.for_each_pixel([&](std::size_t, const BufferPixel& pixel) {
        sums.solid_angle_sr += pixel.solid_angle_sr;
        sums.projected_sr += std::max(pixel.cosine, 0.0) * pixel.solid_angle_sr;
        ++sums.pixels;
    });
    return sums;
}

TEST(ItemBufferLayout, SolidAnglesAddUpToTheSphereOrTheHemisphere) {
    for (const BufferShape shape : kShapes) {
        const double whole = shape == BufferShape::cube ? 4 * kPi : 2 * kPi;
        for (int resolution = 64; resolution <= 2048; resolution *= 2) {
            const Sums sums = sums_over(ItemBufferLayout(shape, resolution));
            const double of_second_order = 5.0 / (resolution * resolution);
            EXPECT_NEAR(sums.solid_angle_sr, whole, whole * of_second_order) << name_of(shape) << resolution;
            EXPECT_NEAR(sums.projected_sr, kPi, kPi * of_second_order) << name_of(shape) << resolution;
        }
    }
}

TEST(ItemBufferLayout, HasTheNumberOfPixelsOfItsShape) {
    constexpr std::size_t r = 64;
    const auto pixels = [](BufferShape shape) { return sums_over(ItemBufferLayout(shape, r)).pixels; };
    EXPECT_EQ(pixels(BufferShape::cube), 6 * r * r);
    EXPECT_EQ(pixels(BufferShape::hemicube), 3 * r * r);
    EXPECT_EQ(pixels(BufferShape::cubic_tetrahedron), 3 * r * (r + 1) / 2);
    EXPECT_EQ(ItemBufferLayout(BufferShape::cubic_tetrahedron, r).pixel_count(), 3 * r * r);
}

/// Faces are pictures as OpenGL draws them, and their edges meet: neighbours across an edge look almost
/// alike.
TEST(ItemBufferLayout, FacesAreRightHandedAndInFrontOfTheHorizon) {
    for (const BufferShape shape : kShapes) {
        const ItemBufferLayout layout(shape, 32);
        for (const BufferFace& face : layout.faces()) {
            EXPECT_NEAR(length(cross(face.right, face.up) + face.forward), 0, 1e-15);
            EXPECT_NEAR(length(face.right), 1, 1e-15);
            EXPECT_NEAR(dot(face.right, face.up), 0, 1e-15);
        }
        if (shape == BufferShape::cube) continue;
        layout.for_each_pixel([&](std::size_t, const BufferPixel& pixel) {
            EXPECT_GT(pixel.cosine, 0);
            EXPECT_GE(pixel.direction.z, -1e-12);
        });
    }
}

/// The cosine by the closed forms of the two half spaces: 1/r and z/r, (x + y + 1) / (sqrt(3) r).
TEST(ItemBufferLayout, CosinesAreThoseOfTheClosedForms) {
    const ItemBufferLayout hemicube(BufferShape::hemicube, 16),
        tetrahedron(BufferShape::cubic_tetrahedron, 16);
    for (std::size_t f = 0; f < hemicube.faces().size(); ++f) {
        const double x = -1 + 11.5 / 8, y = (f == 0 ? -1 : 0) + 3.5 / 8, r = std::sqrt(x * x + y * y + 1);
        EXPECT_NEAR(hemicube.pixel(hemicube.faces()[f], 11, 3).cosine, (f == 0 ? 1 : y) / r, 1e-15);
    }
    for (const BufferFace& face : tetrahedron.faces()) {
        const double x = -2 + 11.5 * 3 / 16, y = -2 + 9.5 * 3 / 16, r = std::sqrt(x * x + y * y + 1);
        EXPECT_NEAR(tetrahedron.pixel(face, 11, 9).cosine, (x + y + 1) / (std::sqrt(3) * r), 1e-15);
        EXPECT_NEAR(length(face.right + face.up + face.forward - Vec3{0, 0, std::sqrt(3)}), 0, 1e-14);
    }
}

TEST(ItemBufferLayout, RefusesResolutionsThatCutTheHorizon) {
    for (const int resolution : {0, -2, 7, 16386}) {
        EXPECT_THROW(ItemBufferLayout(BufferShape::hemicube, resolution), InputError) << resolution;
    }
}

}  // namespace
}  // namespace stilb::patches
