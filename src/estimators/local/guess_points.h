// Points of the guess's surfaces, chosen for a group of receivers: connections to them bring most of the
// guessed light (theory T.8b). A side is chosen in proportion to its luminance, its area and the kernel w G
// of the bounded connection to the middle of the group, shadows ignored; some are chosen by luminance and
// area alone.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "estimators/local/connection.h"
#include "estimators/local/light_guess.h"
#include "rays/ray_caster.h"

namespace stilb::estimators {

/// The k of connections to vertices of the residual, over that of connections to points of the guess: the
/// residual is little light, and the rest of its connections is found by long paths.
inline constexpr float kResidualSplit = 200;

/// Keeps references to its arguments. Immutable.
class GuessPoints {
  public:
    GuessPoints(const LightGuess& guess, const rays::RayCaster& caster);

    /// The running sums of the sides' weights, for select().
    using Sums = std::vector<float>;
    /// For receivers around the given ones, of which there may be none; `k_per_m2`: of connections to points.
    Sums sums_for(std::span<const transport::Receiver> receivers, double k_per_m2) const;

    /// `count` points that lie evenly over the weights; the expectation over `u` of their light is that of
    /// all surfaces.
    void select(const Sums& sums, std::size_t count, const std::array<double, 2>& u,
                std::vector<EmittingPoint>& points) const;

  private:
    using Floats = std::vector<float>;

    const LightGuess& guess_;
    const rays::RayCaster& caster_;
    std::array<Floats, 3> middle_, normal_;  ///< of the lit sides, relative to the centre of the patches
    Floats power_;                           ///< luminance x area
    float all_power_ = 0;
};

}  // namespace stilb::estimators
