// Item buffers: pictures in all directions from a viewpoint, whose pixels hold the visible sides of patches.
//
// A face of a buffer is a plane picture at distance 1 from the viewpoint. A pixel whose middle is at
// distance r and whose area is dA subtends the solid angle dA / r^3, and the cosine at the viewpoint is that
// of its direction to the axis w (theory: [FirstShot (15)-(20)]). Both are the midpoint rule over pixels:
// sums over a buffer are wrong by a share in proportion to 1 / resolution^2, and at boundaries of patches by
// 1 / resolution.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/vec.h"
#include "math/sampling.h"
#include "patches/patches.h"
#include "patches/visibility/buffer_options.h"
#include "patches/visibility/patch_caster.h"

namespace stilb::patches {

// Viewpoints.

/// A position in world coordinates, with axes; w is the axis of a hemisphere.
struct Viewpoint {
    Vec3 position;
    Frame frame;
};

/// A viewpoint on a side of a patch, facing along its normal: a light sample on an area light. It is lifted
/// off the surface, and moved inwards from the patch's edges by eight times as much, as RayCaster does
/// (ray_caster.h gives the reasons): so it sees neither its own plane, nor past a wall that begins at an edge
/// of the patch. The position may be a corner of the patch.
Viewpoint viewpoint_on(const Patches& patches, std::uint32_t side, const math::Barycentric& barycentric);

/// In the frame of the viewpoint. Pixel (0, 0) is at the lower left, rows follow one another upwards.
struct BufferFace {
    Vec3 right, up, forward;      ///< orthonormal; forward is away from the viewpoint, right x up = -forward
    double left = 0, bottom = 0;  ///< where the picture begins, along right and up
    int width = 0, height = 0;    ///< in pixels
    std::size_t first_pixel = 0;  ///< in the buffer

    std::size_t pixel_at(int x, int y) const {
        return first_pixel + static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

struct BufferPixel {
    Vec3 direction;  ///< in the frame of the viewpoint, through the pixel's middle; at distance 1 along
                     ///< `forward`, not a unit vector
    double solid_angle_sr = 0;
    double cosine = 0;  ///< of the angle to w; below 0 behind
};

/// The layout of the pixels of a buffer. Plain and immutable; one for any number of viewpoints.
class ItemBufferLayout {
  public:
    /// `resolution` is the number of pixels along the longest edge of a face: 2 units of length in cubes, 3
    /// in tetrahedra. Throws InputError where it is odd, below 2 or above 16384.
    ItemBufferLayout(BufferShape shape, int resolution);

    BufferShape shape() const { return shape_; }
    const std::vector<BufferFace>& faces() const { return faces_; }
    int resolution() const { return resolution_; }
    double pixel_size() const { return pixel_size_; }
    std::size_t pixel_count() const;

    /// Row y of a face begins with so many pixels that lie wholly behind the horizon, in the corner that a
    /// tetrahedron cuts off. They have no direction, and see nothing.
    int first_column(const BufferFace& face, int y) const {
        return shape_ == BufferShape::cubic_tetrahedron ? face.width - 1 - y : 0;
    }
    BufferPixel pixel(const BufferFace& face, int x, int y) const {
        // The horizon is the diagonal of a tetrahedron's faces: a pixel on it counts by half, at the centre
        // of the half in front.
        const bool is_on_horizon = shape_ == BufferShape::cubic_tetrahedron && x == first_column(face, y);
        const Vec3 middle = point(face, x + 0.5, y + 0.5);
        const double area = pixel_size_ * pixel_size_;
        return is_on_horizon ? seen_along(middle, point(face, x + 2. / 3, y + 2. / 3), area / 2)
                             : seen_along(middle, middle, area);
    }
    /// Calls `visit(index, pixel)` for all pixels in front of the horizon, with their index in the buffer.
    template <typename Visitor>
    void for_each_pixel(const Visitor& visit) const {
        for (const BufferFace& face : faces_) {
            for (int y = 0; y < face.height; ++y) {
                for (int x = first_column(face, y); x < face.width; ++x) {
                    visit(face.pixel_at(x, y), pixel(face, x, y));
                }
            }
        }
    }

  private:
    Vec3 point(const BufferFace& face, double x, double y) const {
        return face.forward + (face.left + x * pixel_size_) * face.right +
               (face.bottom + y * pixel_size_) * face.up;
    }
    static BufferPixel seen_along(const Vec3& middle, const Vec3& counted, double area) {
        const double r = length(counted);
        return {middle, area / (r * r * r), counted.z / r};
    }

    BufferShape shape_;
    int resolution_;
    double pixel_size_;
    std::vector<BufferFace> faces_;
};

/// The interface of item buffer backends. They agree except for pixels whose middle lies on the boundary
/// between patches, and where patches overlap.
class ItemBuffers {
  public:
    ItemBuffers() = default;
    ItemBuffers(const ItemBuffers&) = delete;
    ItemBuffers& operator=(const ItemBuffers&) = delete;
    virtual ~ItemBuffers() = default;

    /// Sets all pixels: `sides` has layout.pixel_count() elements, which become sides of patches (Patches),
    /// or kNoSide. Patches are seen from both sides.
    virtual void fill(const ItemBufferLayout& layout, const Viewpoint& viewpoint,
                      std::span<std::uint32_t> sides) = 0;
};

/// By rays or by OpenGL. Keeps a reference to the caster or its patches. Throws InputError where OpenGL is
/// requested but missing.
std::unique_ptr<ItemBuffers> make_item_buffers(BufferBackend backend, const PatchCaster& caster);

// Item buffers by rays.

/// Fills buffers on one thread; each thread may have a cheap object of its own. Keeps a reference
/// to the caster.
class RayItemBuffers : public ItemBuffers {
  public:
    explicit RayItemBuffers(const PatchCaster& caster) : caster_(caster) {}

    void fill(const ItemBufferLayout& layout, const Viewpoint& viewpoint,
              std::span<std::uint32_t> sides) override;

  private:
    const PatchCaster& caster_;
};

}  // namespace stilb::patches
