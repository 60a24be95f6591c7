#include "estimators/local/guess_points.h"

#include <algorithm>
#include <cmath>

#include "base/rays.h"
#include "math/sampling.h"

namespace stilb::estimators {
namespace {

/// The share of points that are chosen by luminance and area alone: shadows and the extent of sides and of
/// groups are ignored in the kernel.
constexpr float kDefensive = 0.1f;

struct FloatPoint {
    float x, y, z, normal_x, normal_y, normal_z;
};

STILB_VECTORIZED void add_kernels(const FloatPoint& at, float k, std::size_t count, const float* __restrict x,
                                  const float* __restrict y, const float* __restrict z,
                                  const float* __restrict nx, const float* __restrict ny,
                                  const float* __restrict nz, float* __restrict sums) {
    for (std::size_t i = 0; i < count; ++i) {
        const float dx = x[i] - at.x, dy = y[i] - at.y, dz = z[i] - at.z;
        const float squared = dx * dx + dy * dy + dz * dz;
        const float here = at.normal_x * dx + at.normal_y * dy + at.normal_z * dz;
        const float there = -(nx[i] * dx + ny[i] * dy + nz[i] * dz);
        const float product = (here > 0 ? here : 0) * (there > 0 ? there : 0);
        // k G / (k + G) with G = product / squared^2
        sums[i] += k * product / (k * squared * squared + product + 1e-30f);
    }
}

}  // namespace

GuessPoints::GuessPoints(const LightGuess& guess, const rays::RayCaster& caster)
    : guess_(guess), caster_(caster) {
    const patches::Patches& patches = guess.patches();
    for (const std::uint32_t side : guess.lit_sides()) {
        const std::uint32_t patch = patches.patch_of(side);
        const Vec3 middle = patches.middle(patch) - patches.center, normal = patches.normal_of(side);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            middle_[axis].push_back(static_cast<float>(middle[axis]));
            normal_[axis].push_back(static_cast<float>(normal[axis]));
        }
        power_.push_back(static_cast<float>(guess.mean_cd_m2(side)) * patches.areas_m2[patch]);
        all_power_ += power_.back();
    }
}

auto GuessPoints::sums_for(std::span<const transport::Receiver> receivers, double k_per_m2) const -> Sums {
    Sums sums(power_.size());
    for (const transport::Receiver& receiver : receivers) {
        const Vec3 p = receiver.position() - guess_.patches().center, n = receiver.normal();
        const FloatPoint at{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                            static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
        add_kernels(at, static_cast<float>(k_per_m2), sums.size(), middle_[0].data(), middle_[1].data(),
                    middle_[2].data(), normal_[0].data(), normal_[1].data(), normal_[2].data(), sums.data());
    }
    double all = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) all += double{sums[i]} * double{power_[i]};
    const float evenly = all > 0 ? kDefensive * static_cast<float>(all) / all_power_ : 1;
    double sum = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        sum += double{power_[i] * (sums[i] + evenly)};
        sums[i] = static_cast<float>(sum);
    }
    return sums;
}

void GuessPoints::select(const Sums& sums, std::size_t count, const std::array<double, 2>& u,
                         std::vector<EmittingPoint>& points) const {
    points.clear();
    if (sums.empty() || !(sums.back() > 0)) return;
    const patches::Patches& patches = guess_.patches();
    for (std::size_t j = 0; j < count; ++j) {
        const double at = (static_cast<double>(j) + u[0]) / static_cast<double>(count);
        const auto target = static_cast<float>(at * double{sums.back()});
        const auto found = std::upper_bound(sums.begin(), sums.end() - 1, target);
        const auto i = static_cast<std::size_t>(found - sums.begin());
        const float before = i > 0 ? sums[i - 1] : 0, own = *found - before;
        if (!(own > 0)) continue;
        const double rest = std::clamp(double{(target - before) / own}, 0., math::kBelowOne);
        const double across = u[1] + 0.6180339887498949 * static_cast<double>(j);
        const std::uint32_t side = guess_.lit_sides()[i];
        const math::Barycentric at_side = math::sample_triangle(rest, across - std::floor(across));
        const SidePoint point = side_point(patches, caster_, side, at_side);
        const double weight = double{patches.areas_m2[patches.patch_of(side)]} * double{sums.back()} /
                              (double{own} * static_cast<double>(count));
        const Rgb light = guess_.luminance_cd_m2(side, at_side) * weight;
        points.push_back(
            {SegmentOrigin(point.position, point.lifted, point.normal, caster_.center()),
             kResidualSplit,
             {static_cast<float>(light[0]), static_cast<float>(light[1]), static_cast<float>(light[2])}});
    }
}

}  // namespace stilb::estimators
