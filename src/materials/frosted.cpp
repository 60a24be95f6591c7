#include "materials/frosted.h"

#include <cmath>

#include "materials/straight.h"

namespace stilb::materials {

Frosted::Frosted(const Parameters& parameters) : parameters_(parameters) {
    if (parameters.thin) {
        add_sheet();
    } else {
        add_solid();
    }
}

void Frosted::add_sheet() {
    const FacetAlbedos albedos(FacetSide{parameters_.ior, parameters_.roughness, true});
    // The light that meets several facets is divided between both sides as the light that meets one.
    const double once = albedos.reflected.average() + albedos.transmitted.average();
    const double reflected = albedos.reflected.average() / once;
    const std::vector<Lobe> both{{MirroringFacets(albedos, false, reflected), false},
                                 {MirroringFacets(albedos, true, 1 - reflected), true}};
    for (auto& of_side : lobes_) of_side = {both, both};
}

void Frosted::add_solid() {
    // Between equal media facets do not act.
    constexpr double least = 1e-4;
    const double ior = parameters_.ior / parameters_.outside_ior;
    if (std::abs(ior - 1) < least) {
        const std::vector<Lobe> nothing{{Straight{Rgb::grey(1)}}};
        for (auto& of_side : lobes_) of_side = {nothing, nothing};
        return;
    }
    const FacetAlbedos outside(FacetSide{ior, parameters_.roughness}),
        inside(FacetSide{1 / ior, parameters_.roughness});
    for (const bool is_outside : {true, false}) {
        const FacetLosses losses(is_outside ? outside : inside, is_outside ? inside : outside);
        const Lobe mirroring{MirroringFacets(losses.near, false, losses.reflected), false};
        for (const Carried carried : {Carried::flux, Carried::luminance})
            lobes_[is_outside ? 0 : 1][carried == Carried::flux ? 0 : 1] = {
                mirroring, {RefractingFacets(losses, carried), true, losses.near.side.ior}};
    }
}

}  // namespace stilb::materials
