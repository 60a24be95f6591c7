// Classical first shot: the reflected radiance is stored for each side, in bins of outgoing directions in
// which it counts as constant; in one where the material reflects alike in all directions.
#pragma once

#include <span>
#include <vector>

#include "estimators/patch_light/first_shot/incoming.h"
#include "math/random.h"

namespace stilb::estimators {

/// The hemisphere in bins of equal projected solid angle, so that all weigh the same in flux: rings of equal
/// steps in sin^2(theta), each in four times as many sectors as there are rings, from the frame's u on.
class HemisphereBins {
  public:
    /// Throws InputError where there is no ring, or more than 256.
    explicit HemisphereBins(int rings);

    std::uint32_t count() const { return rings_ * sectors_; }
    /// Of a unit direction above the horizon.
    std::uint32_t bin_of(const Vec3& local) const;
    /// Uniform in projected solid angle over the bin for u1, u2 in [0, 1).
    Vec3 direction(std::uint32_t bin, double u1, double u2) const;

  private:
    std::uint32_t rings_, sectors_;
};

/// Keeps a reference to the patches.
class ClassicalFirstShot {
  public:
    ClassicalFirstShot(const Scene& scene, const patches::Patches& patches, const IncomingFirstShot& incoming,
                       const HemisphereBins& bins);

    /// As FirstShot; the position does not matter.
    void add_reflected(std::uint32_t side, const Vec3& position, math::RandomKey key,
                       std::span<const Vec3> outs, std::span<Rgb> sums) const;
    bool is_constant(std::uint32_t side) const { return bins_of(side) <= 1; }
    std::size_t bytes() const {
        return first_.size() * sizeof first_[0] + radiance_cd_m2_.size() * sizeof radiance_cd_m2_[0];
    }

  private:
    /// None where a side gets no light or reflects none.
    std::size_t bins_of(std::uint32_t side) const { return first_[side + 1] - first_[side]; }
    void store(std::uint32_t side, const IncomingFirstShot& incoming);

    const patches::Patches& patches_;
    HemisphereBins bins_;
    std::vector<std::size_t> first_;  ///< per side, and the end
    std::vector<patches::Float3>
        radiance_cd_m2_;  ///< per bin and band: the mean over the bin's projected solid angle
};

}  // namespace stilb::estimators
