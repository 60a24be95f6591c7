#include "geometry/harmonics/parallel_grid.h"

#include <cmath>
#include <numbers>

#include "math/gauss_legendre.h"

namespace stilb::geometry {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

}  // namespace

double ParallelGrid::phi(std::size_t k) const {
    return first_phi + kTurn * static_cast<double>(k) / static_cast<double>(azimuths);
}

Vec3 ParallelGrid::direction(std::size_t parallel, std::size_t k) const {
    const double radius = std::sqrt(1 - z[parallel] * z[parallel]);
    return {radius * std::cos(phi(k)), radius * std::sin(phi(k)), z[parallel]};
}

std::vector<Vec3> ParallelGrid::directions() const {
    std::vector<Vec3> all;
    all.reserve(size());
    for (std::size_t parallel = 0; parallel < parallels(); ++parallel) {
        for (std::size_t k = 0; k < azimuths; ++k) all.push_back(direction(parallel, k));
    }
    return all;
}

ParallelGrid gauss_grid(int parallels) {
    const math::GaussLegendre rule = math::gauss_legendre(parallels);
    ParallelGrid grid{rule.nodes, rule.weights, 2 * rule.nodes.size(), 0};
    for (double& weight : grid.weights_sr) weight *= kTurn / static_cast<double>(grid.azimuths);
    return grid;
}

ParallelGrid even_grid(int parallels) {
    const double step = std::numbers::pi / parallels;
    ParallelGrid grid{{}, {}, 2 * static_cast<std::size_t>(parallels), 0.5 * step};
    for (int i = 0; i < parallels; ++i) {
        const double north = std::cos(i * step), south = std::cos((i + 1) * step);
        grid.z.push_back(-std::cos((i + 0.5) * step));
        grid.weights_sr.push_back((north - south) * kTurn / static_cast<double>(grid.azimuths));
    }
    return grid;
}

}  // namespace stilb::geometry
