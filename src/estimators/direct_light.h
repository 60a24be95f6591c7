// Light that reaches measuring points straight from the sources, integrated on its own [LocalEstimation 3].
#pragma once

#include <span>
#include <vector>

#include "estimators/light_sampler.h"
#include "estimators/packed_points.h"

namespace stilb {

/// Illuminance [lx] of every reading from all point and photometry lights: exact, one shadow ray each.
std::vector<Spectrum> direct_from_points_lx(std::span<const PackedPoint> points, const RayCaster& caster,
                                            const LightSampler& lights);

/// One sample of the illuminance [lx] from all area lights, each by its solid angle.
Spectrum sample_direct_from_areas_lx(const PackedPoint& point, const RayCaster& caster,
                                     const LightSampler& lights, SampleStream& stream);

}  // namespace stilb
