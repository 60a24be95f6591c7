// Sampling of light sources: particles that leave them, and their light at a given point.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "lights/light.h"
#include "math/random.h"
#include "math/sampling.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"
#include "transport/light_choice.h"
#include "transport/light_parts.h"

namespace stilb::transport {

using lights::IncidentLight;

/// The light of a lamp at a point of a surface, if nothing lies in between.
struct DirectSample {
    rays::Segment segment;  ///< of its shadow ray
    Rgb illuminance_lx;     ///< its mean over the samples is that of the whole lamp
};

/// Nothing where a sample of a light brings none.
inline std::optional<DirectSample> direct_sample(const std::optional<IncidentLight>& incident,
                                                 const SurfacePoint& at) {
    if (!incident) return std::nullopt;
    const double cosine = dot(incident->direction, at.normal);
    if (!(cosine > 0) || !(incident->normal_illuminance_lx.max() > 0)) return std::nullopt;
    return DirectSample{{at.lifted, incident->source_point}, cosine * incident->normal_illuminance_lx};
}

/// A particle that has just left a light source.
struct EmittedParticle {
    Vec3 origin;  ///< lifted off the source
    Vec3 direction;
    /// Its light's flux over the probability of the choice: the total flux of the scene's lights over
    /// `favour`, coloured by the chosen one.
    Rgb flux_lm;
    bool from_point = false;  ///< from a light that no ray can hit
    std::uint32_t light = 0;  ///< of Scene::lights
    /// The frequency of such particles over that in proportion to the flux.
    double favour = 1;
};

/// All lights of a scene. The kinds of lights (lights/) define their light; the sampler chooses among lights.
/// Keeps references to scene and its solids. Immutable.
class LightSampler {
  public:
    /// `made_elsewhere`: the lights of Scene::lights whose light another method computes; none if it
    /// is empty. sample_one_light() never chooses them, and pdf_per_sr() treats them as if it always found
    /// them.
    /// Throws InputError where several lights are at infinity.
    LightSampler(const Scene& scene, const rays::RayCaster& caster, std::vector<bool> made_elsewhere = {});

    /// Samples a particle about in proportion to the emitted luminous flux: light, position, direction. Light
    /// from infinity, most of which misses a scene of rooms, gets at most as many as all others together,
    /// and weak lights get more (weak_lights.h).
    EmittedParticle sample_emission(math::SampleStream& stream) const;

    /// A particle of one light.
    lights::Emission emit(std::size_t light, math::SampleStream& stream) const {
        return std::visit([&](const auto& emitter) { return emitter.emit(stream); }, emitters_[light]);
    }

    std::size_t count() const { return emitters_.size(); }
    /// Light from a point source is computed exactly, without sampling.
    bool is_point(std::size_t light) const { return locations_[light] == LightLocation::point; }

    /// Samples the light of one source; point sources ignore `u`. Nothing where the sample's front faces
    /// away.
    std::optional<IncidentLight> sample_incident(std::size_t light, const SurfacePoint& at,
                                                 const std::array<double, 2>& u) const;
    /// Its approximate unshadowed illuminance of a surface, of weak lights more (weak_lights.h); 0 only where
    /// that is exactly 0, or where the light is made elsewhere.
    double rough_illuminance_lx(std::size_t light, const SurfacePoint& at) const;
    /// The factor in that by which a light is favoured in choices at points.
    double choice_favour(std::size_t light) const { return choice_favours_[light]; }
    /// Samples one source, chosen by its unshadowed contribution (approximately, if there are many
    /// lights); divided by the choice's probability. Allocates no memory.
    std::optional<IncidentLight> sample_one_light(const SurfacePoint& at, math::SampleStream& stream) const;
    /// Calls `visit(light)` for so many samples, whose sources are chosen in the same way and evenly: each
    /// source as often as is its expected number, but for one; divided by their expected numbers.
    template <typename Visit>
    void sample_some_lights(const SurfacePoint& at, std::uint32_t samples, math::SampleStream& stream,
                            const Visit& visit) const {
        sample_some(all_, at, samples, stream, visit);
    }

    /// Calls `visit(light)` for samples of all lights but points: for one of each or, where there are many
    /// and the point has a normal, for some that are chosen as in sample_one_light(), divided by their
    /// expected numbers.
    template <typename Visit>
    void sample_extended(const SurfacePoint& at, math::SampleStream& stream, const Visit& visit) const;
    /// Whether that chooses some, not all of them.
    bool chooses_extended() const { return !extended_.is_empty(); }
    /// The approximate density of the direction to `hit` over all samples of sample_extended(); likewise for
    /// a ray that leaves the scene.
    double extended_pdf_per_sr(std::size_t light, const rays::Hit& hit, const SurfacePoint& at) const;

    /// Calls `visit(light, luminance)` for each light whose emitter `hit` is on, with the luminance that
    /// leaves in a unit direction: for several where emitters lie in one place, whose light adds up.
    template <typename Visit>
    void for_each_emission(const rays::Hit& hit, const Vec3& leaving, const Visit& visit) const;

    /// The approximate density of the direction to `hit`, on an emitter of `light`, in sample_one_light();
    /// infinite where the light is made elsewhere.
    double pdf_per_sr(std::size_t light, const rays::Hit& hit, const SurfacePoint& at) const;
    /// The same for sample_incident() with the light.
    double pdf_of_its_light_per_sr(std::size_t light, const rays::Hit& hit, const SurfacePoint& at) const;

    /// Luminance that leaves `hit`, on an emitter, in a unit direction; zero elsewhere. `parts`: may be null.
    Rgb emitted_luminance(const rays::Hit& hit, const Vec3& leaving, LightParts* parts = nullptr) const;
    /// The same of the front of a light on a surface.
    Rgb front_luminance(std::size_t light, const Vec3& leaving) const;
    /// Luminance from outside of the scene along a ray that leaves it in a unit direction.
    Rgb outside_luminance(const Vec3& direction) const;
    /// As pdf_per_sr() and pdf_of_its_light_per_sr(), for such a ray.
    double outside_pdf_per_sr(const Vec3& direction, const SurfacePoint& at) const;
    double pdf_of_outside_light_per_sr(const Vec3& direction, const SurfacePoint& at) const;
    bool has_light_from_outside() const { return outside_ != kNoLight; }
    /// Its number. Precondition: there is one.
    std::uint32_t light_from_outside() const { return outside_; }
    /// Whether the light of some lights is computed elsewhere.
    bool leaves_out_lights() const { return !made_elsewhere_.empty(); }
    /// Whether rays can meet light.
    bool has_visible_lights() const { return has_visible_lights_; }
    /// The leaves of a tree of the lights at finite distance that meet a condition on their numbers.
    template <typename Condition>
    std::vector<LightTree::Light> leaves(const Scene& scene, const Condition& condition) const {
        std::vector<LightTree::Light> all;
        for (std::uint32_t light = 0; light < count(); ++light) {
            if (light != outside_ && condition(light)) all.push_back(leaf(scene, light));
        }
        return all;
    }

  private:
    static constexpr std::uint32_t kNoLight = ~0u;
    /// Samples of sample_extended(), where it chooses.
    static constexpr std::uint32_t kExtended = 32;

    void add(const Light& light, const Scene& scene, const rays::RayCaster& caster);
    LightTree::Light leaf(const Scene& scene, std::uint32_t light) const;
    void set_choice_favours(const rays::RayCaster& caster);
    void join_emitters_in_one_place(const Scene& scene, const rays::RayCaster& caster);
    bool is_made_elsewhere(std::size_t light) const {
        return !made_elsewhere_.empty() && made_elsewhere_[light];
    }
    /// The density of sample_one_light(), by that of samples of the light alone.
    double times_choice(double pdf_per_sr, std::size_t light, const SurfacePoint& at) const;
    /// Calls `visit(light)` for evenly chosen samples of a light, divided by their expected numbers.
    template <typename Visit>
    void sample_some(const LightChoice& choice, const SurfacePoint& at, std::uint32_t samples,
                     math::SampleStream& stream, const Visit& visit) const;
    std::optional<IncidentLight> sample_chosen(std::size_t light, double expected, const SurfacePoint& at,
                                               const std::array<double, 2>& u) const;
    bool chooses_extended(const SurfacePoint& at) const { return chooses_extended() && !at.is_in_open(); }

    std::vector<lights::Emitter> emitters_;
    std::vector<LightLocation> locations_;
    std::vector<Rgb> flux_lm_;
    std::vector<double> emission_favours_, choice_favours_;
    math::DiscreteDistribution by_emission_;
    std::vector<std::uint32_t> light_of_object_;  ///< kNoLight for objects without a light
    /// For each light another one whose emitter lies in the same place, in a ring; itself where it is alone.
    std::vector<std::uint32_t> next_in_place_;
    std::vector<bool> made_elsewhere_;
    LightChoice all_;                   ///< that are not made elsewhere
    LightChoice extended_;              ///< those with a surface, where they are many
    std::uint32_t outside_ = kNoLight;  ///< the light from infinity
    bool has_visible_lights_ = false;
};

template <typename Visit>
void LightSampler::for_each_emission(const rays::Hit& hit, const Vec3& leaving, const Visit& visit) const {
    const std::uint32_t own = light_of_object_[index_of(hit.object)];
    if (!hit.on_front || own == kNoLight) return;
    std::uint32_t light = own;
    do {
        const Rgb luminance = front_luminance(light, leaving);
        if (luminance.max() > 0) visit(light, luminance);
        light = next_in_place_[light];
    } while (light != own);
}

template <typename Visit>
void LightSampler::sample_some(const LightChoice& choice, const SurfacePoint& at, std::uint32_t samples,
                               math::SampleStream& stream, const Visit& visit) const {
    const LightChoice::At choice_at(choice, *this, at);
    if (choice_at.is_empty()) return;
    const auto [first, across] = stream.next_two();
    // The remainders of one light's samples are even, and so are multiples of the golden ratio.
    std::uint32_t number = 0;
    choose_evenly(choice_at, samples, first, [&](const math::DiscreteChoice& chosen, double expected) {
        const double v = across + 0.6180339887498949 * number++;
        const std::array<double, 2> u{chosen.remainder, v - std::floor(v)};
        if (const auto light = sample_chosen(chosen.index, expected, at, u)) visit(*light);
    });
}

template <typename Visit>
void LightSampler::sample_extended(const SurfacePoint& at, math::SampleStream& stream,
                                   const Visit& visit) const {
    const auto sample = [&](std::size_t light) {
        if (const auto incident = sample_incident(light, at, stream.next_two())) visit(*incident);
    };
    if (chooses_extended(at)) {
        if (outside_ != kNoLight) sample(outside_);
        sample_some(extended_, at, kExtended, stream, visit);
        return;
    }
    for (std::size_t light = 0; light < count(); ++light) {
        if (!is_point(light)) sample(light);
    }
}

}  // namespace stilb::transport
