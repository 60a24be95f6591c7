// A material on a surface that is to look smoother than it is: a mesh with vertex normals.
//
// Light is carried by the geometric normal: it alone decides about cosines of transport, sides and
// visibility. The shading normal changes the BRDF and nothing else:
//
//     f*(in, out) = f(in, |out|) min(cos_s(in) / cos_g(in), kMostBrightening),   0 where cos_s(in) <= 0
//
// with `in` towards the light and `out` towards the eye, f in the frame of the shading normal, and |out| the
// direction `out`, mirrored to the front of that frame where it lies behind. So a surface looks as if it had
// the shading normal (f* cos_g = f cos_s), but where light grazes the triangle, whose shadow then begins
// softly. The reasons, and what is kept and lost: docs/materials.md, "Smooth meshes".
//
// f* is not reciprocal: whoever evaluates it must know which direction the light comes from.
#pragma once

#include "materials/material.h"

namespace stilb::materials {

/// The largest ratio of the two cosines of a direction: what bounds the flux that single particles gain.
inline constexpr double kMostBrightening = 2;

/// What goes along a path: luminance from the eye's point of view, or the flux of particles. Bent surfaces
/// treat them differently, so that both make the same light.
enum class Carried { luminance, flux };

/// A direction mirrored to the front of its frame.
inline Vec3 turned_to_front(const Vec3& v) { return {v.x, v.y, std::abs(v.z)}; }

/// Directions are in the frame of the geometric normal, as those of material.h: away from the surface. Where
/// the normals are the same, every function returns what that of material.h does, to the last bit. Keeps a
/// reference to the material.
class ShadedSurface {
  public:
    /// Unit normals, less than a right angle apart.
    ShadedSurface(const Material& material, const Vec3& normal, const Vec3& shading_normal)
        : material_(&material), frame_(Frame::of_surface(normal)) {
        if (shading_normal == normal) return;
        const Frame shading = Frame::of_surface(shading_normal);
        shading_ = {frame_.to_local(shading.u), frame_.to_local(shading.v), frame_.to_local(shading.w)};
        is_bent_ = true;
    }

    const Material& material() const { return *material_; }
    /// Of the geometric normal.
    const Frame& frame() const { return frame_; }
    /// Whether the shading normal is another.
    bool is_bent() const { return is_bent_; }
    /// The frame of the shading normal, in coordinates of frame().
    const Frame& shading() const { return shading_; }

    /// f* [1/sr], from the direction of the light to that of the eye.
    Rgb brdf_per_sr(const Vec3& in, const Vec3& out) const {
        return is_bent_ ? bent_brdf_per_sr(in, out) : evaluate_brdf_per_sr(*material_, in, out);
    }
    /// The density with which sample_incoming(out) draws `in`.
    double pdf_of_incoming_per_sr(const Vec3& out, const Vec3& in) const;
    /// Both.
    ScatterValue evaluate(const Vec3& in, const Vec3& out) const;
    /// A direction that light comes from, for a walk against the light that came from `out`. The weight is f*
    /// cos_g(in) / pdf.
    std::optional<ScatterSample> sample_incoming(const Vec3& out, double u1, double u2) const;
    /// A direction that a particle goes to, which came from `in`. The weight is f* cos_g(out) / pdf.
    std::optional<ScatterSample> sample_outgoing(const Vec3& in, double u1, double u2) const;

    /// As specular_branches(), for a path that came from `from`: the ways on to the light where it carries
    /// luminance, to the eye where it carries flux, which `share` is made for. A mirrored direction that
    /// would lie below the triangle is turned up. Sheets that light passes straight are as flat as they are.
    SpecularBranches branches(LightSide side, const Vec3& from, Carried carried) const;

  private:
    SpecularBranches bent_branches_to_light(LightSide side, const Vec3& from) const;
    SpecularBranches bent_branches_to_eye(LightSide side, const Vec3& from) const;
    Rgb bent_brdf_per_sr(const Vec3& in, const Vec3& out) const;
    double pdf_of_outgoing_per_sr(const Vec3& shaded_in, const Vec3& out) const;
    std::optional<Vec3> bent_outgoing(const Vec3& shaded_in, double u1, double u2) const;

    const Material* material_;
    Frame frame_;
    Frame shading_{};
    bool is_bent_ = false;
};

}  // namespace stilb::materials
