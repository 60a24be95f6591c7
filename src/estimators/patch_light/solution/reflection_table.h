// The reflection of a material, by the terms of the arriving light.
//
// L_out(w) = sum over k of a_k F_k(w), with F_k(w) = integral of f(w_in, w) Z_k(w_in) cos(theta) dw_in for
// the basis Z of math/zernike.h. Tables hold G, the factors for a basis that is turned to the azimuth phi of
// w, which change little with phi, and for isotropic materials not at all:
//
//     F_(n,m) = G_(n,m) cos(m phi) - G_(n,-m) sin(m phi),    F_(n,-m) = G_(n,m) sin(m phi) + G_(n,-m) cos(m
//     phi)
//
// for m > 0, and F_(n,0) = G_(n,0).
#pragma once

#include <span>
#include <vector>

#include "estimators/patch_light/patch_transport.h"
#include "materials/material.h"
#include "math/zernike.h"

namespace stilb::estimators {

/// Rows of directions from the normal (row 0) to 0.1 degrees above the surface, equal in angle; in each row
/// `phis` azimuths from the frame's u on, equal in angle; for each direction the turned factors G of all
/// terms [1/sqrt(sr)]. Diffuse materials have one direction and one term.
struct ReflectionTable {
    int thetas = 1, phis = 1;
    std::vector<FloatRgb> factors;

    std::size_t terms() const { return factors.size() / static_cast<std::size_t>(thetas * phis); }
};

ReflectionTable make_reflection_table(const Material& material, int degree);

/// The factors of the terms towards a unit direction in the material's frame, in front of it, between those
/// of the table. `factors`: as many as terms.
void interpolate_factors(const ReflectionTable& table, const Vec3& local_out, std::span<FloatRgb> factors);

/// The same without a table, by a sum over twice `nodes` directions: 256 give 0.5 % for light that is equal
/// from all directions.
void integrate_factors(const Material& material, const math::ZernikeBasis& basis, const Vec3& local_out,
                       std::uint32_t nodes, std::span<FloatRgb> factors);

}  // namespace stilb::estimators
