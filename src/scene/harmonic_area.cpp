#include "scene/harmonic_area.h"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/harmonic_surface.h"

namespace stilb {
namespace {

/// Exact for polynomials of degree 13 in each direction.
using Rule = boost::math::quadrature::gauss<double, 7>;

/// The direction through a point of face 2 k (x_k = 1) or 2 k + 1 (x_k = -1) of the cube [-1, 1]^3.
Vec3 on_cube(std::size_t face, double s, double t) {
    std::array<double, 3> x{};
    x[face / 2] = face % 2 == 0 ? 1 : -1;
    x[(face / 2 + 1) % 3] = s;
    x[(face / 2 + 2) % 3] = t;
    return {x[0], x[1], x[2]};
}

}  // namespace

HarmonicArea::HarmonicArea(std::shared_ptr<const HarmonicSurface> surface)
    : surface_(std::move(surface)),
      cells_on_edge_(3 + static_cast<std::size_t>(surface_->radius().degree()) / 6),
      half_(1 / static_cast<double>(cells_on_edge_)) {
    std::vector<double> areas;
    for (std::size_t cell = 0; cell < 6 * cells_on_edge_ * cells_on_edge_; ++cell) {
        const std::size_t face = cell / (cells_on_edge_ * cells_on_edge_);
        const double s = half_ * static_cast<double>(2 * (cell % cells_on_edge_) + 1) - 1;
        const double t = half_ * static_cast<double>(2 * (cell / cells_on_edge_ % cells_on_edge_) + 1) - 1;
        areas.push_back(half_ * half_ * Rule::integrate([&](double a) {
                            return Rule::integrate([&](double b) {
                                return element_at(face, s + half_ * a, t + half_ * b).area;
                            });
                        }));
    }
    by_area_ = DiscreteDistribution(areas);
}

HarmonicArea::Element HarmonicArea::element_at(std::size_t face, double s, double t) const {
    const Vec3 through = on_cube(face, s, t);
    const double distance = length(through);
    const Vec3 direction = through / distance;
    const auto [radius, gradient] = surface_->radius().with_gradient(direction);
    const double slant = std::sqrt(radius * radius + squared_length(gradient));
    return {radius * direction, (radius * direction - gradient) / slant,
            radius * slant / (distance * distance * distance)};
}

HarmonicArea::Point HarmonicArea::sample(const std::array<double, 2>& u) const {
    const auto choice = by_area_.choose(u[0]);
    const std::size_t face = choice.index / (cells_on_edge_ * cells_on_edge_);
    const auto place = [&](std::size_t cell, double part) {
        return 2 * half_ * (static_cast<double>(cell) + part) - 1;
    };
    const double s = place(choice.index % cells_on_edge_, choice.remainder);
    const double t = place(choice.index / cells_on_edge_ % cells_on_edge_, u[1]);
    const Element element = element_at(face, s, t);
    return {element.position, element.normal, choice.probability / (4 * half_ * half_ * element.area)};
}

}  // namespace stilb
