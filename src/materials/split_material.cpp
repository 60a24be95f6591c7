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
    template <typename Model>
    SplitMaterial operator()(const Model& model) const {
        return parts({}, model);
    }
};

}  // namespace

SplitMaterial split(const Material& material) { return visit_model(Divider{}, material); }

}  // namespace stilb::materials
