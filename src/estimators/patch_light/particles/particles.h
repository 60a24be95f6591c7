// Direct simulation: particles of light leave the lights, travel from patch to patch until they are absorbed,
// and are counted wherever they land (theory 9, [LocalEstimation 1], [Arvo 1986]). A side's illuminance is
// the flux counted on it over its area: every particle counts before it may be absorbed, and again after each
// reflection, so direct light is included.
//
// Unbiased means over patches. The variance is finite; a patch's relative variance is one over the number of
// particles that reached it, for all kinds of lights.
#pragma once

#include <cstdint>
#include <vector>

#include "estimators/patch_light/patch_transport.h"
#include "math/random.h"

namespace stilb::estimators {

/// Keeps a reference to the transport, of diffuse and black materials. One thread at a time.
class IlluminationMap {
  public:
    explicit IlluminationMap(const PatchTransport& transport);

    /// Adds particles number `first` ... `first + count - 1` of the streams of `key`.
    void add(math::RandomKey key, std::uint64_t first, std::uint64_t count);

    /// The luminance that every side reflects [cd/m2], by all particles so far.
    std::vector<FloatRgb> reflected_cd_m2() const;
    std::uint64_t rays() const { return rays_; }

  private:
    struct Particle {
        math::SampleStream stream;
        Vec3 origin, direction;
        Rgb flux_lm;
    };

    Particle leave_light(math::SampleStream stream) const;
    void walk(std::vector<Particle>& particles);
    bool land(Particle& particle, std::uint32_t side, const math::Barycentric& barycentric);

    const PatchTransport& transport_;
    std::vector<FloatRgb> flux_lm_;  ///< of every side, by all particles
    std::uint64_t particles_ = 0;
    std::uint64_t rays_ = 0;
};

}  // namespace stilb::estimators
