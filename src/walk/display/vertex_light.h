// Direct light at the vertices of the displayed surfaces.
//
// A vertex may lie on the line where another body touches its surface, or below that body, where it is dark,
// while the visible surface around it is not: interpolation would draw a dark blob. So light is not sampled
// at the vertex itself but a little towards the middles of the triangles around it, and only where nothing
// covers them: no surface at a hair's breadth, and no side that no light ever reaches (the inside of a box).
#pragma once

#include <span>
#include <vector>

#include "patches/patches.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"
#include "scene/sealed_sides.h"
#include "walk/display/direct_light.h"

namespace stilb::walk {

/// A point that samples of a vertex are moved towards, on a side of a patch: the far end of a triangle at the
/// vertex.
struct Adjoining {
    Vec3 towards;
    std::uint32_t side = 0;
};

/// Keeps references to all arguments.
class VertexLight {
  public:
    VertexLight(const Scene& scene, const rays::RayCaster& caster, const patches::Patches& patches,
                const DirectLight& direct);

    /// Which sides of objects get any light; at first, all of them.
    void set_reached(std::vector<bool> is_reached) { is_reached_ = std::move(is_reached); }

    struct Result {
        double squared_error = 0;  ///< standard error, of the sum over lights [lx2]
        bool is_covered = false;   ///< nobody sees the surface here; there is no light
    };
    /// The illuminance [lx] of a vertex by each light. `normal`: unit; `around`: not empty.
    Result at(const Vec3& position, const Vec3& normal, std::span<const Adjoining> around,
              std::span<float> lx) const;

    std::size_t lights() const { return direct_.count(); }

  private:
    struct Sample {
        SurfacePoint point;
        std::uint32_t side = 0;
    };
    std::vector<Sample> free_samples(const Vec3& position, const Vec3& normal,
                                     std::span<const Adjoining> around, double share) const;
    bool is_covered(const Sample& sample) const;
    /// Whether something stands on the surface between the samples.
    bool are_divided(std::span<const Sample> samples) const;

    const Scene& scene_;
    const rays::RayCaster& caster_;
    const patches::Patches& patches_;
    const DirectLight& direct_;
    double hair_m_;  ///< the distance of surfaces that touch
    std::vector<bool> is_reached_;
};

}  // namespace stilb::walk
