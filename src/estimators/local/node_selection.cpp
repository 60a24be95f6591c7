#include "estimators/local/node_selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "math/morton.h"

namespace stilb::estimators {
namespace {

/// Which of the six axis directions a normal is nearest to.
int orientation(const Vec3& normal) {
    const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (normal[static_cast<std::size_t>(axis)] < 0 ? 1 : 0);
}

std::vector<std::size_t> order_over_surfaces(const std::vector<transport::LightVertex>& nodes) {
    std::vector<Vec3> positions;
    positions.reserve(nodes.size());
    for (const transport::LightVertex& node : nodes) positions.push_back(node.position);
    const std::vector<std::uint64_t> codes = math::morton_codes(positions);
    std::vector<std::tuple<int, std::uint64_t, std::size_t>> keys;
    keys.reserve(nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n)
        keys.emplace_back(orientation(nodes[n].normal), codes[n], n);
    std::sort(keys.begin(), keys.end());
    std::vector<std::size_t> order;
    order.reserve(nodes.size());
    for (const auto& key : keys) order.push_back(std::get<2>(key));
    return order;
}

double reflected_flux_lm(const transport::LightVertex& node) {
    return (node.flux_lm * reflectance_bound(*node.material)).luminance();
}

}  // namespace

NodePool::NodePool(const std::vector<transport::LightVertex>& nodes) {
    nodes_.reserve(nodes.size());
    passed_lm_.reserve(nodes.size());
    double passed_lm = 0;
    for (const std::size_t n : order_over_surfaces(nodes)) {
        nodes_.push_back(nodes[n]);
        passed_lm_.push_back(passed_lm += reflected_flux_lm(nodes[n]));
    }
}

std::vector<transport::LightVertex> NodePool::select(std::size_t count, double u) const {
    if (count >= nodes_.size()) return nodes_;
    const double step = passed_lm_.back() / static_cast<double>(count);
    std::vector<transport::LightVertex> selected;
    selected.reserve(count + 1);
    double next = u * step;  // flux at which the next one is selected
    for (auto place = passed_lm_.begin(); place != passed_lm_.end(); ++place) {
        place = std::upper_bound(place, passed_lm_.end(), next);
        if (place == passed_lm_.end()) break;
        const double times = std::ceil((*place - next) / step);
        next += times * step;
        const transport::LightVertex& node = nodes_[static_cast<std::size_t>(place - passed_lm_.begin())];
        selected.push_back(node);
        selected.back().flux_lm *= times * step / reflected_flux_lm(node);
    }
    return selected;
}

}  // namespace stilb::estimators
