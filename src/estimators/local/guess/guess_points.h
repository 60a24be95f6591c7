// Points of the guess's surfaces, chosen for a group of receivers: connections to them bring most of the
// guessed light (theory T.8). A side is chosen by its luminance, its area and the kernel at its middle; where
// others are much brighter, it has a favour.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "estimators/local/connection.h"
#include "estimators/local/guess/certain_sides.h"
#include "estimators/local/guess/light_guess.h"
#include "estimators/local/kernel_choice.h"
#include "rays/ray_caster.h"

namespace stilb::estimators {

/// The k of connections to vertices of the residual, over that of connections to points of the guess: the
/// residual is little light, and the rest of its connections is found by long paths.
inline constexpr float kResidualSplit = 200;

/// Keeps references to its arguments. Immutable.
class GuessPoints {
  public:
    GuessPoints(const LightGuess& guess, const rays::RayCaster& caster);

    /// The weights of sides for the receivers of a group.
    struct Choice {
        KernelChoice::Sums sums;
        std::vector<std::uint32_t> sides;  ///< that these belong to; empty: all lit ones
        float split = kResidualSplit;      ///< the k of the residual over that of connections to the points
        std::size_t count = 0;             ///< of points that the group takes at once
    };
    /// All lit sides, for receivers near the given ones. Without any, light alone decides.
    Choice all_sides(std::span<const transport::Receiver> receivers, std::size_t count) const {
        return {all_.sums_for(receivers, k_per_m2(count)), {}, kResidualSplit, count};
    }
    /// The sides whose sight is uncertain, and as many of the points as is their share of the light.
    /// `certain_lx`: what the receivers get from the others.
    Choice uncertain_sides(std::span<const transport::Receiver> receivers, const Sights& sights,
                           double certain_lx, std::size_t most) const;
    /// The k of connections to so many points of all lit sides at once.
    double k_per_m2(std::size_t count) const;

    /// Adds points that lie evenly over the weights, but for those of places that other sides own; the
    /// expectation over `u` of their light is that of all the sides.
    void select(const Choice& choice, const std::array<double, 2>& u,
                std::vector<EmittingPoint>& points) const;

  private:
    /// `i`: the number among the lit sides.
    void add(std::size_t i, KernelChoice& sides) const;

    const LightGuess& guess_;
    const rays::RayCaster& caster_;
    /// By lit sides: luminance times area; more in a room with weak lamps, as brighter walls of other rooms
    /// may be hidden.
    std::vector<double> weights_;
    KernelChoice all_;  ///< the guess's lit sides
};

}  // namespace stilb::estimators
