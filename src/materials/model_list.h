// All material models, for what treats each of them.
//
// A new model is a new file with the members of the concept Model of model.h, and its name in the list here.
#pragma once

#include <tuple>
#include <type_traits>

#include "materials/black.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/fabric.h"
#include "materials/frosted.h"
#include "materials/glazing.h"
#include "materials/material.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "materials/straight.h"
#include "materials/thin_dielectric.h"
#include "materials/translucent.h"
#include "materials/ward.h"

namespace stilb::materials {

/// In the order of lists for users.
using ModelList = std::tuple<Diffuse, Phong, RoughConductor, Ward, Plastic, Mirror, Dielectric,
                             ThinDielectric, Glazing, Translucent, Fabric, Frosted, Black>;
/// Models that are lobes of others only.
using LobeList = std::tuple<Straight, MirroringFacets, RefractingFacets>;

/// Calls `visit.template operator()<M>()` for every model M that scene files name, in order.
template <typename Visit>
void for_each_model(const Visit& visit) {
    [&]<typename... Models>(std::type_identity<std::tuple<Models...>>) {
        (visit.template operator()<Models>(), ...);
    }(std::type_identity<ModelList>{});
}

/// Calls `visit(model)` with the model of a material, which is one of these.
template <typename M, typename... Others, typename Visit>
decltype(auto) visit_one_of(const Visit& visit, const Material& material) {
    if constexpr (sizeof...(Others) > 0) {
        if (!material.is<M>()) return visit_one_of<Others...>(visit, material);
    }
    return visit(*material.get_if<M>());
}
/// Calls `visit(model)` with the model of a material.
template <typename Visit>
decltype(auto) visit_model(const Visit& visit, const Material& material) {
    return [&]<typename... Models, typename... Lobes>(
               std::type_identity<std::tuple<Models...>>,
               std::type_identity<std::tuple<Lobes...>>) -> decltype(auto) {
        return visit_one_of<Models..., Lobes...>(visit, material);
    }(std::type_identity<ModelList>{}, std::type_identity<LobeList>{});
}

}  // namespace stilb::materials
