#include "materials/frosted.h"

#include <cmath>

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
    // What is lost leaves on both sides as the rest does.
    const double once = albedos.reflected.average() + albedos.transmitted.average();
    const double reflected = albedos.reflected.average() / once;
    const std::vector<Lobe> both{{MirroringFacets(albedos, false, reflected), false},
                                 {MirroringFacets(albedos, true, 1 - reflected), true}};
    for (auto& of_side : lobes_) of_side = {both, both};
}

void Frosted::add_solid() {
    // Between equal media facets do not act; so near to that nothing is seen of them.
    constexpr double least = 1e-4;
    double ior = parameters_.ior / parameters_.outside_ior;
    if (std::abs(ior - 1) < least) ior = 1 + least;
    const FacetAlbedos outside(FacetSide{ior, parameters_.roughness}),
        inside(FacetSide{1 / ior, parameters_.roughness});
    for (const bool is_outside : {true, false}) {
        const FacetLosses losses(is_outside ? outside : inside, is_outside ? inside : outside);
        const Lobe mirroring{MirroringFacets(losses.near, false, losses.reflected_near), false};
        for (const Carried carried : {Carried::flux, Carried::luminance})
            lobes_[is_outside ? 0 : 1][carried == Carried::flux ? 0 : 1] = {
                mirroring, {RefractingFacets(losses, carried), true, losses.near.side.ior}};
    }
}

}  // namespace stilb::materials
