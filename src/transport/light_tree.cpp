#include "transport/light_tree.h"

#include <algorithm>
#include <cmath>

#include "math/sampling.h"

namespace stilb::transport {

LightTree::LightTree(std::vector<Light> lights) {
    if (lights.empty()) return;
    std::uint32_t largest = 0;
    for (const Light& light : lights) largest = std::max(largest, light.number);
    group_of_.resize(std::size_t{largest} + 1);
    nodes_.emplace_back();
    divide(0, lights);
}

void LightTree::divide(std::uint32_t node, std::span<Light> lights) {
    Bounds bounds, middles;
    double flux_lm = 0;
    const auto middle = [](const Light& light) { return 0.5 * (light.bounds.min + light.bounds.max); };
    for (const Light& light : lights) {
        bounds.include(light.bounds.min), bounds.include(light.bounds.max);
        middles.include(middle(light));
        flux_lm += light.flux_lm;
    }
    const Vec3 half = 0.5 * (bounds.max - bounds.min);
    nodes_[node].center = 0.5 * (bounds.min + bounds.max);
    nodes_[node].half = half;
    nodes_[node].squared_radius_m2 = squared_length(half);
    nodes_[node].flux_lm = flux_lm;
    if (lights.size() <= kGroup) {
        nodes_[node].first = static_cast<std::uint32_t>(numbers_.size());
        nodes_[node].count = static_cast<std::uint32_t>(lights.size());
        for (const Light& light : lights) {
            numbers_.push_back(light.number);
            group_of_[light.number] = node;
        }
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

double LightTree::importance(const Node& node, const Vec3& from, const Vec3& normal) const {
    const Vec3 towards = node.center - from;
    const double reach_m = std::abs(normal.x) * node.half.x + std::abs(normal.y) * node.half.y +
                           std::abs(normal.z) * node.half.z;
    const double height_m = dot(towards, normal) + reach_m;  // of the box's highest corner
    if (!(height_m > 0)) return 0;
    const double squared_m2 = squared_length(towards) + node.squared_radius_m2;
    const double cosine = std::min(1.0, height_m / std::sqrt(squared_m2));
    return node.flux_lm * cosine / squared_m2;
}

double LightTree::first_probability(const Node& parent, const Vec3& from, const Vec3& normal) const {
    const double first = importance(nodes_[parent.first], from, normal);
    const double second = importance(nodes_[parent.first + 1], from, normal);
    // The parent's box may have a corner above the horizon where neither child's has one.
    return first + second > 0 ? first / (first + second) : 0.5;
}

double LightTree::rough_illuminance_lx(const Vec3& from, const Vec3& normal) const {
    return nodes_.empty() ? 0 : importance(nodes_[0], from, normal);
}

LightTree::Choice LightTree::choose(const Vec3& from, const Vec3& normal, double u) const {
    std::uint32_t at = 0;
    double probability = 1;
    while (nodes_[at].count == 0) {
        const double first = first_probability(nodes_[at], from, normal);
        const bool is_first = u < first;
        const double share = is_first ? first : 1 - first;
        u = std::clamp((is_first ? u : u - first) / share, 0.0, math::kBelowOne);
        probability *= share;
        at = nodes_[at].first + (is_first ? 0 : 1);
    }
    return {group(nodes_[at]), probability, u};
}

LightTree::Choice LightTree::group_of(std::uint32_t number, const Vec3& from, const Vec3& normal) const {
    const std::uint32_t node = group_of_[number];
    double probability = 1;
    for (std::uint32_t at = node; at != 0; at = nodes_[at].parent) {
        const Node& parent = nodes_[nodes_[at].parent];
        const double first = first_probability(parent, from, normal);
        probability *= at == parent.first ? first : 1 - first;
    }
    return {group(nodes_[node]), probability, 0};
}

}  // namespace stilb::transport
