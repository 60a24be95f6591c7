// A material on a mesh with vertex normals, which approximates a smooth surface.
//
// Light transport uses the geometric normal: it alone determines cosines of transport, sides and
// visibility. The shading normal changes only the BRDF:
//
//     f*(in, out) = f(in, |out|) min(cos_s(in) / cos_g(in), kMostBrightening),   0 where cos_s(in) <= 0
//
// with `in` towards the light and `out` towards the camera, f in the frame of the shading normal, and |out|
// the direction `out`, mirrored to the front of that frame where it lies behind. So a surface has the
// appearance of the shading normal (f* cos_g = f cos_s), except where light grazes the triangle, whose shadow
// then begins softly. The reasons and the limits: docs/materials.md, "Smooth meshes".
//
// f* is not reciprocal: its arguments distinguish the direction of the light.
#pragma once

#include "materials/material.h"

namespace stilb::materials {

/// The largest ratio of the two cosines of a direction, which bounds the flux that single particles gain.
inline constexpr double kMostBrightening = 2;

/// A direction mirrored to the front of its frame.
inline Vec3 turned_to_front(const Vec3& v) { return {v.x, v.y, std::abs(v.z)}; }

/// Directions are in the frame of the geometric normal, as those of material.h: away from the surface. If
/// the normals are the same, every function returns the result of its counterpart in material.h, bit by bit.
/// Keeps a reference to the material.
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
    void set_material(const Material& material) { material_ = &material; }
    /// The frame of the geometric normal.
    const Frame& frame() const { return frame_; }
    /// Whether the shading normal differs.
    bool is_bent() const { return is_bent_; }
    /// The frame of the shading normal, in coordinates of frame().
    const Frame& shading() const { return shading_; }

    /// f* [1/sr], for the direction of the light and that of the camera.
    Rgb brdf_per_sr(const Vec3& in, const Vec3& out) const {
        return is_bent_ ? bent_brdf_per_sr(in, out) : evaluate_brdf_per_sr(*material_, in, out);
    }
    /// The density of `in` in sample_incoming(out).
    double pdf_of_incoming_per_sr(const Vec3& out, const Vec3& in) const;
    /// Both.
    ScatterValue evaluate(const Vec3& in, const Vec3& out) const;
    /// Samples a direction of incident light, for a walk against the light that came from `out`. The weight
    /// is f* cos_g(in) / pdf.
    std::optional<ScatterSample> sample_incoming(const Vec3& out, double u1, double u2) const;
    /// Samples the next direction of a particle that came from `in`. The weight is f* cos_g(out) / pdf.
    std::optional<ScatterSample> sample_outgoing(const Vec3& in, double u1, double u2) const;

    /// As specular_branches(), for a path that came from `from`: the branches towards the light if it carries
    /// luminance, towards the camera if it carries flux, for which `share` is computed. A mirrored direction
    /// that would lie below the triangle is turned upwards. Panes are treated as flat.
    SpecularBranches branches(LightSide side, const Vec3& from, Carried carried) const;

  private:
    SpecularBranches bent_branches_to_light(LightSide side, const Vec3& from) const;
    SpecularBranches bent_branches_to_camera(LightSide side, const Vec3& from) const;
    Rgb bent_brdf_per_sr(const Vec3& in, const Vec3& out) const;
    double pdf_of_outgoing_per_sr(const Vec3& shaded_in, const Vec3& out) const;
    std::optional<Vec3> bent_outgoing(const Vec3& shaded_in, double u1, double u2) const;

    const Material* material_;
    Frame frame_;
    Frame shading_{};
    bool is_bent_ = false;
};

}  // namespace stilb::materials
