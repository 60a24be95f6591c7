// Item buffers: pictures all around a place, of which every pixel holds the side of the patch seen in it.
//
// A face of a buffer is a plane picture at distance 1, seen from the place. A pixel whose middle is at
// distance r and whose area is dA fills the solid angle dA / r^3, and the cosine at the place is that of its
// direction to the axis w (theory: [FirstShot (15)-(20)]). Both are the midpoint rule over pixels: what is
// summed up over a buffer is wrong by a share in proportion to 1 / resolution^2, and at boundaries of patches
// by 1 / resolution.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "math/sampling.h"
#include "patches/patches.h"
#include "patches/visibility/buffer_options.h"
#include "patches/visibility/patch_caster.h"

namespace stilb::patches {

// Places to look from.

/// A place in world coordinates, and the axes that it looks along; w is where a hemisphere is seen.
struct Viewpoint {
    Vec3 position;
    Frame frame;
};

/// A place on a side of a patch, looking along its normal: a light sample on an area light. It is lifted off
/// the surface, and drawn in from the patch's edges by eight times as much, as RayCaster does (ray_caster.h,
/// for the reasons): so it does not see its own plane, nor past a wall that begins at an edge of the patch. A
/// place may be a corner of the patch.
Viewpoint viewpoint_on(const Patches& patches, std::uint32_t side, const math::Barycentric& place);

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

/// Where the pixels of a buffer are. Plain and immutable; one for any number of viewpoints.
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
    /// tetrahedron cuts off. They belong to no direction, and see nothing.
    int first_column(const BufferFace& face, int y) const {
        return shape_ == BufferShape::cubic_tetrahedron ? face.width - 1 - y : 0;
    }
    BufferPixel pixel(const BufferFace& face, int x, int y) const;
    /// Calls `visit(index, pixel)` for all pixels in front of the horizon, by their place in the buffer.
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
    BufferShape shape_;
    int resolution_;
    double pixel_size_;
    std::vector<BufferFace> faces_;
};

/// One way of filling buffers. All ways agree but in pixels whose middle lies on the boundary between
/// patches, and where patches lie in one another.
class ItemBuffers {
  public:
    ItemBuffers() = default;
    ItemBuffers(const ItemBuffers&) = delete;
    ItemBuffers& operator=(const ItemBuffers&) = delete;
    virtual ~ItemBuffers() = default;

    /// Sets all pixels: `sides` has layout.pixel_count() places and becomes sides of patches (Patches), or
    /// kNoSide. Patches are seen from both sides.
    virtual void fill(const ItemBufferLayout& layout, const Viewpoint& viewpoint,
                      std::span<std::uint32_t> sides) = 0;
};

// Item buffers by rays.

/// Fills buffers on one thread; each thread may have an object of its own, they are light. Keeps a reference
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
