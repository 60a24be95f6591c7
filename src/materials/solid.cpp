#include "materials/solid.h"

#include "materials/dielectric.h"
#include "materials/frosted.h"
#include "materials/thin_dielectric.h"

namespace stilb::materials {
namespace {

const Frosted* frosted(const Material& material) {
    const auto* model = material.get_if<Frosted>();
    return model && !model->parameters().thin ? model : nullptr;
}

}  // namespace

std::optional<double> solid_ior(const Material& material) {
    if (const auto* glass = material.get_if<Dielectric>()) return glass->ior;
    if (const Frosted* model = frosted(material)) return model->parameters().ior;
    return std::nullopt;
}

double outside_ior(const Material& material) {
    if (const Frosted* model = frosted(material)) return model->parameters().outside_ior;
    return material.get_if<Dielectric>()->outside_ior;
}

Material between_media(const Material& material, double inside_ior, double outside_ior) {
    if (const Frosted* model = frosted(material))
        return Frosted({inside_ior, model->parameters().roughness, false, outside_ior});
    return Dielectric{inside_ior, outside_ior};
}

Material sheet_of(const Material& material) {
    if (const Frosted* model = frosted(material))
        return Frosted({model->parameters().ior, model->parameters().roughness, true});
    return ThinDielectric{*solid_ior(material)};
}

}  // namespace stilb::materials
