// Disjoint sets, joined step by step.
#pragma once

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

    void join(std::uint32_t a, std::uint32_t b) { parent_[root(b)] = root(a); }

    /// For each member the number of its set, in the order of the sets' first members; and the number of
    /// sets.
    std::pair<std::vector<std::uint32_t>, std::size_t> numbered() {
        constexpr std::uint32_t none = ~0u;
        std::vector<std::uint32_t> number_of_root(parent_.size(), none), numbers(parent_.size());
        std::uint32_t count = 0;
        for (std::uint32_t i = 0; i < parent_.size(); ++i) {
            std::uint32_t& number = number_of_root[root(i)];
            if (number == none) number = count++;
            numbers[i] = number;
        }
        return {std::move(numbers), count};
    }

  private:
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    std::vector<std::uint32_t> parent_;
};

}  // namespace stilb::math
