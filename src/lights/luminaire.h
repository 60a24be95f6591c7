// Luminaires by their luminous intensity distribution (file type "photometry").
#pragma once

#include "base/vec.h"
#include "lights/light_kind.h"

namespace stilb::lights {

class LuminaireEmitter;

/// A luminaire that is small against its distance from every receiver.
struct Luminaire {
    Vec3 position;
    SolidId solid{};
    /// Columns of the luminaire's frame in world coordinates: towards C0, towards C90, towards the nadir.
    Vec3 c0, c90, nadir;
    /// Multiplies the solid's intensity: colour (luminance 1) times dimming or flux override.
    Rgb factor;

    static constexpr std::string_view kType = "photometry";
    static constexpr LightLocation kLocation = LightLocation::point;
    using Emitter = LuminaireEmitter;
    Rgb flux_lm(const Surroundings& surroundings) const;
    std::vector<LightDetail> details(const Surroundings& surroundings) const;
    void scale(const Rgb& by) { factor *= by; }
    LightOrigin origin() const { return {position, nadir}; }
    bool shines_like(const Luminaire& other) const {
        constexpr double same_cosine = 1 - 1e-6;
        return solid == other.solid && dot(nadir, other.nadir) >= same_cosine &&
               dot(c0, other.c0) >= same_cosine;
    }
    /// A direction in the frame of its solid.
    Vec3 in_solid(const Vec3& direction) const {
        return {dot(direction, c0), dot(direction, c90), dot(direction, nadir)};
    }
};

/// Keeps a reference to the solid. Its rays start and end lifted along the nadir, so that a luminaire may be
/// placed exactly in the plane of a ceiling.
class LuminaireEmitter {
  public:
    LuminaireEmitter(const Luminaire& light, const Surroundings& surroundings, const Lift& lift);

    Emission emit(math::SampleStream& stream) const;
    std::optional<IncidentLight> sample_incident(const SurfacePoint& at,
                                                 const std::array<double, 2>& u) const;
    double rough_illuminance_lx(const SurfacePoint& at) const;

    static constexpr std::string_view kNoun = "a luminaire";
    const Vec3& lifted() const { return lifted_; }
    LuminaireEmitter turned_into(const Frame& frame) const;
    double luminous_intensity_cd(const Vec3& direction) const;

  private:
    Luminaire light_;
    const PhotometricSolid* solid_;
    Vec3 lifted_;
};

// Orientation of luminaires in the scene.

/// Unit vectors of a luminaire's (left-handed) frame in the scene: towards C0, C90 and the nadir.
struct LuminaireFrame {
    Vec3 c0, c90, nadir;
};

/// The frame of a luminaire that first hangs straight down (nadir -z, C0 +x, C90 +y), is rotated about its
/// vertical axis by `spin_deg`, counterclockwise seen from behind, which is from above, and then tilted by
/// the shortest rotation of its nadir to `unit_aim`. For an aim of exactly +z that is a half turn about the x
/// axis.
LuminaireFrame aim_luminaire(const Vec3& unit_aim, double spin_deg);

}  // namespace stilb::lights

namespace stilb {
using lights::Luminaire;
}  // namespace stilb
