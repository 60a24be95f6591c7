// Choice of points on surfaces for connections to a group of receivers. For each of some receivers of the
// group there is a density that is proportional to the light a point reflects and to the kernel w G of the
// bounded connection, shadows ignored; a glossy point reflects more towards some receivers. Points are chosen
// by the mean of these densities, so that no receiver's points are rare, and some by light alone, for the
// other receivers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "math/sampling.h"
#include "transport/receiver.h"

namespace stilb::estimators {

/// In single precision, relative to a centre.
class KernelChoice {
  public:
    explicit KernelChoice(const Vec3& center) : center_(center) {}

    /// `light`: at least 0, in any unit. `radius_m`: of the surface that the point stands for. Part of it may
    /// be above a receiver's horizon where its middle is below.
    void add(const Vec3& position, const Vec3& normal, double light, double radius_m = 0);
    /// A reflection that is not equal in all directions: relative to that, `base` plus a lobe about a unit
    /// direction, `peak` in its middle and less by (1 + sharpness (1 - cosine))^-4 beside it.
    struct Lobe {
        Vec3 direction;
        double base = 1, peak = 0, sharpness = 0;
    };
    /// A point with a lobe. Quickest where these are added after all others.
    void add(const Vec3& position, const Vec3& normal, double light, const Lobe& lobe);
    std::size_t size() const { return count_; }

    /// The running sums of the points' weights, for select().
    using Sums = std::vector<float>;
    /// The weights for receivers near the given ones. Without any, light alone decides. `k_per_m2`: the k of
    /// the connections; where it is infinite, their kernel has no bound, and light alone decides, too.
    Sums sums_for(std::span<const transport::Receiver> receivers, double k_per_m2) const;
    /// The sum of light x w G, averaged over the receivers.
    double mean_light(std::span<const transport::Receiver> receivers, double k_per_m2) const;

    /// Calls `visit(index, times, rest)` for `count` choices that lie evenly over the weights. `times` is 1 /
    /// (probability x count): for every function of a point the expectation over `u` (uniform in [0, 1)) of
    /// the sum of function x times is the sum over all points. `rest`: in [0, 1), evenly distributed in the
    /// choices of a point.
    template <typename Visit>
    static void select(const Sums& sums, std::size_t count, double u, const Visit& visit);

  private:
    using Floats = std::vector<float>;

    /// The light that the points reflect towards a position relative to the centre. Precondition: there are
    /// lobes; without, it is the same for all positions.
    Floats reflected_towards(const Vec3& position) const;
    /// Sets light x w G of all points for a receiver. Returns the sum.
    float weigh_for(const transport::Receiver& receiver, double k_per_m2, Floats& weights) const;

    Vec3 center_;
    std::size_t count_ = 0;
    std::array<Floats, 3> position_, normal_;  ///< as all arrays, filled with 0 to a multiple of 16
    Floats radius_, per_four_radii_, light_;   ///< per_four_radii: 1 / (4 radius), 0 for points
    /// The lobes of points from number `first_lobe_` on, a multiple of 16.
    struct Lobes {
        std::array<Floats, 3> direction;
        Floats base, peak, sharpness;
    };
    Lobes lobes_;
    std::size_t first_lobe_ = 0;
    double all_light_ = 0;
};

template <typename Visit>
void KernelChoice::select(const Sums& sums, std::size_t count, double u, const Visit& visit) {
    if (sums.empty() || !(sums.back() > 0)) return;
    const double sum = double{sums.back()}, all = static_cast<double>(count);
    for (std::size_t j = 0; j < count; ++j) {
        const auto target = static_cast<float>((static_cast<double>(j) + u) / all * sum);
        const auto found = std::upper_bound(sums.begin(), sums.end() - 1, target);
        const auto i = static_cast<std::size_t>(found - sums.begin());
        const float before = i > 0 ? sums[i - 1] : 0, own = *found - before;
        if (own > 0)
            visit(i, sum / (double{own} * all),
                  std::clamp(double{(target - before) / own}, 0., math::kBelowOne));
    }
}

}  // namespace stilb::estimators
