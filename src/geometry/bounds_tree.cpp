#include "geometry/bounds_tree.h"

#include <algorithm>
#include <numeric>

namespace stilb::geometry {
namespace {

bool meet(const Bounds& a, const Bounds& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
           a.min.z <= b.max.z && b.min.z <= a.max.z;
}

std::size_t longest_axis(const Bounds& bounds) {
    const Vec3 extent = bounds.max - bounds.min;
    if (extent.x >= std::max(extent.y, extent.z)) return 0;
    return extent.y >= extent.z ? 1 : 2;
}

// A tree of n leaves has 2 n - 1 nodes.
std::size_t first_child(std::size_t node) { return node + 1; }
std::size_t second_child(std::size_t node, std::size_t leaves_of_first) { return node + 2 * leaves_of_first; }

}  // namespace

struct BoundsTree::Search {
    const BoundsTree& tree;
    const Bounds& bounds;
    const std::function<bool(std::uint32_t)>& condition;

    bool succeeds(std::size_t node, std::span<const std::uint32_t> numbers) const {
        if (!meet(tree.nodes_[node], bounds)) return false;
        if (numbers.size() == 1) return condition(numbers[0]);
        const std::size_t half = numbers.size() / 2;
        return succeeds(first_child(node), numbers.first(half)) ||
               succeeds(second_child(node, half), numbers.subspan(half));
    }
};

BoundsTree::BoundsTree(std::span<const Bounds> boxes)
    : nodes_(boxes.empty() ? 0 : 2 * boxes.size() - 1), numbers_(boxes.size()) {
    std::iota(numbers_.begin(), numbers_.end(), 0u);
    if (!boxes.empty()) add(boxes, 0, numbers_);
}

void BoundsTree::add(std::span<const Bounds> boxes, std::size_t node, std::span<std::uint32_t> numbers) {
    Bounds all, middles;
    for (const std::uint32_t number : numbers) {
        all.include(boxes[number].min);
        all.include(boxes[number].max);
        middles.include(boxes[number].middle());
    }
    nodes_[node] = all;
    if (numbers.size() > 1) {
        const std::size_t half = numbers.size() / 2, axis = longest_axis(middles);
        std::ranges::nth_element(numbers, numbers.begin() + static_cast<std::ptrdiff_t>(half), {},
                                 [&](std::uint32_t number) { return boxes[number].middle()[axis]; });
        add(boxes, first_child(node), numbers.first(half));
        add(boxes, second_child(node, half), numbers.subspan(half));
    }
}

bool BoundsTree::any_meeting(const Bounds& bounds,
                             const std::function<bool(std::uint32_t)>& condition) const {
    return !nodes_.empty() && Search{*this, bounds, condition}.succeeds(0, numbers_);
}

}  // namespace stilb::geometry
