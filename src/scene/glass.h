// Smooth glass: the surface of a solid, and a thin sheet. Delta functions; lengths of paths in a solid and
// rough glass are not handled.
#pragma once

#include <optional>

#include "scene/scatter_sample.h"

namespace stilb {

/// The surface of a clear solid that stands in air.
struct Glass {
    double ior = 1.5;  ///< of the solid
};

/// A thin plane sheet with parallel faces in air.
struct Pane {
    double ior = 1.52;
    /// Share of the light that is left after one passage through the sheet along its normal, without what the
    /// faces do; in (0, 1].
    Spectrum internal_transmittance = Spectrum::grey(1);
};

/// From which side light comes to the surface of a solid.
enum class GlassSide { outside, inside };

/// Either of the two ways of light at a surface of glass. Its direction may lie below the surface.
struct GlassSample {
    ScatterSample scattered;  ///< weight: of flux, as a particle of light carries it
    /// Luminance L, the quantity that paths from a sensor carry, is `weight` times this of what it is on the
    /// other side: L / n^2 is kept in refraction, flux is kept as it is. With `in` as the direction that the
    /// path came by: (n of the side of `in` / n of the side of `direction`)^2; 1 in reflection.
    double luminance_factor = 1;
};

/// Reflection with the chance of Fresnel's reflectance, otherwise refraction by Snell's law: `in` with z > 0
/// away from the surface on the side that light comes from. The weight is 1.
std::optional<GlassSample> sample_glass(const Glass& material, GlassSide side, const Vec3& in, double u);

/// Shares of the flux that a pane reflects and lets pass.
struct PaneShares {
    Spectrum reflectance, transmittance;
};
/// Of unpolarised light at an angle of this cosine to the normal, with all inter-reflections: the mean of
/// both polarisations, each with r of a face and a = internal_transmittance^(1/cos inside) having T = (1-r)^2
/// a / (1 - r^2 a^2) and R = r + r a T.
PaneShares pane_shares(const Pane& material, double cosine);

/// Mirrored, or straight on (what the sheet shifts sideways is left out); drawn by the shares of luminance.
std::optional<ScatterSample> sample_pane(const Pane& material, const Vec3& in, double u);

}  // namespace stilb
