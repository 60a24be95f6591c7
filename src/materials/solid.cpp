#include "materials/solid.h"

#include <algorithm>

#include "materials/frosted.h"
#include "materials/thin_dielectric.h"

namespace stilb::materials {
namespace {

const Frosted* frosted(const Material& material) {
    const auto* model = material.get_if<Frosted>();
    return model && !model->parameters().thin ? model : nullptr;
}

}  // namespace

std::optional<Medium> medium_inside(const Material& material) {
    if (const auto* glass = material.get_if<Dielectric>()) return glass->inside();
    if (const Frosted* model = frosted(material)) return Medium{model->parameters().ior};
    return std::nullopt;
}

Medium medium_outside(const Material& material) {
    if (const Frosted* model = frosted(material)) return {model->parameters().outside_ior};
    return material.get_if<Dielectric>()->outside;
}

Material between_media(const Material& material, const Medium& inside, const Medium& outside) {
    if (const Frosted* model = frosted(material))
        return Frosted({inside.ior, model->parameters().roughness, false, outside.ior});
    Dielectric glass{inside.ior};
    glass.outside = outside;
    const double most_per_m = std::ranges::max(inside.absorption_per_m);
    if (most_per_m > 0) {
        glass.distance_m = 1 / most_per_m;
        glass.color = inside.left_after(glass.distance_m);
    }
    return glass;
}

Rgb left_on_the_way(const Material& material, LightSide side, double way_m) {
    const auto* glass = material.get_if<Dielectric>();
    if (glass == nullptr) return Rgb::grey(1);
    return (side == LightSide::inside ? glass->inside() : glass->outside).left_after(way_m);
}

Material sheet_of(const Material& material) {
    if (const Frosted* model = frosted(material))
        return Frosted({model->parameters().ior, model->parameters().roughness, true});
    return ThinDielectric{medium_inside(material)->ior};
}

}  // namespace stilb::materials
