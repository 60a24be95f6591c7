// Directions on parallels of the sphere, evenly spaced on each.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vec.h"

namespace stilb::geometry {

/// Values on it are numbered parallel by parallel: parallel * azimuths + k for phi = first_phi + 2 pi k /
/// azimuths.
struct ParallelGrid {
    std::vector<double> z;           ///< cos(theta) per parallel
    std::vector<double> weights_sr;  ///< per parallel, of each of its directions; they sum up to 4 pi
    std::size_t azimuths = 0;
    double first_phi = 0;

    std::size_t parallels() const { return z.size(); }
    std::size_t size() const { return z.size() * azimuths; }
    double phi(std::size_t k) const;
    /// Unit.
    Vec3 direction(std::size_t parallel, std::size_t k) const;
    /// All, in their order.
    std::vector<Vec3> directions() const;
};

/// Gauss-Legendre nodes in cos(theta), twice as many azimuths as parallels: sums over it are integrals of
/// spherical harmonics, exactly, up to degree 2 parallels - 1.
ParallelGrid gauss_grid(int parallels);

/// Parallels in the middles of even steps of theta, weighted by their area.
ParallelGrid even_grid(int parallels);

}  // namespace stilb::geometry
