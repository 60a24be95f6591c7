// Sharp light: small lamps reflected by smooth surfaces, or seen through glass. A random path finds such
// light with a probability of about s / pi, where s is the solid angle of the highlight as the lit point sees
// it. A run with fewer samples than some times the reciprocal may find none at all, and nothing in its
// replicates shows that light is missing.
#pragma once

#include <cstdint>

#include "rays/ray_caster.h"
#include "scene/scene.h"

namespace stilb::transport {

struct SharpLight {
    std::uint64_t samples = 0;  ///< that find it about forty times; 0 where there is no sharp light
    ObjectId object{};          ///< that reflects or refracts it
};

/// The sharpest light that makes up half a per cent of the emitted flux, by some thousand particles from the
/// lights. Light of points by mirrors and glass alone is left out: no number of samples finds it at a point,
/// and the methods warn of it. Deterministic.
SharpLight find_sharp_light(const Scene& scene, const rays::RayCaster& caster);

}  // namespace stilb::transport
