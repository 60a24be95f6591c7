#include "estimators/local/node_pool.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "materials/material.h"
#include "math/morton.h"

namespace stilb::estimators {
namespace {

/// The index of the axis direction nearest to a normal, of six.
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

/// The importance of a vertex: the reflected flux, times the root mean square of the relative BRDF. Residual
/// light may be negative, in one band or in all.
double importance_of(const transport::LightVertex& node) {
    const Rgb reflected = node.flux_lm * reflectance_bound(*node.material);
    return Rgb{{std::abs(reflected[0]), std::abs(reflected[1]), std::abs(reflected[2])}}.luminance() *
           std::sqrt(mean_concentration(*node.material));
}

}  // namespace

NodePool::NodePool(const std::vector<transport::LightVertex>& nodes) {
    nodes_.reserve(nodes.size());
    passed_.reserve(nodes.size());
    double passed = 0;
    for (const std::size_t n : order_over_surfaces(nodes)) {
        nodes_.push_back(nodes[n]);
        passed_.push_back(passed += importance_of(nodes[n]));
    }
}

std::vector<transport::LightVertex> NodePool::select(std::size_t count, double u) const {
    if (count >= nodes_.size()) return nodes_;
    const double step = passed_.back() / static_cast<double>(count);
    std::vector<transport::LightVertex> selected;
    selected.reserve(count + 1);
    double next = u * step;  // flux at which the next vertex is selected
    for (auto bound = passed_.begin(); bound != passed_.end(); ++bound) {
        bound = std::upper_bound(bound, passed_.end(), next);
        if (bound == passed_.end()) break;
        const double times = std::ceil((*bound - next) / step);
        next += times * step;
        const transport::LightVertex& node = nodes_[static_cast<std::size_t>(bound - passed_.begin())];
        selected.push_back(node);
        selected.back().flux_lm *= times * step / importance_of(node);
    }
    return selected;
}

NearNodePool::NearNodePool(const std::vector<transport::LightVertex>& nodes, const Vec3& center)
    : choice_(center) {
    nodes_.reserve(nodes.size());
    for (const std::size_t n : order_over_surfaces(nodes)) {
        nodes_.push_back(nodes[n]);
        choice_.add(nodes[n].position, nodes[n].normal, importance_of(nodes[n]));
    }
}

std::vector<transport::LightVertex> NearNodePool::select(const KernelChoice::Sums& sums, std::size_t count,
                                                         double u) const {
    std::vector<transport::LightVertex> selected;
    selected.reserve(count);
    KernelChoice::select(sums, count, u, [&](std::size_t i, double times, double) {
        selected.push_back(nodes_[i]);
        selected.back().flux_lm *= times;
    });
    return selected;
}

}  // namespace stilb::estimators
