// Samples of direct light at packets of surface points: one light at each, by all lanes at once where
// LaneLights has all lights, else by LightSampler, lane by lane.
#pragma once

#include <optional>

#include "math/random_lanes.h"
#include "transport/lane_lights.h"

namespace stilb::transport {

/// Immutable. Keeps references to caster and lights.
class PacketLights {
  public:
    PacketLights(const Scene& scene, const rays::RayCaster& caster, const LightSampler& lights);

    /// For the lanes that are set. Uses numbers of the streams up; of those that it returns, the third and
    /// the fourth one are left. `sobol_dimensions`: of the streams.
    math::NumberPacket sample(const rays::SurfacePacket& at, const LaneMask& lanes,
                              math::StreamPacket& streams, unsigned sobol_dimensions,
                              LightPacket& light) const;
    /// The density of the direction from a point to `hit`, on the emitter of a light.
    double pdf_per_sr(std::size_t light, const rays::Hit& hit, const SurfacePoint& at) const;

  private:
    void sample_one_by_one(const rays::SurfacePacket& at, const LaneMask& lanes,
                           const math::StreamPacket& streams, unsigned sobol_dimensions,
                           LightPacket& light) const;

    const rays::RayCaster& caster_;
    const LightSampler& lights_;
    std::optional<LaneLights> lane_lights_;
};

}  // namespace stilb::transport
