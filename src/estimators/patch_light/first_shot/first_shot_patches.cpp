#include "estimators/patch_light/first_shot/first_shot_patches.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "estimators/patch_light/patch_location.h"

namespace stilb::estimators {
namespace {

FirstShotOptions first_shot_options(const PatchOptions& asked, const patches::Patches& patches) {
    FirstShotOptions options = asked.first_shot;
    options.shooting.resolution = asked.resolution.value_or(first_shot_resolution(patches.count()));
    return options;
}

FirstShot first_shot_of(const FirstShotPatches& all, std::optional<FirstShotFactors> factors) {
    if (factors) return {all.scene, all.caster, all.patches, std::move(*factors)};
    return {all.scene, all.caster, all.lights, all.patch_caster, {FirstShotVariant::none, {}}};
}

double longest_edge_m(const patches::Patches& patches) {
    double longest = 0;
    for (const Triangle& corners : patches.corners) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 from(patches.vertices[corners[i]]), to(patches.vertices[corners[(i + 1) % 3]]);
            longest = std::max(longest, squared_length(to - from));
        }
    }
    return std::sqrt(longest);
}

}  // namespace

FirstShotPatches::FirstShotPatches(const Scene& all, const rays::RayCaster& rays, const PatchOptions& asked,
                                   const Monitor& monitor)
    : scene(all),
      caster(rays),
      options(asked),
      lights(scene, caster),
      size_m(options.patch_m.value_or(patches::patch_size_m(scene))),
      patches(patches::make_patches(scene, size_m, monitor)),
      patch_caster(patches),
      first_shot(scene, caster, lights, patch_caster, first_shot_options(options, patches), monitor) {}

FirstShotPatches::FirstShotPatches(const Scene& all, const rays::RayCaster& rays, patches::Patches made,
                                   std::optional<FirstShotFactors> factors)
    : scene(all),
      caster(rays),
      lights(scene, caster),
      size_m(longest_edge_m(made)),
      patches(std::move(made)),
      patch_caster(patches),
      first_shot(first_shot_of(*this, std::move(factors))) {}

void FirstShotPatches::add_to(std::span<transport::Path* const> paths, rays::Coherence coherence) const {
    std::vector<ViewedHit> points;
    for (const transport::Path* path : paths) points.push_back({path->hit, path->outgoing});
    const auto places = find_patch_locations(patch_caster, points, coherence);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!places[i]) continue;
        transport::Path& path = *paths[i];
        const std::uint32_t side = places[i]->side;
        // Many paths stand at the same place: each has points of its own on lights.
        const math::RandomKey key{
            first_shot.needs_position(side) ? std::bit_cast<std::uint64_t>(path.stream.next()) : 0};
        path.luminance_cd_m2 +=
            path.throughput * first_shot.reflected(side, path.hit.position, key, path.outgoing);
    }
}

PatchReport FirstShotPatches::report() const {
    const auto decided = first_shot.lights();
    return {
        patches.count(),       size_m,
        first_shot.variant(),  first_shot.resolution(),
        first_shot.missed(),   static_cast<double>(first_shot.bytes()) / static_cast<double>(patches.count()),
        first_shot.set_up_s(), {decided.begin(), decided.end()}};
}

}  // namespace stilb::estimators
