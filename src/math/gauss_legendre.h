// Gauss-Legendre quadrature of any degree.
#pragma once

#include <vector>

namespace stilb::math {

/// For integrals over [-1, 1]: exact for polynomials up to degree 2 n - 1.
struct GaussLegendre {
    std::vector<double> nodes;  ///< ascending
    std::vector<double> weights;
};

/// n nodes, 1 or more; time goes with n^2.
GaussLegendre gauss_legendre(int n);

}  // namespace stilb::math
