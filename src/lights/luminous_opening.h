// Luminaires that shine from their luminous opening.
//
// The opening is the surface of a convex body. Its luminance is the same at all points that a direction sees:
//
//     L(w) = I(w) / A(w),   A(w) = integral over the surface of max(0, n w) dA,
//
// with the file's intensity I and the opening's projected area A. So the intensity at a distance is the
// file's. Near the opening each of its elements dA sends I(w) max(0, n w) dA / A(w): of a flat opening the
// file's distribution, its share by area. Real luminaires have brighter and darker parts; only near-field
// measurements (CIE 70, LM-94) tell them.
#pragma once

#include "lights/emitter_surface.h"
#include "lights/luminaire.h"

namespace stilb::lights {

class OpeningEmitter;

struct LuminousOpening {
    ObjectId object{};    ///< the surface of the opening
    Luminaire luminaire;  ///< at the middle of the opening

    static constexpr std::string_view kType = "photometry";
    static constexpr LightLocation kLocation = LightLocation::surface;
    using Emitter = OpeningEmitter;
    Rgb flux_lm(const Surroundings& surroundings) const { return luminaire.flux_lm(surroundings); }
    std::vector<LightDetail> details(const Surroundings& surroundings) const;
    /// Over all points and directions of the front.
    Rgb mean_luminance_cd_m2(const Surroundings& surroundings) const;
    void scale(const Rgb& by) { luminaire.scale(by); }
    bool shines_like(const LuminousOpening& other) const { return luminaire.shines_like(other.luminaire); }
};

/// Keeps a reference to the solid. No direction with intensity sees nothing of the opening.
class OpeningEmitter {
  public:
    OpeningEmitter(const LuminousOpening& light, const Surroundings& surroundings, const Lift& lift);

    Emission emit(math::SampleStream& stream) const;
    std::optional<IncidentLight> sample_incident(const SurfacePoint& at,
                                                 const std::array<double, 2>& u) const;
    double rough_illuminance_lx(const SurfacePoint& at) const;

    /// Of the front, for a unit direction that leaves it.
    Rgb luminance_cd_m2(const Vec3& leaving) const;
    double pdf_per_sr(std::uint32_t triangle, const Vec3& position, const Vec3& normal,
                      const Vec3& from) const {
        return surface_.pdf_per_sr(triangle, position, normal, from);
    }

  private:
    Luminaire luminaire_;
    const PhotometricSolid* solid_;
    double flux_lm_;  ///< luminous
    EmitterSurface surface_;
};

}  // namespace stilb::lights

namespace stilb {
using lights::LuminousOpening;
}  // namespace stilb
