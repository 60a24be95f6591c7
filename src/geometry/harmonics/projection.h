// Projection of functions on the sphere, given by values on parallels, to series of spherical harmonics.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "geometry/harmonics/surface.h"
#include "math/spherical_harmonics.h"

namespace stilb::geometry {

/// The coefficients up to a degree, by harmonic_number(): sums of weight, value and Y_lm over the grid. On
/// gauss_grid(n) they are exact for functions of degrees up to 2 n - 1 - degree. Takes, for each parallel,
/// Fourier sums in phi first.
std::vector<double> project(const ParallelGrid& grid, std::span<const double> values, int degree);

struct DegreeError {
    double rms = 0, maximum = 0;  ///< in units of the values
};

/// The errors of the series truncated at degree 0, 1, 2 ...; NaN values are left
/// out, all others count by their weight.
std::vector<DegreeError> errors_by_degree(const ParallelGrid& grid, std::span<const double> values,
                                          std::span<const double> coefficients);

/// Replaces values that are NaN by the mean of those next to them on the grid (on the same parallel and on
/// the ones beside it), from the edges of a hole inwards. Throws std::invalid_argument where all are NaN.
void fill_holes(const ParallelGrid& grid, std::span<double> values);

}  // namespace stilb::geometry
