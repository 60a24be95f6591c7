// Random draws of the generator: the same on every machine, for a seed and a scene's number.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "base/vec.h"
#include "math/random.h"

namespace stilb::random {

class Draw {
  public:
    Draw(std::uint64_t seed, std::uint64_t scene) : key_{math::RandomKey{seed}.derived(scene)} {}

    double unit() { return math::unit_interval(math::random_block(key_, 0, next_++)[0]); }
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// Evenly by the logarithm.
    double by_size(double low, double high) { return low * std::pow(high / low, unit()); }
    std::size_t below(std::size_t count) {
        return std::min(static_cast<std::size_t>(unit() * static_cast<double>(count)), count - 1);
    }
    bool chance(double probability) { return unit() < probability; }
    template <typename T>
    T one_of(std::initializer_list<T> values) {
        return values.begin()[below(values.size())];
    }
    /// An index, each as likely as its weight.
    std::size_t weighted(std::initializer_list<double> weights) {
        double all = 0;
        for (const double weight : weights) all += weight;
        double left = all * unit();
        for (std::size_t i = 0; i < weights.size(); ++i) {
            if ((left -= weights.begin()[i]) < 0) return i;
        }
        return 0;
    }
    Vec3 inside(const Vec3& low, const Vec3& high) {
        return {between(low.x, high.x), between(low.y, high.y), between(low.z, high.z)};
    }
    /// A unit vector, even over the sphere.
    Vec3 direction() {
        const double z = between(-1, 1), phi = between(0, 2 * kPi), r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

  private:
    math::RandomKey key_;
    std::uint64_t next_ = 0;
};

}  // namespace stilb::random
