// Light that reaches receivers straight from the sources, through panes too, integrated on its own
// [LocalEstimation 3].
#pragma once

#include <span>
#include <vector>

#include "transport/light_sampler.h"
#include "transport/receiver.h"

namespace stilb::transport {

/// What a receiver gets from all lights that are points: exact, one shadow ray each.
Rgb direct_from_points(const Receiver& receiver, const rays::RayCaster& caster, const LightSampler& lights);

/// One sample of what a receiver gets from all other lights: each by itself and, where the response
/// depends on direction, all by a ray in proportion to the response as well, weighted by the balance
/// heuristic.
Rgb sample_direct_from_areas(const Receiver& receiver, const rays::RayCaster& caster,
                             const LightSampler& lights, math::SampleStream& stream);

}  // namespace stilb::transport
