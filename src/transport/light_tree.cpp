#include "transport/light_tree.h"

#include <cmath>
#include <limits>
#include <utility>

namespace stilb::transport {

LightTree::LightTree(std::vector<Light> lights) {
    if (lights.empty()) return;
    std::uint32_t largest = 0;
    for (const Light& light : lights) largest = std::max(largest, light.number);
    node_of_.resize(std::size_t{largest} + 1);
    nodes_.emplace_back();
    divide(0, lights);
}

void LightTree::divide(std::uint32_t node, std::span<Light> lights) {
    Bounds bounds, middles;
    double intensity_cd = 0;
    const auto middle = [](const Light& light) { return 0.5 * (light.bounds.min + light.bounds.max); };
    for (const Light& light : lights) {
        bounds.include(light.bounds.min), bounds.include(light.bounds.max);
        middles.include(middle(light));
        intensity_cd += light.intensity_cd;
    }
    nodes_[node].center = bounds.middle();
    nodes_[node].half = 0.5 * (bounds.max - bounds.min);
    nodes_[node].squared_radius_m2 = squared_length(nodes_[node].half);
    nodes_[node].intensity_cd = intensity_cd;
    if (lights.size() == 1) {
        nodes_[node].is_light = true;
        nodes_[node].is_point = lights[0].is_point;
        nodes_[node].first = lights[0].number;
        node_of_[lights[0].number] = node;
        return;
    }
    const Vec3 extent = middles.max - middles.min;
    const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::size_t count = lights.size() / 2;
    std::ranges::nth_element(lights, lights.begin() + static_cast<std::ptrdiff_t>(count), {},
                             [&](const Light& light) {
                                 return std::pair{middle(light)[axis], light.number};
                             });
    const auto first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].first = first;
    for (int child = 0; child < 2; ++child) nodes_.emplace_back().parent = node;
    divide(first, lights.first(count));
    divide(first + 1, lights.subspan(count));
}

double LightTree::nearness_of(const Node& node, const Vec3& from) {
    const double squared_m2 = squared_length(node.center - from);
    return squared_m2 > 0 ? node.squared_radius_m2 / squared_m2 : std::numeric_limits<double>::infinity();
}

double LightTree::box_lx(const Node& node, const SurfacePoint& at) {
    const auto& [position, normal, lifted] = at;
    const Vec3 towards = node.center - position;
    const double reach_m = std::abs(normal.x) * node.half.x + std::abs(normal.y) * node.half.y +
                           std::abs(normal.z) * node.half.z;
    const double height_m = dot(towards, normal) + reach_m;  // of the box's highest corner
    if (!(height_m > 0)) return 0;
    const double squared_m2 = squared_length(towards) + node.squared_radius_m2;
    const double cosine = std::min(1.0, height_m / std::sqrt(squared_m2));
    return node.intensity_cd * cosine / squared_m2;
}

}  // namespace stilb::transport
