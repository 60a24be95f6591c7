#include "estimators/local/kernel_choice.h"

#include "base/rays.h"

namespace stilb::estimators {
namespace {

/// The share of choices by light alone.
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

void KernelChoice::add(const Vec3& position, const Vec3& normal, double light) {
    const Vec3 relative = position - center_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        position_[axis].push_back(static_cast<float>(relative[axis]));
        normal_[axis].push_back(static_cast<float>(normal[axis]));
    }
    light_.push_back(static_cast<float>(light));
    all_light_ += light;
}

auto KernelChoice::sums_for(std::span<const transport::Receiver> receivers, double k_per_m2) const -> Sums {
    Sums sums(light_.size());
    for (const transport::Receiver& receiver : receivers) {
        const Vec3 p = receiver.position() - center_, n = receiver.normal();
        const FloatPoint at{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                            static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
        add_kernels(at, static_cast<float>(k_per_m2), sums.size(), position_[0].data(), position_[1].data(),
                    position_[2].data(), normal_[0].data(), normal_[1].data(), normal_[2].data(),
                    sums.data());
    }
    double all = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) all += double{sums[i]} * double{light_[i]};
    const float evenly = all > 0 ? kDefensive * static_cast<float>(all / all_light_) : 1;
    double sum = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        sum += double{light_[i] * (sums[i] + evenly)};
        sums[i] = static_cast<float>(sum);
    }
    return sums;
}

}  // namespace stilb::estimators
