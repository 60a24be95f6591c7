// Direct light at one receiver, through panes too, integrated separately [LocalEstimation 3].
#pragma once

#include "transport/receiver.h"

namespace stilb::transport {

/// The light from all point lights at a receiver: exact, one shadow ray each. `parts`: may be null, here and
/// below.
Rgb direct_from_points(const Receiver& receiver, const rays::RayCaster& caster, const LightSampler& lights,
                       LightParts* parts = nullptr);

/// One sample of the light from all other lights at a receiver: each separately and, where the response
/// depends on direction, all by a ray in proportion to the response as well, weighted by the balance
/// heuristic.
Rgb sample_direct_from_areas(const Receiver& receiver, const rays::RayCaster& caster,
                             const LightSampler& lights, math::SampleStream& stream,
                             LightParts* parts = nullptr);

}  // namespace stilb::transport
