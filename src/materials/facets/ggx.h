// The GGX distribution of facets (Trowbridge, Reitz 1975; Walter et al. 2007), isotropic, with the
// height-correlated masking and shadowing of Smith [Heitz 2014, Understanding the masking-shadowing function,
// (99)]. All directions are unit vectors with z > 0, z along the surface's normal.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vec.h"
#include "math/sampling.h"

namespace stilb::materials {

/// Half-vector of two directions above the surface: the normal of the facet that mirrors one to the other.
inline Vec3 half_vector(const Vec3& in, const Vec3& out) {
    const Vec3 sum = in + out;
    const double size = length(sum);  // 0 only by underflow, along the surface
    return size > 0 ? sum / size : Vec3{0, 0, 1};
}

class Ggx {
  public:
    /// 0 < alpha <= 1.
    explicit Ggx(double alpha) : alpha_(alpha) {}

    double alpha() const { return alpha_; }

    /// D(h) [1/sr]. By the sine's square from x and y, which stays exact where alpha is small.
    double distribution_per_sr(const Vec3& half) const {
        const double spread = (half.x * half.x + half.y * half.y) / (alpha_ * alpha_) + half.z * half.z;
        return 1 / (std::numbers::pi * alpha_ * alpha_ * spread * spread);
    }
    /// D G2 / (4 in.z out.z) [1/sr]: the BRDF of facets that reflect everything.
    double brdf_per_sr(const Vec3& in, const Vec3& out, const Vec3& half) const {
        return distribution_per_sr(half) / (2 * (out.z * stretched(in) + in.z * stretched(out)));
    }
    /// Density of `out` if the facet is sampled from those visible from `in`: D G1(in) / (4 in.z).
    double pdf_per_sr(const Vec3& in, const Vec3& half) const {
        return distribution_per_sr(half) / (2 * (in.z + stretched(in)));
    }
    /// The probability G2 / G1(in) that light which meets a visible facet leaves towards `out`.
    double passing(const Vec3& in, const Vec3& out) const {
        return out.z * (in.z + stretched(in)) / (out.z * stretched(in) + in.z * stretched(out));
    }
    /// G1: the share of the facets that are not hidden from this direction.
    double shown(const Vec3& v) const { return 2 * v.z / (v.z + stretched(v)); }
    /// Samples a normal of those visible from `in`, with their density if the point is uniform over the unit
    /// disk [Heitz 2018, Sampling the GGX distribution of visible normals].
    Vec3 visible_normal(const Vec3& in, const math::DiskPoint& point) const;

  private:
    /// cos(theta) sqrt(1 + alpha^2 tan^2(theta)).
    double stretched(const Vec3& v) const {
        return std::sqrt(v.z * v.z + alpha_ * alpha_ * (v.x * v.x + v.y * v.y));
    }

    double alpha_;
};

/// The mean of f(in, normal) over the normals that are visible under this cosine, in = (sine, 0, cosine), for
/// an f that is even in y. By the midpoint rule on the disk of visible_normal(), denser near its rim, where
/// the few steep facets are by which smooth surfaces lose light.
/// `kRings`: more of them for an f that has edges, such as that of total reflection.
template <int kRings = 64, typename Function>
double mean_over_visible_normals(const Ggx& facets, double cosine, const Function& f) {
    constexpr int kRays = 64;
    const Vec3 in{std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine};
    double sum = 0;
    for (int i = 0; i < kRings; ++i) {
        const double to_rim = 1 - (i + 0.5) / kRings;
        const double radius = std::sqrt(1 - to_rim * to_rim * to_rim);
        double ring = 0;
        for (int j = 0; j < kRays; ++j) {
            const double phi = std::numbers::pi * ((j + 0.5) / kRays - 0.5);
            ring += f(in, facets.visible_normal(in, {radius * std::cos(phi), radius * std::sin(phi)}));
        }
        sum += 3 * to_rim * to_rim * ring;
    }
    return sum / (kRings * kRays);
}

inline Vec3 Ggx::visible_normal(const Vec3& in, const math::DiskPoint& point) const {
    // On the hemisphere that the facets become when the surface is stretched by 1/alpha, a visible normal is
    // a point of the hemisphere's projection along the stretched direction.
    const Vec3 view = normalized(Vec3{alpha_ * in.x, alpha_ * in.y, in.z});
    const double across = std::hypot(view.x, view.y);
    const Vec3 t1 = across > 0 ? Vec3{-view.y / across, view.x / across, 0} : Vec3{1, 0, 0};
    const Vec3 t2 = cross(view, t1);
    const double share = (1 + view.z) / 2;
    const double half_chord = std::sqrt(std::max(0.0, 1 - point.x * point.x));
    const double y = (1 - share) * half_chord + share * point.y;
    const double z = std::sqrt(std::max(0.0, 1 - point.x * point.x - y * y));
    const Vec3 normal = point.x * t1 + y * t2 + z * view;
    return normalized(Vec3{alpha_ * normal.x, alpha_ * normal.y, std::max(normal.z, 1e-12)});
}

}  // namespace stilb::materials
