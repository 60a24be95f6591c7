
#include "estimators/patch_light/first_shot/first_shot.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <utility>

#include "estimators/limits.h"
#include "estimators/patch_light/first_shot/shadow_rays.h"
#include "estimators/patch_light/patch_transport.h"

namespace stilb::estimators {
namespace {

/// The patches that are not those of replaced lights: what these receive hardly matters, and a ball of light
/// has 320 patches at least.
std::size_t lit_patches(const Scene& scene, const patches::Patches& patches, const FirstShotLights& lights) {
    const auto& first = patches.first_of_object;
    std::size_t count = patches.count();
    for (std::size_t i = 0; i < lights.lights.size(); ++i) {
        const auto object = lights::emitting_object(scene.lights[i]);
        if (object && lights.lights[i].is_replaced)
            count -= first[index_of(*object) + 1] - first[index_of(*object)];
    }
    return count;
}

}  // namespace

FirstShot::FirstShot(const Scene& scene, const rays::RayCaster& caster,
                     const transport::LightSampler& sampler, const patches::PatchCaster& patch_caster,
                     const FirstShotOptions& options, const Monitor& monitor) {
    const auto start = std::chrono::steady_clock::now();
    set_up(scene, caster, sampler, patch_caster, options, monitor);
    set_up_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

FirstShot::FirstShot(const Scene& scene, const rays::RayCaster& caster, const patches::Patches& patches,
                     FirstShotFactors factors)
    : lights_(choose_first_shot_lights(scene, caster, patches.center)) {
    stored_.emplace<IncomingFirstShot>(scene, patches, lights_, std::move(factors));
}

void FirstShot::set_up(const Scene& scene, const rays::RayCaster& caster,
                       const transport::LightSampler& sampler, const patches::PatchCaster& patch_caster,
                       const FirstShotOptions& options, const Monitor& monitor) {
    const FirstShotVariant variant = options.variant.value_or(kUsualFirstShot);
    if (variant == FirstShotVariant::none) {
        for (const Light& light : scene.lights)
            lights_.lights.push_back({light.name, false, "no first shot"});
        return;
    }
    const patches::Patches& patches = patch_caster.patches();
    lights_ = choose_first_shot_lights(scene, caster, patches.center);
    const ShadowRays rays(scene, patches, caster, sampler, lights_);
    if (variant == FirstShotVariant::on_the_fly) {
        stored_.emplace<ShadowRays>(rays);
        return;
    }
    ShootingOptions shooting = options.shooting;
    if (shooting.resolution == ShootingOptions::kAutomatic) {
        shooting.resolution =
            first_shot_resolution(lit_patches(scene, patches, lights_), effective_number(scene, lights_));
    }
    resolution_ = shooting.resolution;
    FirstShotFactors factors(patch_caster, lights_.samples, shooting, monitor);
    missed_ = count_missed(scene, caster, patches, lights_.samples, factors, shooting.resolution, monitor);
    IncomingFirstShot incoming(scene, patches, lights_, std::move(factors));
    if (variant == FirstShotVariant::classical) {
        stored_.emplace<ClassicalFirstShot>(scene, patches, incoming, HemisphereBins(options.bin_rings));
    } else if (variant == FirstShotVariant::diffuse) {
        stored_.emplace<DiffuseFirstShot>(scene, patches, incoming, rays);
    } else {
        stored_.emplace<IncomingFirstShot>(std::move(incoming));
    }
}

Rgb FirstShot::reflected(std::uint32_t side, const Vec3& position, math::RandomKey key,
                         const Vec3& out) const {
    Rgb sum;
    add_reflected(side, position, key, {&out, 1}, {&sum, 1});
    return sum;
}

void FirstShot::add_reflected(std::uint32_t side, const Vec3& position, math::RandomKey key,
                              std::span<const Vec3> outs, std::span<Rgb> sums) const {
    std::visit([&](const auto& stored) { stored.add_reflected(side, position, key, outs, sums); }, stored_);
}

bool FirstShot::is_constant(std::uint32_t side) const {
    return std::visit([&](const auto& stored) { return stored.is_constant(side); }, stored_);
}

std::size_t FirstShot::bytes() const {
    return std::visit([](const auto& stored) { return stored.bytes(); }, stored_);
}

namespace {

FirstShotOptions first_shot_options(const PatchOptions& asked) {
    FirstShotOptions options = asked.first_shot;
    options.shooting.resolution = asked.resolution.value_or(ShootingOptions::kAutomatic);
    return options;
}

}  // namespace

FirstShotPatches::FirstShotPatches(const Scene& all, const rays::RayCaster& rays, const PatchOptions& asked,
                                   const Monitor& monitor)
    : scene(require_reflection_only(all)),
      caster(rays),
      options(asked),
      lights(scene, caster),
      size_m(options.patch_m.value_or(patches::patch_size_m(scene))),
      patches(patches::make_patches(scene, size_m, monitor, caster.center())),
      patch_caster(patches),
      first_shot(scene, caster, lights, patch_caster, first_shot_options(options), monitor) {}

void FirstShotPatches::add_to(std::span<transport::Path* const> paths, rays::Coherence coherence) const {
    std::vector<ViewedHit> points;
    for (const transport::Path* path : paths) points.push_back({path->hit, path->outgoing});
    const auto locations = find_patch_locations(patch_caster, points, coherence);
    for (std::size_t i = 0; i < locations.size(); ++i) {
        if (!locations[i]) continue;
        transport::Path& path = *paths[i];
        const std::uint32_t side = locations[i]->side;
        // Many paths share a position: each needs its own points on lights.
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
