#include "estimators/local/kernel_choice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/rays.h"

namespace stilb::estimators {
namespace {

/// The share of choices by light alone.
constexpr double kDefensive = 0.1;

struct FloatPoint {
    FloatPoint(const Vec3& position, const Vec3& normal)
        : x(static_cast<float>(position.x)),
          y(static_cast<float>(position.y)),
          z(static_cast<float>(position.z)),
          normal_x(static_cast<float>(normal.x)),
          normal_y(static_cast<float>(normal.y)),
          normal_z(static_cast<float>(normal.z)) {}

    float x, y, z, normal_x, normal_y, normal_z;
};

using Sixteen = std::array<float, kPacketWidth>;

/// Sets `weights` to light x w G, and adds them to `sums`, each to that of its number mod 16. (In one sum the
/// loop would stay scalar.)
STILB_VECTORIZED void weigh(const FloatPoint& at, float k, std::size_t count, const float* __restrict x,
                            const float* __restrict y, const float* __restrict z, const float* __restrict nx,
                            const float* __restrict ny, const float* __restrict nz,
                            const float* __restrict radius, const float* __restrict per_four_radii,
                            const float* __restrict light, float* __restrict weights,
                            Sixteen& __restrict sums) {
    for (std::size_t first = 0; first < count; first += kPacketWidth) {
        for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
            const std::size_t i = first + lane;
            const float dx = x[i] - at.x, dy = y[i] - at.y, dz = z[i] - at.z;
            const float squared = dx * dx + dy * dy + dz * dz;
            const float here = at.normal_x * dx + at.normal_y * dy + at.normal_z * dz;
            const float there = -(nx[i] * dx + ny[i] * dy + nz[i] * dz);
            // The mean of max(0, h) over heights h that are uniform within the radius of the middle's.
            const float near = std::min(std::max(here, -radius[i]), radius[i]) + radius[i];
            const float above = near * near * per_four_radii[i] + std::max(here - radius[i], 0.0f);
            const float product = above * (there > 0 ? there : 0);
            // k G / (k + G) with G = product / squared^2
            weights[i] = light[i] * (k * product / (k * squared * squared + product + 1e-30f));
            sums[lane] += weights[i];
        }
    }
}

/// Multiplies `light` by what lobes reflect towards a position.
STILB_VECTORIZED void reflect(const FloatPoint& at, std::size_t count, const float* __restrict x,
                              const float* __restrict y, const float* __restrict z,
                              const float* __restrict lobe_x, const float* __restrict lobe_y,
                              const float* __restrict lobe_z, const float* __restrict base,
                              const float* __restrict peak, const float* __restrict sharpness,
                              float* __restrict light) {
    for (std::size_t i = 0; i < count; ++i) {
        const float dx = at.x - x[i], dy = at.y - y[i], dz = at.z - z[i];
        const float along = lobe_x[i] * dx + lobe_y[i] * dy + lobe_z[i] * dz;
        const float cosine = along / std::sqrt(dx * dx + dy * dy + dz * dz + 1e-30f);
        const float beside = 1 + sharpness[i] * (1 - cosine), squared = beside * beside;
        light[i] *= base[i] + peak[i] / (squared * squared);
    }
}

STILB_VECTORIZED void add_multiple(const float* __restrict values, float factor, std::size_t count,
                                   float* __restrict sums) {
    for (std::size_t i = 0; i < count; ++i) sums[i] += values[i] * factor;
}

}  // namespace

void KernelChoice::add(const Vec3& position, const Vec3& normal, double light, double radius_m) {
    if (count_ % kPacketWidth == 0) {
        for (Floats* values : {&position_[0], &position_[1], &position_[2], &normal_[0], &normal_[1],
                               &normal_[2], &radius_, &per_four_radii_, &light_})
            values->resize(count_ + kPacketWidth);
    }
    const Vec3 relative = position - center_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        position_[axis][count_] = static_cast<float>(relative[axis]);
        normal_[axis][count_] = static_cast<float>(normal[axis]);
    }
    radius_[count_] = static_cast<float>(radius_m);
    per_four_radii_[count_] = radius_m > 0 ? static_cast<float>(1 / (4 * radius_m)) : 0;
    light_[count_++] = static_cast<float>(light);
    all_light_ += light;
}

void KernelChoice::add(const Vec3& position, const Vec3& normal, double light, const Lobe& lobe) {
    if (lobes_.base.empty()) first_lobe_ = count_ / kPacketWidth * kPacketWidth;
    add(position, normal, light);
    for (Floats* values :
         {&lobes_.direction[0], &lobes_.direction[1], &lobes_.direction[2], &lobes_.peak, &lobes_.sharpness})
        values->resize(light_.size() - first_lobe_);
    lobes_.base.resize(light_.size() - first_lobe_, 1);
    const std::size_t i = count_ - 1 - first_lobe_;
    for (std::size_t axis = 0; axis < 3; ++axis)
        lobes_.direction[axis][i] = static_cast<float>(lobe.direction[axis]);
    lobes_.base[i] = static_cast<float>(lobe.base);
    lobes_.peak[i] = static_cast<float>(lobe.peak);
    lobes_.sharpness[i] = static_cast<float>(lobe.sharpness);
}

auto KernelChoice::reflected_towards(const Vec3& position) const -> Floats {
    Floats light = light_;
    const auto from = [&](const Floats& values) { return values.data() + first_lobe_; };
    reflect(FloatPoint(position, {}), lobes_.base.size(), from(position_[0]), from(position_[1]),
            from(position_[2]), lobes_.direction[0].data(), lobes_.direction[1].data(),
            lobes_.direction[2].data(), lobes_.base.data(), lobes_.peak.data(), lobes_.sharpness.data(),
            light.data() + first_lobe_);
    return light;
}

float KernelChoice::weigh_for(const transport::Receiver& receiver, double k_per_m2, Floats& weights) const {
    const Vec3 position = receiver.position() - center_;
    Floats by_lobes;
    if (!lobes_.base.empty()) by_lobes = reflected_towards(position);
    const Floats& light = lobes_.base.empty() ? light_ : by_lobes;
    Sixteen parts{};
    weigh(FloatPoint(position, receiver.normal()), static_cast<float>(k_per_m2), weights.size(),
          position_[0].data(), position_[1].data(), position_[2].data(), normal_[0].data(), normal_[1].data(),
          normal_[2].data(), radius_.data(), per_four_radii_.data(), light.data(), weights.data(), parts);
    return std::accumulate(parts.begin(), parts.end(), 0.0f);
}

double KernelChoice::mean_light(std::span<const transport::Receiver> receivers, double k_per_m2) const {
    Floats own(light_.size());
    double sum = 0;
    for (const transport::Receiver& receiver : receivers) sum += double{weigh_for(receiver, k_per_m2, own)};
    return receivers.empty() ? 0 : sum / static_cast<double>(receivers.size());
}

auto KernelChoice::sums_for(std::span<const transport::Receiver> receivers, double k_per_m2) const -> Sums {
    Floats all(light_.size()), own(light_.size());
    std::size_t reached = 0;
    if (std::isinf(k_per_m2)) receivers = {};
    for (const transport::Receiver& receiver : receivers) {
        const float sum = weigh_for(receiver, k_per_m2, own);
        if (!(sum > 0)) continue;
        add_multiple(own.data(), 1 / sum, own.size(), all.data());
        ++reached;
    }
    const double share = reached > 0 ? kDefensive : 1;
    const auto by_light = static_cast<float>(all_light_ > 0 ? share / all_light_ : 0);
    const auto by_kernel =
        static_cast<float>((1 - share) / static_cast<double>(std::max<std::size_t>(1, reached)));
    Sums sums(count_);
    double sum = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        sum += double{all[i] * by_kernel + light_[i] * by_light};
        sums[i] = static_cast<float>(sum);
    }
    return sums;
}

}  // namespace stilb::estimators
