// Disjoint sets, joined step by step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace stilb::math {

/// Initially every member 0 ... count - 1 is a set of its own.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }

    void join(std::uint32_t a, std::uint32_t b) {
        const auto [first, second] = std::minmax({root(a), root(b)});
        parent_[second] = first;
    }

    /// For each member the number of its set, in the order of the sets' first members; and the number of
    /// sets.
    std::pair<std::vector<std::uint32_t>, std::size_t> numbered() && {
        std::uint32_t count = 0;
        // A parent comes before its members, and has its number already.
        for (std::uint32_t i = 0; i < parent_.size(); ++i)
            parent_[i] = parent_[i] == i ? count++ : parent_[parent_[i]];
        return {std::move(parent_), count};
    }

  private:
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    /// Never behind the member.
    std::vector<std::uint32_t> parent_;
};

}  // namespace stilb::math
