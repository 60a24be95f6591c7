// A tree of bounding boxes: what a ray may meet, from near to far.
#pragma once

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "base/vec.h"

namespace stilb {

class BoxTree {
  public:
    explicit BoxTree(const std::vector<Bounds>& boxes) : order_(boxes.size()) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        if (!boxes.empty()) add(boxes, 0, boxes.size());
    }

    /// The least distance that `crossing(item, start, end)` gives for items whose box the ray meets.
    template <typename Crossing>
    std::optional<double> first(const Vec3& origin, const Vec3& direction, double start,
                                const Crossing& crossing) const {
        double end = Bounds::kInfinity;
        if (!nodes_.empty()) visit(0, origin, direction, start, end, crossing);
        return end < Bounds::kInfinity ? std::optional(end) : std::nullopt;
    }

  private:
    struct Node {
        Bounds box;
        std::size_t first = 0, last = 0;  ///< of order_
        std::size_t right = 0;            ///< the left child is the next node; 0 for leaves
    };
    static constexpr std::size_t kLeaf = 4;

    void add(const std::vector<Bounds>& boxes, std::size_t first, std::size_t last) {
        const std::size_t number = nodes_.size();
        Node& node = nodes_.emplace_back();
        node.first = first, node.last = last;
        Bounds middles;
        for (std::size_t n = first; n < last; ++n) {
            const Bounds& box = boxes[order_[n]];
            node.box.include(box.min);
            node.box.include(box.max);
            middles.include(0.5 * (box.min + box.max));
        }
        if (last - first <= kLeaf) return;
        const Vec3 extent = middles.max - middles.min;
        const std::size_t axis = extent.x > std::max(extent.y, extent.z) ? 0 : extent.y > extent.z ? 1 : 2;
        const auto at = [&](std::size_t n) { return order_.begin() + static_cast<std::ptrdiff_t>(n); };
        const std::size_t half = (first + last) / 2;
        std::nth_element(at(first), at(half), at(last), [&](std::size_t a, std::size_t b) {
            return boxes[a].min[axis] + boxes[a].max[axis] < boxes[b].min[axis] + boxes[b].max[axis];
        });
        add(boxes, first, half);
        nodes_[number].right = nodes_.size();
        add(boxes, half, last);
    }

    /// Where the ray enters a box; infinity where it passes by. A little larger than it is, for rounding.
    static double entry(const Bounds& box, const Vec3& origin, const Vec3& direction, double start,
                        double end) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double o = origin[axis], d = direction[axis];
            const double margin = 1e-9 * (1 + std::abs(o));
            const double low = box.min[axis] - margin - o, high = box.max[axis] + margin - o;
            if (d == 0) {
                if (low > 0 || high < 0) return Bounds::kInfinity;
                continue;
            }
            start = std::max(start, std::min(low / d, high / d));
            end = std::min(end, std::max(low / d, high / d));
        }
        return start <= end ? start : Bounds::kInfinity;
    }

    template <typename Crossing>
    void visit(std::size_t number, const Vec3& origin, const Vec3& direction, double start, double& end,
               const Crossing& crossing) const {
        const Node& node = nodes_[number];
        if (node.right == 0) {
            for (std::size_t n = node.first; n < node.last; ++n) {
                end = std::min(end, crossing(order_[n], start, end));
            }
            return;
        }
        const auto distance = [&](std::size_t child) {
            return entry(nodes_[child].box, origin, direction, start, end);
        };
        std::size_t near = number + 1, far = node.right;
        double near_entry = distance(near), far_entry = distance(far);
        if (far_entry < near_entry) std::swap(near, far), std::swap(near_entry, far_entry);
        if (near_entry < Bounds::kInfinity) visit(near, origin, direction, start, end, crossing);
        if (far_entry < end) visit(far, origin, direction, start, end, crossing);
    }

    std::vector<std::size_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace stilb
