#include "estimators/node_selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "scene/morton.h"

namespace stilb {
namespace {

/// Which of the six axis directions a normal is nearest to.
int orientation(const Vec3& normal) {
    const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (normal[static_cast<std::size_t>(axis)] < 0 ? 1 : 0);
}

std::vector<std::size_t> order_over_surfaces(const std::vector<ChainNode>& nodes) {
    std::vector<Vec3> positions;
    positions.reserve(nodes.size());
    for (const ChainNode& node : nodes) positions.push_back(node.position);
    const std::vector<std::uint64_t> codes = morton_codes(positions);
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

double reflected_flux_lm(const ChainNode& node) {
    return (node.flux_lm * reflectance_bound(*node.material)).luminance();
}

}  // namespace

std::vector<ChainNode> select_nodes(const std::vector<ChainNode>& nodes, std::size_t count, double u) {
    if (count >= nodes.size()) return nodes;
    const double total =
        std::accumulate(nodes.begin(), nodes.end(), 0.0,
                        [](double sum, const ChainNode& node) { return sum + reflected_flux_lm(node); });
    const double step = total / static_cast<double>(count);
    std::vector<ChainNode> selected;
    selected.reserve(count + 1);
    double passed = 0;       // flux of the nodes passed
    double next = u * step;  // flux at which the next one is selected
    for (const std::size_t n : order_over_surfaces(nodes)) {
        const double flux = reflected_flux_lm(nodes[n]);
        passed += flux;
        if (passed <= next) continue;
        const double times = std::ceil((passed - next) / step);
        next += times * step;
        selected.push_back(nodes[n]);
        selected.back().flux_lm *= times * step / flux;
    }
    return selected;
}

}  // namespace stilb
