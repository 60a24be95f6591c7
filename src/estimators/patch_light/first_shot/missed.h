// How often item buffers were too coarse.
#pragma once

#include <cstddef>

#include "estimators/patch_light/first_shot/factors.h"
#include "rays/ray_caster.h"

namespace stilb::estimators {

/// Pairs of a side and a light sample that has no pixel on it, though light of it reaches the side's middle.
/// Only sides of a few pixels' size are looked at.
std::size_t count_missed(const Scene& scene, const rays::RayCaster& caster, const patches::Patches& patches,
                         std::span<const LightSample> samples, const FirstShotFactors& factors,
                         int resolution, const Monitor& monitor);

}  // namespace stilb::estimators
