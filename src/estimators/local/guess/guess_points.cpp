#include "estimators/local/guess/guess_points.h"

#include <algorithm>
#include <cmath>

#include "math/sampling.h"
#include "transport/weak_lights.h"

namespace stilb::estimators {
namespace {

/// Connections to points of the guess share light with gathering rays by k = kKernels x points / area: about
/// the density at which points lie as far from each other as from the receiver.
constexpr double kKernels = 5;
/// The k of connections to vertices of the residual, over that of connections to points of the guess on as
/// large an area: the residual is little light, and the rest of its connections is found by long paths.
constexpr double kResidualSplit = 200;
/// Points, over those in proportion to the light that they bring.
constexpr double kMorePoints = 1.5;

}  // namespace

GuessPoints::GuessPoints(const LightGuess& guess, const rays::RayCaster& caster, double residual_area_m2)
    : guess_(guess),
      caster_(caster),
      area_m2_(guess.lit_area_m2() > 0 ? guess.lit_area_m2() : residual_area_m2),
      split_(residual_area_m2 > 0 ? kResidualSplit * (area_m2_ / residual_area_m2) : kResidualSplit),
      all_(guess.patches().center) {
    std::vector<double> luminances_cd_m2;
    for (const std::uint32_t side : guess.lit_sides()) {
        luminances_cd_m2.push_back(guess.mean(side).whole.luminance());
        weights_.push_back(luminances_cd_m2.back() *
                           double{guess.patches().areas_m2[guess.patches().patch_of(side)]});
    }
    const std::vector<double> favours = transport::emission_favours(weights_, luminances_cd_m2);
    // None counts as brighter than the brightest one: a small dark side beside a receiver, with the favour
    // that it deserves beside a large ground, would leave no points for the walls around.
    const double most_cd_m2 = luminances_cd_m2.empty() ? 0 : std::ranges::max(luminances_cd_m2);
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        if (weights_[i] > 0) weights_[i] *= std::min(favours[i], most_cd_m2 / luminances_cd_m2[i]);
    }
    for (std::size_t i = 0; i < guess.lit_sides().size(); ++i) add(i, all_);
}

void GuessPoints::add(std::size_t i, KernelChoice& sides) const {
    const patches::Patches& patches = guess_.patches();
    const std::uint32_t side = guess_.lit_sides()[i];
    const std::uint32_t patch = patches.patch_of(side);
    const Vec3 middle = patches.middle(patch);
    double radius_m = 0;
    for (const std::uint32_t corner : patches.corners[patch])
        radius_m = std::max(radius_m, length(patches.center + Vec3(patches.vertices[corner]) - middle));
    sides.add(middle, patches.normal_of(side), weights_[i], radius_m);
}

double GuessPoints::k_per_m2(std::size_t count) const {
    return area_m2_ > 0 ? kKernels * static_cast<double>(count) / area_m2_ : 1;
}

auto GuessPoints::uncertain_sides(std::span<const transport::Receiver> receivers, const Sights& sights,
                                  double certain_lx, std::size_t most) const -> Choice {
    Choice choice;
    const patches::Patches& patches = guess_.patches();
    KernelChoice sides(patches.center);
    double area_m2 = 0;
    for (std::size_t i = 0; i < guess_.lit_sides().size(); ++i) {
        const std::uint32_t side = guess_.lit_sides()[i];
        if (sights[side] != Sight::uncertain) continue;
        choice.sides.push_back(side);
        add(i, sides);
        area_m2 += double{patches.areas_m2[patches.patch_of(side)]};
    }
    if (choice.sides.empty()) return choice;
    const double uncertain_lx = sides.mean_light(receivers, k_per_m2(most));
    // Without any points other receivers of the group would lack what connections share with rays.
    const double share = uncertain_lx > 0 ? uncertain_lx / (uncertain_lx + certain_lx) : 0;
    choice.count = static_cast<std::size_t>(std::clamp(
        std::ceil(kMorePoints * share * static_cast<double>(most)), 1.0, static_cast<double>(most)));
    const double k = kKernels * static_cast<double>(choice.count) / area_m2;
    choice.sums = sides.sums_for(receivers, k);
    choice.split = static_cast<float>(residual_k_per_m2(most) / k);
    return choice;
}

void GuessPoints::select(const Choice& choice, const std::array<double, 2>& u,
                         std::vector<EmittingPoint>& points) const {
    const std::size_t before = points.size();
    const patches::Patches& patches = guess_.patches();
    const std::vector<std::uint32_t>& sides = choice.sides.empty() ? guess_.lit_sides() : choice.sides;
    KernelChoice::select(choice.sums, choice.count, u[0], [&](std::size_t i, double times, double rest) {
        const double across = u[1] + 0.6180339887498949 * static_cast<double>(points.size() - before);
        const std::uint32_t side = sides[i];
        const math::Barycentric at_side = math::sample_triangle(rest, across - std::floor(across));
        if (!guess_.shared_places().owns(side, at_side)) return;
        const SurfacePoint point = side_point(patches, caster_, side, at_side);
        const transport::LightSum guessed = guess_.at(side, at_side);
        const Rgb light = guessed.whole * (double{patches.areas_m2[patches.patch_of(side)]} * times);
        points.push_back({.origin = SegmentOrigin(point, caster_.center()),
                          .split = choice.split,
                          .coefficient = {static_cast<float>(light[0]), static_cast<float>(light[1]),
                                          static_cast<float>(light[2])},
                          .shares = guessed.relative_shares()});
    });
}

}  // namespace stilb::estimators
