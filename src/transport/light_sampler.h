// Light sources as the estimators need them: particles that leave them, and their light at a given point.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lights/emitter_elements.h"
#include "math/discrete.h"
#include "math/sample_stream.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"

namespace stilb::lights {

/// A particle that has just left a light source.
struct EmittedParticle {
    Vec3 origin;  ///< lifted off the source
    Vec3 direction;
    Rgb flux_lm;              ///< total flux of the scene's lights, coloured by the chosen one
    bool from_point = false;  ///< from a point or photometry light: nothing can hit such a source
};

/// Light that arrives at a point from a sampled point of a source, visibility left out.
struct IncidentLight {
    Vec3 source_point;  ///< lifted off the source
    Vec3 direction;     ///< unit, towards the source
    /// Multiply by the cosine at the receiver (and the BRDF), and by visibility. The division by the density
    /// is in it; for a point source it is intensity / distance^2 [lx].
    Rgb normal_illuminance_lx;
    /// About the density of `direction`, as LightSampler::pdf_per_sr() has it: for weighing samples of lights
    /// against others. Infinite for point sources.
    double pdf_per_sr = 0;
};

/// All lights of a scene. Keeps references to both arguments. Immutable.
class LightSampler {
  public:
    /// `made_elsewhere`: of Scene::lights, those whose light something else brings to surfaces; none where it
    /// is empty. sample_one_light() never chooses them, and to pdf_per_sr() they are as if it always found
    /// them.
    LightSampler(const Scene& scene, const rays::RayCaster& caster, std::vector<bool> made_elsewhere = {});

    /// A particle drawn in proportion to the emitted luminous flux: light, position, direction.
    EmittedParticle sample_emission(math::SampleStream& stream) const;

    std::size_t count() const { return lights_.size(); }
    /// Point and photometry lights: light from them at a point is known exactly, without sampling.
    bool is_point_like(std::size_t light) const;

    /// Light from one source at `from`; point-like ones ignore `u`. Nothing where the sample's front is
    /// turned away.
    std::optional<IncidentLight> sample_incident(std::size_t light, const Vec3& from,
                                                 const std::array<double, 2>& u) const;
    /// As above from one source chosen by its unshadowed contribution at `from`; divided by the choice's
    /// probability.
    std::optional<IncidentLight> sample_one_light(const Vec3& from, const Vec3& normal,
                                                  math::SampleStream& stream) const;

    /// About the density with which sample_one_light() draws the direction to `hit`, on an emitter; 0 where
    /// it never does, infinite where the light is made elsewhere.
    double pdf_per_sr(const rays::Hit& hit, const Vec3& from, const Vec3& normal) const;
    /// The same of sample_incident() for the light that `hit` is on.
    double pdf_of_its_light_per_sr(const rays::Hit& hit, const Vec3& from) const;

    /// Luminance that leaves `hit` towards where the ray came from, of an emitter; zero elsewhere.
    Rgb emitted_luminance(const rays::Hit& hit) const;
    bool has_area_lights() const { return has_area_lights_; }

  private:
    struct Emitter {
        std::vector<lights::EmitterElement> elements;  ///< of an area light; empty for point-like ones
        math::DiscreteDistribution by_area;
        /// Of a point-like light: where its rays start. Luminaires are lifted along their nadir, so that one
        /// may be placed in the very plane of a ceiling.
        Vec3 middle;
        double radius_m = 0;
    };

    static constexpr std::uint32_t kNoLight = ~0u;

    std::optional<IncidentLight> sample_area_light(std::size_t light, const Vec3& from,
                                                   const std::array<double, 2>& u) const;
    bool is_made_elsewhere(std::size_t light) const {
        return !made_elsewhere_.empty() && made_elsewhere_[light];
    }
    double rough_illuminance(std::size_t light, const Vec3& from, const Vec3& normal) const;
    EmittedParticle emit(std::size_t light, math::SampleStream& stream) const;

    const Scene& scene_;
    const rays::RayCaster& caster_;
    std::vector<const Light*> lights_;
    std::vector<Emitter> emitters_;
    std::vector<Rgb> flux_lm_;
    math::DiscreteDistribution by_flux_;
    std::vector<Rgb> luminance_of_object_;
    std::vector<std::uint32_t> light_of_object_;  ///< kNoLight where it is none
    std::vector<bool> made_elsewhere_;
    bool has_area_lights_ = false;
};

}  // namespace stilb::lights
