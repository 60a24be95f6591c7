#include "estimators/patch_light/first_shot/first_shot.h"

#include <chrono>
#include <utility>

#include "estimators/patch_light/first_shot/missed.h"

namespace stilb::estimators {

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
    resolution_ = options.shooting.resolution;
    FirstShotFactors factors(patch_caster, lights_.samples, options.shooting, monitor);
    missed_ =
        count_missed(scene, caster, patches, lights_.samples, factors, options.shooting.resolution, monitor);
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

}  // namespace stilb::estimators
