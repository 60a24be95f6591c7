#include "geometry/harmonics/area.h"

#include <utility>
#include <vector>

#include "geometry/harmonics/cells.h"
#include "math/gauss_legendre.h"

namespace stilb::geometry {
namespace {

double area_of_cell(const HarmonicCells& cells, std::size_t cell) {
    static const math::GaussLegendre rule = math::gauss_legendre(7);
    double area = 0;
    for (std::size_t m = 0; m < rule.nodes.size(); ++m) {
        for (std::size_t n = 0; n < rule.nodes.size(); ++n) {
            area +=
                rule.weights[m] * rule.weights[n] * cells.element_at(cell, rule.nodes[m], rule.nodes[n]).area;
        }
    }
    return area;
}

}  // namespace

HarmonicArea::HarmonicArea(std::shared_ptr<const HarmonicCells> cells) : cells_(std::move(cells)) {
    std::vector<double> areas;
    for (std::size_t cell = 0; cell < cells_->count(); ++cell) areas.push_back(area_of_cell(*cells_, cell));
    by_area_ = math::DiscreteDistribution(areas);
}

HarmonicArea::Point HarmonicArea::sample(const std::array<double, 2>& u) const {
    const auto choice = by_area_.choose(u[0]);
    const HarmonicCells::Element element =
        cells_->element_at(choice.index, 2 * choice.remainder - 1, 2 * u[1] - 1);
    return {element.position, element.normal, choice.probability / (4 * element.area)};
}

}  // namespace stilb::geometry
