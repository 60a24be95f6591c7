#include "estimators/patch_light/solution/grouped_lights.h"

#include <algorithm>

#include "materials/shaded_surface.h"

namespace stilb::estimators {

GroupedLights::GroupedLights(const Scene& scene, const rays::RayCaster& caster, const LightGroups& groups,
                             const std::function<bool(std::size_t)>& counts)
    : scene_(scene), caster_(caster), samplers_(groups.count()) {
    for (std::size_t g = 0; g < groups.count(); ++g) {
        std::vector<bool> is_other(scene.lights.size());
        for (std::size_t light = 0; light < is_other.size(); ++light)
            is_other[light] = groups.of_light[light] != g || !counts(light);
        if (std::ranges::find(is_other, false) == is_other.end()) continue;
        samplers_[g] = std::make_unique<transport::LightSampler>(scene, caster, std::move(is_other));
    }
}

void GroupedLights::add_reflected(const rays::Hit& surface, const Vec3& out, math::SampleStream& stream,
                                  std::span<Rgb> of_groups) const {
    const materials::ShadedSurface shaded(scene_.material(surface.material), surface.normal,
                                          surface.shading_normal);
    const Vec3 local_out = shaded.frame().to_local(out);
    for (std::size_t g = 0; g < samplers_.size(); ++g) {
        if (!samplers_[g]) continue;
        const auto light = samplers_[g]->sample_one_light(surface.position, surface.normal, stream);
        if (!light || dot(light->direction, surface.normal) <= 0) continue;
        const Vec3 in = shaded.frame().to_local(light->direction);
        const Rgb reflected = shaded.brdf_per_sr(in, local_out) * in.z * light->normal_illuminance_lx;
        if (!(reflected.max() > 0)) continue;
        of_groups[g] += reflected * caster_.transmittance({surface.lifted, light->source_point});
    }
}

}  // namespace stilb::estimators
