// The choice among many lights at a point, by their light there without shadows.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/surface_point.h"
#include "math/sampling.h"
#include "transport/light_tree.h"

namespace stilb::transport {

class LightSampler;

/// Lights of which some are chosen: few by the estimates of all, many by a tree, and that from infinity
/// apart.
class LightChoice {
  public:
    /// The largest number of lights that are all estimated.
    static constexpr std::size_t kFew = 32;

    LightChoice() = default;
    /// `outside`: the number of the light from infinity, if it is one of them.
    LightChoice(std::vector<LightTree::Light> lights, std::optional<std::uint32_t> outside);
    bool is_empty() const { return few_.empty() && tree_.is_empty(); }

    class At;

  private:
    std::vector<std::uint32_t> few_;  ///< the numbers of all lights, where they are few
    LightTree tree_;                  ///< else: of those at finite distance
    std::optional<std::uint32_t> outside_;
};

/// The choice at a point of a surface. Keeps references to its arguments, and allocates no memory.
class LightChoice::At {
  public:
    At(const LightChoice& choice, const LightSampler& lights, const SurfacePoint& at);
    /// Whether none of the lights reaches the point.
    bool is_empty() const { return !(all_lx_ > 0); }
    /// The number of a light, with its probability and the remainder of `u`. Precondition: not empty.
    math::DiscreteChoice choose(double u) const;
    /// The density of a direction, towards one of the lights, whose density is `pdf_per_sr` if this is
    /// chosen.
    double times_probability(double pdf_per_sr, std::uint32_t light) const;

  private:
    /// The view of light_tree.h.
    struct View {
        const LightSampler& lights;
        const SurfacePoint& at;
        double nearness(const LightTree::Node& node) const {
            return LightTree::nearness_of(node, at.position);
        }
        double estimate_lx(const LightTree::Node& node) const;
    };
    double rough_lx(std::uint32_t light) const;

    const LightChoice& choice_;
    const LightSampler& lights_;
    const SurfacePoint& at_;
    std::array<double, kFew> sums_lx_;  ///< running, of few lights; else unset
    LightTree::Cut cut_;                ///< of many lights
    double outside_lx_ = 0, all_lx_ = 0;
};

/// Calls `visit(choice, expected)` for so many choices, spread evenly from `first` in [0, 1) on: each light
/// as often as is its expected number, but for one. `at`: not empty.
template <typename ChoiceAt, typename Visit>
void choose_evenly(const ChoiceAt& at, std::uint32_t choices, double first, const Visit& visit) {
    for (std::uint32_t i = 0; i < choices; ++i) {
        const math::DiscreteChoice choice = at.choose((i + first) / choices);
        visit(choice, choices * choice.probability);
    }
}

}  // namespace stilb::transport
