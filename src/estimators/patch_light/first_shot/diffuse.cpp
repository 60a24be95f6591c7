#include "estimators/patch_light/first_shot/diffuse.h"

#include <numbers>

namespace stilb::estimators {
namespace {

// A BRDF as a sum: a part that is the same for all directions, of which pi times stands here, and the rest.
// Rough and Plastic are all rest: what they reflect diffusely depends on both angles.

struct SplitMaterial {
    Rgb diffuse;
    Material rest;
};

SplitMaterial split(const Diffuse& material) { return {material.reflectance, Black{}}; }
SplitMaterial split(const Phong& material) {
    return {material.diffuse, Phong{{}, material.specular, material.exponent}};
}
SplitMaterial split(const Ward& material) {
    Ward::Parameters rest = material.parameters();
    rest.diffuse = {};
    return {material.parameters().diffuse, Ward(rest)};
}
SplitMaterial split(const auto& material) { return {{}, material}; }

}  // namespace

DiffuseFirstShot::DiffuseFirstShot(const Scene& scene, const patches::Patches& patches,
                                   const IncomingFirstShot& incoming, const ShadowRays& rays)
    : scene_(scene), patches_(patches), rays_(rays), radiance_cd_m2_(2 * patches.count()) {
    std::vector<Rgb> diffuse;
    for (const NamedMaterial& named : scene.materials) {
        const SplitMaterial parts = std::visit([](const auto& m) { return split(m); }, named.material);
        diffuse.push_back(parts.diffuse * std::numbers::inv_pi);
        rest_.push_back(parts.rest);
    }
    for (std::uint32_t side = 0; side < radiance_cd_m2_.size(); ++side) {
        const auto material = index_of(patches.materials[patches.patch_of(side)]);
        radiance_cd_m2_[side] = in_floats(diffuse[material] * incoming.illuminance_lx(side));
    }
}

void DiffuseFirstShot::add_reflected(std::uint32_t side, const Vec3& position, math::RandomKey key,
                                     std::span<const Vec3> outs, std::span<Rgb> sums) const {
    const Vec3 normal = patches_.normal_of(side);
    for (std::size_t i = 0; i < outs.size(); ++i) {
        if (dot(outs[i], normal) > 0) sums[i] += to_spectrum(radiance_cd_m2_[side]);
    }
    const Material& rest = rest_[index_of(patches_.materials[patches_.patch_of(side)])];
    rays_.add_reflected_by(rest, side, position, key, outs, sums);
}

}  // namespace stilb::estimators
