#include "estimators/local/split_material.h"

namespace stilb::estimators {
namespace {

Material split_off(const materials::Phong& phong) {
    return materials::Phong{{}, phong.specular, phong.exponent};
}
Material split_off(const materials::Ward& ward) {
    materials::Ward::Parameters gloss = ward.parameters();
    gloss.diffuse = {};
    return materials::Ward(gloss);
}

struct Divider {
    static SplitMaterial parts(const Rgb& diffuse, Material gloss) {
        SplitMaterial result{materials::Diffuse{diffuse}, std::nullopt};
        if (reflectance_bound(gloss).max() > 0) result.gloss = std::move(gloss);
        return result;
    }

    SplitMaterial operator()(const materials::Diffuse& diffuse) const { return {diffuse, std::nullopt}; }
    SplitMaterial operator()(const materials::Phong& phong) const {
        return parts(phong.diffuse, split_off(phong));
    }
    SplitMaterial operator()(const materials::Ward& ward) const {
        return parts(ward.parameters().diffuse, split_off(ward));
    }
    template <typename Model>
    SplitMaterial operator()(const Model& model) const {
        return parts({}, model);
    }
};

}  // namespace

SplitMaterial split(const Material& material) { return std::visit(Divider{}, material); }

}  // namespace stilb::estimators
