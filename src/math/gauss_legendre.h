// Gauss-Legendre quadrature of any degree.
#pragma once

#include <vector>

namespace stilb::math {

/// Nodes and weights for integrals over [-1, 1]: exact for polynomials up to degree 2 n - 1.
struct GaussLegendre {
    std::vector<double> nodes;  ///< ascending
    std::vector<double> weights;
};

/// n nodes, 1 or more; the time is proportional to n^2.
GaussLegendre gauss_legendre(int n);

}  // namespace stilb::math
