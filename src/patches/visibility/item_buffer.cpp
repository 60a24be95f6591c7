
#include "patches/visibility/item_buffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "patches/visibility/opengl.h"
#include "stilb/error.h"

namespace stilb::patches {

namespace {

/// As RayCaster's offset, for positions relative to the centre.
constexpr double kRelativeLift = 0x1p-19;
constexpr double kEdgeMargin = 8;

double longest_edge_m(const Patches& patches, std::uint32_t patch) {
    const auto& [a, b, c] = patches.corners[patch];
    const Vec3 u(patches.vertices[a]), v(patches.vertices[b]), w(patches.vertices[c]);
    return std::max({length(v - u), length(w - v), length(u - w)});
}

}  // namespace

Viewpoint viewpoint_on(const Patches& patches, std::uint32_t side, const math::Barycentric& barycentric) {
    const std::uint32_t patch = patches.patch_of(side);
    const Vec3 wanted = patches.position(patch, barycentric), middle = patches.middle(patch);
    const double longest_m = longest_edge_m(patches, patch);
    const double lift_m = kRelativeLift * std::max(largest_coordinate(wanted - patches.center), longest_m);
    // A third of the least height is how far the middle is from an edge.
    const double middle_to_edge_m = 2 * patches.areas_m2[patch] / longest_m / 3;
    const double towards_middle = std::min(kEdgeMargin * lift_m / middle_to_edge_m, 1.0);
    const Vec3 normal = patches.normal_of(side);
    return {wanted + towards_middle * (middle - wanted) + lift_m * normal, Frame::around(normal)};
}

namespace {

constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

/// Five faces of a cube without the one behind, from `bottom` on upwards; the side faces have w up.
std::vector<BufferFace> sides_and_top(int resolution, int side_height, double bottom) {
    const auto side = [&](const Vec3& forward) {
        return BufferFace{cross(forward, kZ), kZ, forward, -1, bottom, resolution, side_height, 0};
    };
    return {{kX, -kY, kZ, -1, -1, resolution, resolution, 0}, side(kX), side(kY), side(-kX), side(-kY)};
}

/// The axes of the cube whose corner points along w.
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
        fmt::format("the resolution of item buffers is {}, but the horizon must lie between two rows of "
                    "pixels. Use an even number from 2 to {}, such as 512.",
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

namespace {

/// A packet is a square of pixels, whose rays are the most coherent.
constexpr int kTile = 4;
static_assert(kTile * kTile == kPacketWidth);

/// The rays through the pixels of a face: they share their origin, and their directions are linear in x
/// and y.
class FaceRays {
  public:
    FaceRays(const ItemBufferLayout& layout, const BufferFace& face, const Viewpoint& viewpoint,
             const Vec3& center)
        : layout_(layout), face_(face) {
        const auto direction = [&](int x, int y) {
            return viewpoint.frame.to_world(layout.pixel(face, x, y).direction);
        };
        first_ = direction(0, 0);
        step_x_ = direction(1, 0) - first_;
        step_y_ = direction(0, 1) - first_;
        const Vec3 origin = viewpoint.position - center;
        template_.origin_x.fill(static_cast<float>(origin.x));
        template_.origin_y.fill(static_cast<float>(origin.y));
        template_.origin_z.fill(static_cast<float>(origin.z));
        template_.end.fill(std::numeric_limits<float>::infinity());
    }

    /// The packet whose lower left pixel is (x0, y0).
    RayPacket packet(int x0, int y0) const {
        RayPacket rays = template_;
        for (int lane = 0; lane < kPacketWidth; ++lane) {
            const int x = x0 + lane % kTile, y = y0 + lane / kTile;
            rays.direction_x[lane] = packet_direction(first_.x + x * step_x_.x + y * step_y_.x);
            rays.direction_y[lane] = packet_direction(first_.y + x * step_x_.y + y * step_y_.y);
            rays.direction_z[lane] = packet_direction(first_.z + x * step_x_.z + y * step_y_.z);
        }
        return rays;
    }

    /// The lanes whose pixels are on the face and in front of the horizon.
    LaneMask lanes(int x0, int y0) const {
        LaneMask lanes{};
        for (int lane = 0; lane < kPacketWidth; ++lane) {
            const int x = x0 + lane % kTile, y = y0 + lane / kTile;
            const bool is_seen = y < face_.height && x < face_.width && x >= layout_.first_column(face_, y);
            lanes[lane] = is_seen ? -1 : 0;
        }
        return lanes;
    }

  private:
    const ItemBufferLayout& layout_;
    const BufferFace& face_;
    Vec3 first_, step_x_, step_y_;
    RayPacket template_;
};

}  // namespace

void RayItemBuffers::fill(const ItemBufferLayout& layout, const Viewpoint& viewpoint,
                          std::span<std::uint32_t> sides) {
    std::ranges::fill(sides, kNoSide);
    for (const BufferFace& face : layout.faces()) {
        const FaceRays rays(layout, face, viewpoint, caster_.patches().center);
        for (int y = 0; y < face.height; y += kTile) {
            for (int x = 0; x < face.width; x += kTile) {
                RayPacket packet = rays.packet(x, y);
                const LaneMask lanes = rays.lanes(x, y);
                const PatchHits seen = caster_.closest(packet, lanes);
                for (int lane = 0; lane < kPacketWidth; ++lane) {
                    if (lanes[lane] != 0)
                        sides[face.pixel_at(x + lane % kTile, y + lane / kTile)] = seen.sides[lane];
                }
            }
        }
    }
}

std::unique_ptr<ItemBuffers> make_item_buffers(BufferBackend backend, const PatchCaster& caster) {
    if (backend == BufferBackend::rays) return std::make_unique<RayItemBuffers>(caster);
    return std::make_unique<OpenGlItemBuffers>(caster.patches());
}

}  // namespace stilb::patches
