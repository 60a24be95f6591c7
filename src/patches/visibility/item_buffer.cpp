#include "patches/visibility/item_buffer.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/error.h"

namespace stilb::patches {
namespace {

constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

/// Five faces of a cube without the one behind, from `bottom` on upwards; the side faces have w up.
std::vector<BufferFace> sides_and_top(int resolution, int side_height, double bottom) {
    const auto side = [&](const Vec3& forward) {
        return BufferFace{cross(forward, kZ), kZ, forward, -1, bottom, resolution, side_height, 0};
    };
    return {{kX, -kY, kZ, -1, -1, resolution, resolution, 0}, side(kX), side(kY), side(-kX), side(-kY)};
}

/// The axes of the cube whose corner w points to.
std::vector<BufferFace> tetrahedron_faces(int resolution) {
    const double third = std::sqrt(1. / 3), sixth = std::sqrt(1. / 6), half = std::sqrt(1. / 2);
    const Vec3 a{2 * sixth, 0, third}, b{-sixth, half, third}, c{-sixth, -half, third};
    const auto face = [&](const Vec3& right, const Vec3& up, const Vec3& forward) {
        return BufferFace{right, up, forward, -2, -2, resolution, resolution, 0};
    };
    return {face(b, a, c), face(c, b, a), face(a, c, b)};
}

std::vector<BufferFace> faces_of(BufferShape shape, int resolution) {
    if (shape == BufferShape::cubic_tetrahedron) return tetrahedron_faces(resolution);
    if (shape == BufferShape::hemicube) return sides_and_top(resolution, resolution / 2, 0);
    auto faces = sides_and_top(resolution, resolution, -1);
    faces.push_back({kX, kY, -kZ, -1, -1, resolution, resolution, 0});
    return faces;
}

void check(int resolution) {
    constexpr int kMost = 16384;
    if (resolution >= 2 && resolution <= kMost && resolution % 2 == 0) return;
    throw InputError(
        fmt::format("the resolution of item buffers is {}: the horizon must lie between two rows of "
                    "pixels. Take an even number from 2 to {}, such as 512.",
                    resolution, kMost));
}

}  // namespace

ItemBufferLayout::ItemBufferLayout(BufferShape shape, int resolution)
    : shape_(shape),
      resolution_(resolution),
      pixel_size_((shape == BufferShape::cubic_tetrahedron ? 3.0 : 2.0) / resolution) {
    check(resolution);
    faces_ = faces_of(shape, resolution);
    std::size_t first = 0;
    for (BufferFace& face : faces_) {
        face.first_pixel = first;
        first = face.pixel_at(0, face.height);
    }
}

std::size_t ItemBufferLayout::pixel_count() const { return faces_.back().pixel_at(0, faces_.back().height); }

BufferPixel ItemBufferLayout::pixel(const BufferFace& face, int x, int y) const {
    const auto point = [&](double dx, double dy) {
        return face.forward + (face.left + (x + dx) * pixel_size_) * face.right +
               (face.bottom + (y + dy) * pixel_size_) * face.up;
    };
    // The horizon is the diagonal of a tetrahedron's faces: pixels on it count by half, at the centre of the
    // half that is in front.
    const bool is_on_horizon = shape_ == BufferShape::cubic_tetrahedron && x == first_column(face, y);
    const double part = is_on_horizon ? 0.5 : 1, centre = is_on_horizon ? 2. / 3 : 0.5;
    const Vec3 counted = point(centre, centre);
    const double r = length(counted);
    return {point(0.5, 0.5), part * pixel_size_ * pixel_size_ / (r * r * r), counted.z / r};
}

}  // namespace stilb::patches
