#include "exact/pane.h"

#include <cmath>
#include <numbers>

#include "exact/domain.h"

namespace stilb::exact {
namespace {

double square(double x) { return x * x; }

/// The shares of every way through: `face` is the reflectance of a face, `passage` the transmittance of the
/// inside.
double sum_of_passages(double face, double passage) {
    double term = square(1 - face) * passage, sum = 0;
    while (term > 1e-17 * sum) {
        sum += term;
        term *= square(face * passage);
    }
    return sum;
}

}  // namespace

double pane_transmittance(const PaneOptics& pane, double angle_rad) {
    require(pane.ior > 1 && std::isfinite(pane.ior), "pane: the index of refraction is not above 1");
    require(pane.internal_transmittance >= 0 && pane.internal_transmittance <= 1,
            "pane: the internal transmittance is not from 0 to 1");
    require(angle_rad >= 0 && angle_rad < std::numbers::pi / 2,
            "pane: the angle is not from 0 to less than 90 degrees");
    const double inside_rad = std::asin(std::sin(angle_rad) / pane.ior);
    const double passage = std::pow(pane.internal_transmittance, 1 / std::cos(inside_rad));
    const double less = angle_rad - inside_rad, more = angle_rad + inside_rad;
    // Where sines and tangents vanish, both polarisations are as at the normal.
    if (angle_rad < 1e-8) return sum_of_passages(square((pane.ior - 1) / (pane.ior + 1)), passage);
    const double across = square(std::sin(less) / std::sin(more));
    const double along = square(std::tan(less) / std::tan(more));
    return (sum_of_passages(across, passage) + sum_of_passages(along, passage)) / 2;
}

}  // namespace stilb::exact
