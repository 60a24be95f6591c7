// Finds all surfaces that a ray crosses. Where several of them share a place, a closest hit names only one.
#pragma once

#include <embree3/rtcore.h>

#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rays/embree_geometry.h"

namespace stilb::rays {

struct CrossedPrimitive {
    std::uint32_t object = 0, primitive = 0;

    auto operator<=>(const CrossedPrimitive&) const = default;
};

/// The primitives that the ray crosses, up to some ten thousand; triangles once each, curved surfaces as
/// often as the ray meets them.
std::vector<CrossedPrimitive> crossed_primitives(RTCScene scene,
                                                 std::span<const std::unique_ptr<EmbreeGeometry>> geometries,
                                                 RTCRay ray);

}  // namespace stilb::rays
