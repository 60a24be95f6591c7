#include "estimators/patch_light/solution/group_sources.h"

#include <utility>

namespace stilb::estimators {

GroupSources::GroupSources(const PatchTransport& transport, const LightGroups& groups)
    : transport_(transport) {
    for (std::uint32_t g = 0; g < groups.count(); ++g) add(g, groups);
}

std::vector<BundleSource> GroupSources::sources() const {
    std::vector<BundleSource> sources;
    for (const Group& group : groups_) {
        sources.push_back(
            {group.first_reflection, group.emission, group.first_shot.get(), group.has_outside});
    }
    return sources;
}

void GroupSources::add(std::uint32_t number, const LightGroups& groups) {
    const patches::Patches& patches = transport_.patches;
    Group& group = groups_.emplace_back();
    group.first_shot = first_shot_of(number, groups);
    group.first_reflection.resize(2 * patches.count());
    for (std::uint32_t side = 0; side < group.first_reflection.size(); ++side) {
        if (!transport_.reflects_alike(side)) continue;
        group.first_reflection[side] = to_float_rgb(group.first_shot->reflected(
            side, patches.middle(patches.patch_of(side)), {}, patches.normal_of(side)));
    }
    group.emission.resize(patches.count());
    for (std::size_t light = 0; light < groups.of_light.size(); ++light) {
        if (groups.of_light[light] == number) add_light(light, group);
    }
}

void GroupSources::add_light(std::size_t light, Group& group) const {
    const Light& source = transport_.scene.lights[light];
    if (location_of(source) == LightLocation::infinity) group.has_outside = true;
    const auto surface = lights::uniform_emission(source);
    if (!surface) return;
    const std::size_t object = index_of(surface->object);
    const auto& first = transport_.patches.first_of_object;
    for (std::uint32_t p = first[object]; p < first[object + 1]; ++p)
        group.emission[p] = transport_.emission[p];
}

std::unique_ptr<FirstShot> GroupSources::first_shot_of(std::uint32_t number,
                                                       const LightGroups& groups) const {
    std::vector<std::uint32_t> rows(2 * transport_.patches.count() + 1);
    std::vector<FirstShotFactors::Factor> factors;
    if (const auto* incoming = transport_.first_shot.incoming()) {
        const auto samples = transport_.first_shot.samples();
        for (std::uint32_t side = 0; side + 1 < rows.size(); ++side) {
            for (const auto& factor : incoming->factors().of(side)) {
                if (groups.of_light[samples[factor.sample].light] == number) factors.push_back(factor);
            }
            rows[side + 1] = static_cast<std::uint32_t>(factors.size());
        }
    }
    return std::make_unique<FirstShot>(transport_.scene, transport_.caster, transport_.patches,
                                       FirstShotFactors(std::move(rows), std::move(factors)));
}

}  // namespace stilb::estimators
