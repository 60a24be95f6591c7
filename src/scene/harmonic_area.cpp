#include "scene/harmonic_area.h"

#include <boost/math/quadrature/gauss.hpp>
#include <utility>
#include <vector>

#include "scene/harmonic_cells.h"

namespace stilb {
namespace {

double area_of_cell(const HarmonicCells& cells, std::size_t cell) {
    using Rule = boost::math::quadrature::gauss<double, 7>;
    return Rule::integrate([&](double a) {
        return Rule::integrate([&](double b) { return cells.element_at(cell, a, b).area; });
    });
}

}  // namespace

HarmonicArea::HarmonicArea(std::shared_ptr<const HarmonicCells> cells) : cells_(std::move(cells)) {
    std::vector<double> areas;
    for (std::size_t cell = 0; cell < cells_->count(); ++cell) areas.push_back(area_of_cell(*cells_, cell));
    by_area_ = DiscreteDistribution(areas);
}

HarmonicArea::Point HarmonicArea::sample(const std::array<double, 2>& u) const {
    const auto choice = by_area_.choose(u[0]);
    const HarmonicCells::Element element =
        cells_->element_at(choice.index, 2 * choice.remainder - 1, 2 * u[1] - 1);
    return {element.position, element.normal, choice.probability / (4 * element.area)};
}

}  // namespace stilb
