#include "estimators/patch_light/solution/grouped_lights.h"

#include <optional>

#include "materials/shaded_surface.h"

namespace stilb::estimators {
namespace {

/// A group with more lights than this has as many lights chosen at random at each point.
constexpr std::uint32_t kSamplesOfManyLights = 16;

}  // namespace

GroupedLights::GroupedLights(const Scene& scene, const rays::RayCaster& caster, const LightGroups& groups,
                             const std::function<bool(std::size_t)>& counts)
    : scene_(scene), caster_(caster), lights_(scene, caster), groups_(groups.count()) {
    for (std::size_t light = 0; light < scene.lights.size(); ++light) {
        if (counts(light)) groups_[groups.of_light[light]].lights.push_back(light);
    }
    for (Group& group : groups_) {
        if (group.lights.size() <= kSamplesOfManyLights) continue;
        std::vector<bool> is_other(scene.lights.size(), true);
        for (const std::size_t light : group.lights) is_other[light] = false;
        group.sampler = std::make_unique<transport::LightSampler>(scene, caster, std::move(is_other));
    }
}

void GroupedLights::add_reflected(const rays::Hit& surface, const Vec3& out, math::SampleStream& stream,
                                  std::span<Rgb> of_groups) const {
    const materials::ShadedSurface shaded(scene_.material(surface.material), surface.normal,
                                          surface.shading_normal);
    const Vec3 local_out = shaded.frame().to_local(out);
    const auto reflected = [&](const std::optional<transport::IncidentLight>& light) -> Rgb {
        if (!light || dot(light->direction, surface.normal) <= 0) return {};
        const Vec3 in = shaded.frame().to_local(light->direction);
        const Rgb unshadowed = shaded.brdf_per_sr(in, local_out) * in.z * light->normal_illuminance_lx;
        if (!(unshadowed.max() > 0)) return {};
        return unshadowed * caster_.transmittance({surface.lifted, light->source_point});
    };
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const Group& group = groups_[g];
        if (!group.sampler) {
            for (const std::size_t light : group.lights)
                of_groups[g] += reflected(lights_.sample_incident(light, surface, stream.next_two()));
            continue;
        }
        group.sampler->sample_some_lights(
            surface, kSamplesOfManyLights, stream,
            [&](const transport::IncidentLight& light) { of_groups[g] += reflected(light); });
    }
}

}  // namespace stilb::estimators
