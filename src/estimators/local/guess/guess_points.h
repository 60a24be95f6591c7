// Points of the guess's surfaces, chosen for a group of receivers: connections to them bring most of the
// guessed light (theory T.8b). A side is chosen by its luminance, its area and the kernel at its middle.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "estimators/local/connection.h"
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

    /// The weights of the sides for receivers near the given ones. Without any, light alone decides.
    /// `k_per_m2`: the k of connections to points.
    KernelChoice::Sums sums_for(std::span<const transport::Receiver> receivers, double k_per_m2) const {
        return sides_.sums_for(receivers, k_per_m2);
    }

    /// `count` points that lie evenly over the weights; the expectation over `u` of their light is that of
    /// all surfaces.
    void select(const KernelChoice::Sums& sums, std::size_t count, const std::array<double, 2>& u,
                std::vector<EmittingPoint>& points) const;

  private:
    const LightGuess& guess_;
    const rays::RayCaster& caster_;
    KernelChoice sides_;  ///< the guess's lit sides
};

}  // namespace stilb::estimators
