#include "patches/visibility/ray_item_buffers.h"

#include <algorithm>
#include <limits>

namespace stilb::patches {
namespace {

/// A packet is a square of pixels, whose rays stay closest together.
constexpr int kTile = 4;
static_assert(kTile * kTile == kPacketWidth);

/// The rays through the pixels of a face: they all begin in one place, and their directions are linear in x
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

    /// Those whose pixels are on the face and in front of the horizon.
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

}  // namespace stilb::patches
