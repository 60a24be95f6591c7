// Choice of one of many lights at a point in sublinear time, after [Conty Estevez and Kulla 2018].
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/surface_point.h"
#include "math/sampling.h"

namespace stilb::transport {

/// A binary tree of bounding boxes over lights. At a point, all boxes that are near for their size are
/// opened, down to single lights or until there are kMostOpen of them; one is chosen by its estimated
/// contribution, and one branch at each level below it. The caller's `rough_lx(number)` estimates point
/// lights; boxes and surfaces are estimated by intensity over the squared distance times the largest cosine
/// above the surface: never 0 where one of the lights contributes. Immutable; queries allocate no memory.
class LightTree {
  public:
    struct Light {
        std::uint32_t number = 0;  ///< the caller's
        Bounds bounds;
        double intensity_cd = 0;  ///< luminous, approximate
        bool is_point = false;
    };

    struct Node {
        Vec3 center;
        Vec3 half;  ///< of the box's edges
        double squared_radius_m2 = 0;
        double intensity_cd = 0;
        std::uint32_t parent = 0;
        std::uint32_t first = 0;  ///< first child, followed by the other; for single lights: the number
        bool is_light = false, is_point = false;
    };

    LightTree() = default;
    explicit LightTree(std::vector<Light> lights);
    bool is_empty() const { return nodes_.empty(); }

    /// The opened boxes at a point, with running sums of their estimates [lx].
    class Cut {
      public:
        double total_lx() const { return count_ == 0 ? 0 : sums_lx_[count_ - 1]; }

        std::size_t count() const { return count_; }
        /// Replaces the estimates, in the order in which the view was asked for them.
        void set_estimates_lx(std::span<const double> estimates_lx) {
            double total_lx = 0;
            for (std::size_t i = 0; i < count_; ++i) sums_lx_[i] = total_lx += estimates_lx[i];
        }

        static constexpr std::size_t kMostOpen = 32;

      private:
        friend class LightTree;
        std::array<std::uint32_t, kMostOpen> nodes_;
        std::array<double, kMostOpen> sums_lx_;
        std::size_t count_ = 0;
    };
    /// `view`: of a receiver, with nearness(node) and estimate_lx(node).
    template <typename View>
    Cut cut(const View& view) const;

    /// A light's number with its probability; the cut of the same point must not be empty.
    template <typename View>
    math::DiscreteChoice choose(const Cut& cut, const View& view, double u) const;
    /// The probability that choose() selects a light of the tree.
    template <typename View>
    double probability(const Cut& cut, std::uint32_t number, const View& view) const;

    /// The squared ratio of a box's radius and its distance; boxes below kNear stay closed.
    static double nearness_of(const Node& node, const Vec3& from);
    static double box_lx(const Node& node, const SurfacePoint& at);

  private:
    void divide(std::uint32_t node, std::span<Light> lights);
    static constexpr double kNear = 1. / 9;
    /// The probability of the first child. A box may have a corner above the horizon where neither child has
    /// one.
    template <typename View>
    double first_probability(const Node& parent, const View& view) const {
        const double first = view.estimate_lx(nodes_[parent.first]);
        const double second = view.estimate_lx(nodes_[parent.first + 1]);
        return first + second > 0 ? first / (first + second) : 0.5;
    }

    std::vector<Node> nodes_;             ///< the root first
    std::vector<std::uint32_t> node_of_;  ///< of lights, by number
};

template <typename View>
LightTree::Cut LightTree::cut(const View& view) const {
    Cut cut;
    if (nodes_.empty()) return cut;
    /// Boxes to be opened, as a heap: the nearest relative to its size first.
    struct Waiting {
        double nearness;
        std::uint32_t node;
        auto operator<=>(const Waiting&) const = default;
    };
    std::array<Waiting, Cut::kMostOpen> waiting;
    auto end = waiting.begin();
    const auto add = [&](std::uint32_t node) {
        const double nearness = nodes_[node].is_light ? 0 : view.nearness(nodes_[node]);
        if (nearness < kNear) {
            cut.nodes_[cut.count_++] = node;
        } else {
            *end++ = {nearness, node};
            std::push_heap(waiting.begin(), end);
        }
    };
    add(0);
    while (end != waiting.begin()) {
        std::pop_heap(waiting.begin(), end);
        const std::uint32_t node = (--end)->node;
        const std::size_t open = cut.count_ + static_cast<std::size_t>(end - waiting.begin());
        if (open + 2 > Cut::kMostOpen) {
            cut.nodes_[cut.count_++] = node;
        } else {
            add(nodes_[node].first);
            add(nodes_[node].first + 1);
        }
    }
    double total_lx = 0;
    for (std::size_t i = 0; i < cut.count_; ++i) {
        cut.sums_lx_[i] = total_lx += view.estimate_lx(nodes_[cut.nodes_[i]]);
    }
    return cut;
}

template <typename View>
math::DiscreteChoice LightTree::choose(const Cut& cut, const View& view, double u) const {
    math::DiscreteChoice choice = math::choose_by_sums({cut.sums_lx_.data(), cut.count_}, u);
    std::uint32_t at = cut.nodes_[choice.index];
    while (!nodes_[at].is_light) {
        const double first = first_probability(nodes_[at], view);
        const bool is_first = choice.remainder < first;
        const double share = is_first ? first : 1 - first;
        choice.remainder = std::clamp((is_first ? choice.remainder : choice.remainder - first) / share, 0.0,
                                      math::kBelowOne);
        choice.probability *= share;
        at = nodes_[at].first + (is_first ? 0 : 1);
    }
    choice.index = nodes_[at].first;
    return choice;
}

template <typename View>
double LightTree::probability(const Cut& cut, std::uint32_t number, const View& view) const {
    double below = 1;
    const auto end = cut.nodes_.begin() + static_cast<std::ptrdiff_t>(cut.count_);
    for (std::uint32_t node = node_of_[number];; node = nodes_[node].parent) {
        const auto found = std::find(cut.nodes_.begin(), end, node);
        if (found != end) {
            const auto index = static_cast<std::size_t>(found - cut.nodes_.begin());
            const double own_lx = cut.sums_lx_[index] - (index == 0 ? 0 : cut.sums_lx_[index - 1]);
            return below * own_lx / cut.total_lx();
        }
        const Node& parent = nodes_[nodes_[node].parent];
        const double first = first_probability(parent, view);
        below *= node == parent.first ? first : 1 - first;
    }
}

}  // namespace stilb::transport
