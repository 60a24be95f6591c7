// Which of many bounding boxes meet another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/vec.h"

namespace stilb::geometry {

/// A binary tree over boxes, none of them empty. Immutable.
class BoundsTree {
  public:
    explicit BoundsTree(std::span<const Bounds> boxes);

    /// Whether `condition(number)` holds for one of the boxes that meet or touch `bounds`; the order in which
    /// it is asked is that of the tree.
    bool any_meeting(const Bounds& bounds, const std::function<bool(std::uint32_t)>& condition) const;

  private:
    struct Search;
    void add(std::span<const Bounds> boxes, std::size_t node, std::span<std::uint32_t> numbers);

    std::vector<Bounds> nodes_;           ///< a node, the nodes below its first half, those below its second
    std::vector<std::uint32_t> numbers_;  ///< of the boxes, in the order of the leaves
};

}  // namespace stilb::geometry
