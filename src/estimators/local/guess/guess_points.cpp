#include "estimators/local/guess/guess_points.h"

#include <algorithm>
#include <cmath>

#include "math/sampling.h"

namespace stilb::estimators {
GuessPoints::GuessPoints(const LightGuess& guess, const rays::RayCaster& caster)
    : guess_(guess), caster_(caster), sides_(guess.patches().center) {
    const patches::Patches& patches = guess.patches();
    for (const std::uint32_t side : guess.lit_sides()) {
        const std::uint32_t patch = patches.patch_of(side);
        const Vec3 middle = patches.middle(patch);
        double radius_m = 0;
        for (const std::uint32_t corner : patches.corners[patch])
            radius_m = std::max(radius_m, length(patches.center + Vec3(patches.vertices[corner]) - middle));
        sides_.add(middle, patches.normal_of(side), guess.mean_cd_m2(side) * double{patches.areas_m2[patch]},
                   radius_m);
    }
}

void GuessPoints::select(const KernelChoice::Sums& sums, std::size_t count, const std::array<double, 2>& u,
                         std::vector<EmittingPoint>& points) const {
    points.clear();
    const patches::Patches& patches = guess_.patches();
    KernelChoice::select(sums, count, u[0], [&](std::size_t i, double times, double rest) {
        const double across = u[1] + 0.6180339887498949 * static_cast<double>(points.size());
        const std::uint32_t side = guess_.lit_sides()[i];
        const math::Barycentric at_side = math::sample_triangle(rest, across - std::floor(across));
        const SidePoint point = side_point(patches, caster_, side, at_side);
        const Rgb light = guess_.luminance_cd_m2(side, at_side) *
                          (double{patches.areas_m2[patches.patch_of(side)]} * times);
        points.push_back(
            {SegmentOrigin(point.position, point.lifted, point.normal, caster_.center()),
             kResidualSplit,
             {static_cast<float>(light[0]), static_cast<float>(light[1]), static_cast<float>(light[2])}});
    });
}

}  // namespace stilb::estimators
