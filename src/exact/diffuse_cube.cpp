#include "exact/diffuse_cube.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exact/configuration_factors.h"
#include "exact/domain.h"

namespace stilb::exact {
namespace {

using std::numbers::pi;

/// A face of the unit cube that the floor sees, front inwards.
struct Face {
    Vec3 corner, u, v;
};
constexpr std::array<Face, 5> kFaces{{{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
                                      {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                      {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                      {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}},
                                      {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}}};

/// By a source of 1 lm in the middle of the unit cube; from a corner of the face.
double direct_illuminance(double x, double y) {
    const double distance = std::hypot(x - 0.5, y - 0.5, 0.5);
    return 0.5 / (4 * pi * distance * distance * distance);
}

void require_reflectance(double reflectance) {
    require(reflectance >= 0 && reflectance < 1, "cube: the reflectance is not from 0 to below 1");
}

}  // namespace

CubeRaster::CubeRaster(int cells) : cells_(cells) {
    const int half = cells / 2;
    for (int k = 0; k <= cells; ++k) {
        const double from_edge = std::min(k, cells - k) / static_cast<double>(half);
        const double distance = 0.5 * from_edge * from_edge;
        edges_.push_back(k <= half ? distance : 1 - distance);
    }
    const auto middle = [&](int k) { return (edges_[k] + edges_[k + 1]) / 2; };
    for (int i = 0; i < half; ++i) {
        for (int j = 0; j <= i; ++j) places_.push_back({middle(i), middle(j)});
    }
    for (const auto& [x, y] : places_) factors_.push_back(factors(x, y));
}

/// Cells have the same number where a symmetry of the cube moves one to the other.
std::size_t CubeRaster::number_of(int i, int j) const {
    const auto [low, high] = std::minmax({std::min(i, cells_ - 1 - i), std::min(j, cells_ - 1 - j)});
    const int number = high * (high + 1) / 2 + low;
    return static_cast<std::size_t>(number);
}

std::vector<double> CubeRaster::factors(double x, double y) const {
    std::vector<double> sums(places_.size());
    const Receiver floor{{x, y, 0}, {0, 0, 1}};
    for (const auto& [corner, u, v] : kFaces) {
        for (int i = 0; i < cells_; ++i) {
            for (int j = 0; j < cells_; ++j) {
                const double width = edges_[i + 1] - edges_[i], height = edges_[j + 1] - edges_[j];
                sums[number_of(i, j)] += illuminance_by_rectangle_lx(
                    floor, corner + edges_[i] * u + edges_[j] * v, width * u, height * v, 1 / pi);
            }
        }
    }
    return sums;
}

/// By Gauss-Seidel iteration, which converges as the reflectance is below 1.
std::vector<double> CubeRaster::cell_illuminances(double reflectance) const {
    constexpr double rounding = 1e-13;
    std::vector<double> all(places_.size());
    for (double change = 1; change > rounding;) {
        change = 0;
        for (std::size_t c = 0; c < all.size(); ++c) {
            double sum = direct_illuminance(places_[c][0], places_[c][1]);
            for (std::size_t other = 0; other < all.size(); ++other)
                sum += reflectance * factors_[c][other] * all[other];
            change = std::max(change, std::abs(sum - all[c]) / sum);
            all[c] = sum;
        }
    }
    return all;
}

double CubeRaster::indirect_illuminance(double reflectance, double x, double y) const {
    const std::vector<double> of_cells = cell_illuminances(reflectance), seen = factors(x, y);
    double sum = 0;
    for (std::size_t c = 0; c < of_cells.size(); ++c) sum += reflectance * seen[c] * of_cells[c];
    return sum;
}

DiffuseCube::DiffuseCube(double side_m, double flux_lm) : side_m_(side_m), flux_lm_(flux_lm) {
    require_positive(side_m, "cube: the side is not positive");
    require_positive(flux_lm, "cube: the flux is not positive");
}

double DiffuseCube::direct_illuminance_lx(double x_m, double y_m) const {
    return flux_lm_ / (side_m_ * side_m_) * direct_illuminance(0.5 + x_m / side_m_, 0.5 + y_m / side_m_);
}

double DiffuseCube::indirect_illuminance_lx(double reflectance, double x_m, double y_m) const {
    require_reflectance(reflectance);
    const double x = 0.5 + x_m / side_m_, y = 0.5 + y_m / side_m_;
    require(x > 0 && x < 1 && y > 0 && y < 1, "cube: the place is not on the face");
    const double coarse = coarse_.indirect_illuminance(reflectance, x, y),
                 fine = fine_.indirect_illuminance(reflectance, x, y);
    // The error falls with the square of the cells' size.
    return flux_lm_ / (side_m_ * side_m_) * (4 * fine - coarse) / 3;
}

double DiffuseCube::mean_illuminance_lx(double reflectance) const {
    require_reflectance(reflectance);
    return flux_lm_ / (6 * side_m_ * side_m_ * (1 - reflectance));
}

}  // namespace stilb::exact
