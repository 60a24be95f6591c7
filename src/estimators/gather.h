// The part of an illuminance that rays from the measuring point bring in.
#pragma once

#include "estimators/path_tracer.h"
#include "sensors/sensor.h"

namespace stilb {

/// One unbiased sample [lx] of
///
///     integral over the hemisphere of L_r(y, y->x) (1 - w) cos(theta_x) dw,   1 - w = G / (k + G) (theory
///     T.1b)
///
/// by one cosine-distributed ray from x to y; k = 0 gives all of the reflected light (path tracing), k =
/// infinity none of it. What is seen by mirrors has w = 0 always, because no node on a mirror can be joined
/// to x. Emission counts behind mirrors only: the rest is direct light.
Spectrum sample_gathered_lx(const MeasuringPoint& point, double k_per_m2, int max_reflections,
                            const RayCaster& caster, const PathTracer& tracer, SampleStream& stream);

}  // namespace stilb
