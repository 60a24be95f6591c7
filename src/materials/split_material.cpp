#include "materials/split_material.h"

#include "materials/model_list.h"

namespace stilb::materials {
namespace {

Material split_off(const Phong& phong) { return Phong{{}, phong.specular, phong.exponent}; }
Material split_off(const Ward& ward) {
    Ward::Parameters gloss = ward.parameters();
    gloss.diffuse = {};
    return Ward(gloss);
}

struct Divider {
    static SplitMaterial parts(const Rgb& diffuse, const Material& gloss) {
        return {diffuse, Diffuse{diffuse},
                reflectance_bound(gloss).max() > 0 ? std::optional(gloss) : std::nullopt};
    }

    SplitMaterial operator()(const Diffuse& diffuse) const {
        return {diffuse.reflectance, diffuse, std::nullopt};
    }
    SplitMaterial operator()(const Phong& phong) const { return parts(phong.diffuse, split_off(phong)); }
    SplitMaterial operator()(const Ward& ward) const {
        return parts(ward.parameters().diffuse, split_off(ward));
    }
    SplitMaterial operator()(const Translucent& sheet) const {
        const auto& [reflected, transmitted, straight] = sheet.parameters();
        // Light that passes straight is not diffuse: such sheets are not divided.
        if (straight.max() > 0) return parts({}, sheet);
        return {reflected + transmitted, Diffuse{reflected + transmitted}, std::nullopt, transmitted};
    }
    template <typename Model>
    SplitMaterial operator()(const Model& model) const {
        return parts({}, model);
    }
};

}  // namespace

Rgb SplitMaterial::other_share() const {
    Rgb share;
    for (std::size_t b = 0; b < kBands; ++b) {
        if (transmitted[b] > 0) share[b] = transmitted[b] / diffuse_reflectance[b];
    }
    return share;
}

SplitMaterial split(const Material& material) { return visit_model(Divider{}, material); }

}  // namespace stilb::materials
