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

/// Keeps references to its arguments. Immutable.
class GuessPoints {
  public:
    /// `residual_area_m2`: of the surfaces from which the residual comes.
    GuessPoints(const LightGuess& guess, const rays::RayCaster& caster, double residual_area_m2);

    /// The weights of sides for the receivers of a group.
    struct Choice {
        KernelChoice::Sums sums;
        std::vector<std::uint32_t> sides;  ///< that these belong to; empty: all lit ones
        float split = 0;                   ///< the k of the residual over that of connections to the points
        std::size_t count = 0;             ///< of points that the group takes at once
    };
    /// All lit sides, for receivers near the given ones. Without any, light alone decides.
    Choice all_sides(std::span<const transport::Receiver> receivers, std::size_t count) const {
        return {all_.sums_for(receivers, k_per_m2(count)), {}, split(), count};
    }
    /// The sides whose sight is uncertain, and as many of the points as is their share of the light.
    /// `certain_lx`: what the receivers get from the others.
    Choice uncertain_sides(std::span<const transport::Receiver> receivers, const Sights& sights,
                           double certain_lx, std::size_t most) const;
    /// The k of connections to so many points of all lit sides at once.
    double k_per_m2(std::size_t count) const;
    /// The k of connections to the residual beside them, and that over the k of the points.
    double residual_k_per_m2(std::size_t count) const { return split_ * k_per_m2(count); }
    float split() const { return static_cast<float>(split_); }

    /// Adds points that lie evenly over the weights, but for those of places that other sides own; the
    /// expectation over `u` of their light is that of all the sides.
    void select(const Choice& choice, const std::array<double, 2>& u,
                std::vector<EmittingPoint>& points) const;

  private:
    /// `i`: the number among the lit sides.
    void add(std::size_t i, KernelChoice& sides) const;

    const LightGuess& guess_;
    const rays::RayCaster& caster_;
    double area_m2_;  ///< of the lit sides; without any, of the residual's
    double split_;
    /// By lit sides: luminance times area; more in a room with weak lamps, as brighter walls of other rooms
    /// may be hidden.
    std::vector<double> weights_;
    KernelChoice all_;  ///< the guess's lit sides
};

}  // namespace stilb::estimators
