// Transparent media, smooth interfaces between two of them, and glass, the solid bounded by such faces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>

#include "materials/model.h"

namespace stilb::materials {

/// Shares of the flux that are reflected, for light polarised across (s) and along (p) the plane of
/// incidence.
struct FresnelReflectance {
    double s = 0, p = 0;

    double unpolarised() const { return (s + p) / 2; }
};

/// Cosine of the refracted ray's angle to the normal, for light that arrives at an angle of `cosine` >= 0; 0
/// for total reflection. `ior` is that of the far side over that of the near one.
double refracted_cosine(double cosine, double ior);

/// Fresnel's equations [Born, Wolf 1999, Principles of optics, 1.5.2 (21)]. 1 beyond the angle of total
/// reflection.
FresnelReflectance fresnel_reflectance(double cosine, double ior);

/// The substance inside of a solid, or around it.
struct Medium {
    double ior = 1;
    std::array<double, kBands> absorption_per_m{};  ///< by Beer's law, per band

    auto operator<=>(const Medium&) const = default;
    bool is_clear() const { return absorption_per_m == std::array<double, kBands>{}; }
    /// The share of the light that is not absorbed over a path of this length.
    Rgb left_after(double way_m) const {
        Rgb left;
        for (std::size_t b = 0; b < kBands; ++b) left[b] = std::exp(-absorption_per_m[b] * way_m);
        return left;
    }
};

inline constexpr Range kColorOfSolid{1e-6, 1, "from 1e-6 to 1 (the share of the light that is left)"};
inline constexpr Range kDistanceOfColor{1e-6, 1e6, "a length from 1e-6 to 1e6 m"};

/// The surface of a solid that absorbs, but does not scatter: light is divided by Fresnel's equations for
/// unpolarised light and refracted by Snell's law.
struct Dielectric {
    double ior = 1.5;  ///< of the solid
    Rgb color = Rgb::grey(1);
    double distance_m = 1;
    Medium outside{};  ///< around it: that of another solid that it lies in (scene/glass.h)

    static constexpr std::string_view kType = "glass";
    static constexpr auto fields() {
        return std::tuple{Field{"ior", &Dielectric::ior, kIor, "refractive index of the solid"},
                          Field{"color", &Dielectric::color, kColorOfSolid,
                                "share of the light that is left after the distance", Presence::optional},
                          Field{"distance", &Dielectric::distance_m, kDistanceOfColor,
                                "the way through the solid after which light has the color [m], 1 by default",
                                Presence::optional}};
    }
    Medium inside() const {
        Medium medium{ior, {}};
        for (std::size_t b = 0; b < kBands; ++b) {
            if (color[b] < 1) medium.absorption_per_m[b] = -std::log(color[b]) / distance_m;
        }
        return medium;
    }

    SpecularBranches branches(LightSide side, const Vec3& in) const;
    Rgb reflectance_bound() const { return Rgb::grey(1); }
};

inline double refracted_cosine(double cosine, double ior) {
    return std::sqrt(std::max(0.0, 1 - (1 - cosine) * (1 + cosine) / (ior * ior)));
}

inline FresnelReflectance fresnel_reflectance(double cosine, double ior) {
    if (ior == 1) return {};
    const double refracted = refracted_cosine(cosine, ior);
    const double across = (cosine - ior * refracted) / (cosine + ior * refracted);
    const double along = (ior * cosine - refracted) / (ior * cosine + refracted);
    return {across * across, along * along};
}

inline SpecularBranches Dielectric::branches(LightSide side, const Vec3& in) const {
    const double far_over_near = side == LightSide::outside ? ior / outside.ior : outside.ior / ior;
    const double reflectance = fresnel_reflectance(in.z, far_over_near).unpolarised();
    SpecularBranches branches;
    branches.add({mirrored(in), Rgb::grey(reflectance)});
    if (reflectance < 1) {
        const Vec3 refracted = normalized(
            Vec3{-in.x / far_over_near, -in.y / far_over_near, -refracted_cosine(in.z, far_over_near)});
        branches.add({refracted, Rgb::grey(1 - reflectance), 1 / (far_over_near * far_over_near)});
    }
    return branches;
}

}  // namespace stilb::materials

namespace stilb {
using materials::Dielectric;
}  // namespace stilb
