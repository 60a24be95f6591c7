#include "transport/sharp_light.h"

#include <algorithm>
#include <optional>
#include <variant>
#include <vector>

#include "materials/diffuse.h"
#include "materials/shaded_surface.h"
#include "materials/split_material.h"
#include "transport/light_sampler.h"
#include "transport/line_of_sight.h"

namespace stilb::transport {
namespace {

constexpr std::uint64_t kParticles = 4096;
constexpr int kMostReflections = 8;
constexpr int kDirections = 16;
/// A direction sampled with this density belongs to a lobe: three times that of diffuse reflection.
constexpr double kLeastDensity_per_sr = 1;

/// Flux that arrives in a highlight.
struct Highlight {
    double solid_angle_sr = 0;  ///< of the highlight, from the lit point
    double flux_lm = 0;
    ObjectId object{};
};

bool may_be_smooth(const Material& material) {
    return is_specular(material) || materials::split(material).gloss;
}

/// A lamp as a particle from it sees it.
struct VisibleLamp {
    double area_m2 = 0;  ///< 0: a point
    double distance_m = 0;
};

VisibleLamp visible_lamp(const Light& light, const Scene& scene) {
    const auto emission = lights::emitting_object(light);
    if (!emission) return {};
    const Shape& shape = scene.object(*emission).shape;
    return {std::holds_alternative<Sphere>(shape) ? area_m2(shape) / 4 : area_m2(shape)};
}

/// The part of light from infinity around a particle's direction that is about as bright: of a sun, the sun.
VisibleLamp visible_part_of_outside(const EmittedParticle& particle, const LightSampler& lights) {
    constexpr double far_m = 1e9;
    const double pdf_per_sr = lights.pdf_of_outside_light_per_sr(-particle.direction, {particle.origin});
    return {far_m * far_m / pdf_per_sr, far_m};
}

/// A particle that only smooth surfaces have reflected or refracted so far.
class SharpParticle {
  public:
    SharpParticle(const EmittedParticle& particle, const VisibleLamp& lamp)
        : origin_(particle.origin),
          direction_(particle.direction),
          flux_(particle.flux_lm),
          length_m_(lamp.distance_m),
          blurred_m2_(lamp.area_m2) {}

    /// Follows the particle, and adds the highlights that light surfaces.
    void trace(const Scene& scene, const rays::RayCaster& caster, math::SampleStream& stream,
               std::vector<Highlight>& highlights) {
        for (int reflection = 0; reflection <= kMostReflections; ++reflection) {
            const auto hit = caster.closest(origin_, direction_);
            if (!hit) return;
            length_m_ += length(hit->position - origin_);
            const Material& material = scene.material(hit->material);
            const bool specular = is_specular(material);
            if (!specular && object_ && blurred_m2_ > 0) {
                highlights.push_back({blurred_m2_ / (length_m_ * length_m_), flux_.luminance(), *object_});
            }
            if (!(specular ? pass(material, *hit, stream) : reflect(material, *hit, stream))) return;
        }
    }

  private:
    bool pass(const Material& material, const rays::Hit& hit, math::SampleStream& stream) {
        const auto branch =
            choose_specular_ray(material, hit, -direction_, materials::Carried::flux, stream.next());
        if (!branch) return false;
        if (!branch->straight && !object_) object_ = hit.object;
        flux_ *= branch->share;
        origin_ = branch->origin;
        direction_ = branch->direction;
        return true;
    }

    /// Follows the lobe of a material, where it has one, with all the flux that the lobe reflects. The lobe
    /// blurs the lamp as if it were larger, by its solid angle.
    bool reflect(const Material& material, const rays::Hit& hit, math::SampleStream& stream) {
        if (material.is<Diffuse>()) return false;
        const materials::ShadedSurface surface(material, hit.normal, hit.shading_normal);
        const Vec3 in = surface.frame().to_local(-direction_);
        Rgb albedo;
        std::optional<materials::ScatterSample> in_lobe;
        for (int i = 0; i < kDirections; ++i) {
            const auto [u1, u2] = stream.next_two();
            const auto scattered = surface.sample_outgoing(in, u1, u2);
            if (!scattered || scattered->pdf_per_sr < kLeastDensity_per_sr) continue;
            albedo += scattered->weight * (1.0 / kDirections);
            if (!in_lobe) in_lobe = scattered;
        }
        if (!in_lobe || !(albedo.luminance() > 0)) return false;
        const double share_per_sr = in_lobe->weight.luminance() * in_lobe->pdf_per_sr;
        blurred_m2_ += length_m_ * length_m_ * albedo.luminance() / share_per_sr;
        if (!object_) object_ = hit.object;
        flux_ *= albedo;
        origin_ = hit.lifted;
        direction_ = surface.frame().to_world(in_lobe->direction);
        return true;
    }

    Vec3 origin_, direction_;
    Rgb flux_;
    double length_m_;
    double blurred_m2_;               ///< of the lamp, blurred, at its distance
    std::optional<ObjectId> object_;  ///< the first smooth one
};

}  // namespace

SharpLight find_sharp_light(const Scene& scene, const rays::RayCaster& caster) {
    constexpr double kLeastShare = 0.005, kTimesFound = 40;
    if (std::ranges::none_of(scene.materials, may_be_smooth, &NamedMaterial::material)) return {};
    const LightSampler lights(scene, caster);
    if (lights.count() == 0) return {};
    std::vector<VisibleLamp> lamps;
    for (const Light& light : scene.lights) lamps.push_back(visible_lamp(light, scene));
    std::vector<Highlight> highlights;
    double emitted_lm = 0;
    for (std::uint64_t i = 0; i < kParticles; ++i) {
        math::SampleStream stream(math::RandomKey{}, i);
        const EmittedParticle particle = lights.sample_emission(stream);
        emitted_lm += particle.flux_lm.luminance();
        const bool is_outside = location_of(scene.lights[particle.light]) == LightLocation::infinity;
        const VisibleLamp lamp =
            is_outside ? visible_part_of_outside(particle, lights) : lamps[particle.light];
        SharpParticle(particle, lamp).trace(scene, caster, stream, highlights);
    }
    std::ranges::sort(highlights, {}, &Highlight::solid_angle_sr);
    double found_lm = 0;
    for (const Highlight& highlight : highlights) {
        found_lm += highlight.flux_lm;
        if (found_lm < kLeastShare * emitted_lm) continue;
        return {static_cast<std::uint64_t>(kTimesFound * kPi / highlight.solid_angle_sr), highlight.object};
    }
    return {};
}

}  // namespace stilb::transport
