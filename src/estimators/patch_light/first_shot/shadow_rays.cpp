#include "estimators/patch_light/first_shot/shadow_rays.h"

#include <bit>

namespace stilb::estimators {
namespace {

/// Another one for every position of every side.
math::RandomKey key_at(math::RandomKey key, std::uint32_t side, const Vec3& position) {
    key = key.derived(side);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        key = key.derived(std::bit_cast<std::uint64_t>(position[axis]));
    }
    return key;
}

}  // namespace

Vec3 lifted_off(const Scene& scene, const patches::Patches& patches, const rays::RayCaster& caster,
                std::uint32_t side, const Vec3& position) {
    Vec3 normal = patches.normal_of(side), place = position;
    const ObjectId object = patches.object_of(patches.patch_of(side));
    if (const auto* sphere = std::get_if<Sphere>(&scene.object(object).shape)) {
        const Vec3 outwards = normalized(position - sphere->center);
        place = sphere->center + sphere->radius * outwards;
        normal = patches.is_front(side) ? outwards : -outwards;
    }
    if (const auto* harmonics = std::get_if<Harmonics>(&scene.object(object).shape)) {
        const Vec3 direction = position - harmonics->center, outwards = harmonics->normal_towards(direction);
        place = harmonics->point_towards(direction);
        normal = patches.is_front(side) ? outwards : -outwards;
    }
    return place + caster.offset_m(place, caster.half_extent_m()) * normal;
}

void ShadowRays::add_reflected_by(const Material& material, std::uint32_t side, const Vec3& position,
                                  math::RandomKey key, std::span<const Vec3> outs,
                                  std::span<Rgb> sums) const {
    if (reflects_nothing(material)) return;
    const Frame frame = frame_of(patches_, side);
    const Vec3 lifted = lifted_off(scene_, patches_, caster_, side, position);
    const math::RandomKey key_here = key_at(key, side, position);
    const auto for_each_arrival = [&](const auto& visit) {
        for (std::size_t i = 0; i < lights_.lights.size(); ++i) {
            const std::size_t points = lights_.lights[i].samples;
            for (std::size_t k = 0; k < points; ++k) {
                const auto light = sampler_.sample_incident(
                    i, position, math::SampleStream(key_here.derived(i), k).next_two());
                if (!light || !(light->normal_illuminance_lx.max() > 0)) continue;
                const double cosine = dot(light->direction, frame.w);
                if (cosine <= 0) continue;
                visit(light->direction, light->normal_illuminance_lx *
                                            caster_.transmittance({lifted, light->source_point}) *
                                            (cosine / static_cast<double>(points)));
            }
        }
    };
    reflect(material, frame, for_each_arrival, outs, sums);
}

}  // namespace stilb::estimators
