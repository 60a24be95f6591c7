// The lobes of composed materials (materials/material.h), at surfaces that paths meet.
#pragma once

#include <optional>
#include <span>

#include "materials/material.h"
#include "math/random.h"
#include "rays/ray_caster.h"

namespace stilb::transport {

/// The lobes by which a path that has met a surface goes on; none where the material is its own only lobe.
inline std::span<const materials::Lobe> lobes_at(const rays::Hit& hit, const Material& material,
                                                 materials::Carried carried) {
    return lobes(material, hit.on_front ? materials::LightSide::outside : materials::LightSide::inside,
                 carried);
}

/// Takes a path to the side of a surface from which a lobe continues it. `from`: towards its previous vertex.
inline void cross(const materials::Lobe& lobe, rays::Hit& hit, Vec3& from) {
    if (!lobe.crosses) return;
    from = hit.mirrored(from);
    hit = hit.behind();
}

/// How a path goes on at a surface.
struct LobeChoice {
    const Material* material = nullptr;     ///< that of the surface, or of the lobe
    const materials::Lobe* lobe = nullptr;  ///< null where the material is not composed
    /// Of what the path carries: the lobe's own factor over the probability with which it was chosen.
    double weight = 1;
    /// Share of the light that the surface sends on by all of its lobes: the path survives with it, since the
    /// lobe's own share is in its probability.
    Rgb sent_on{};
};
/// Takes a path to the side of the surface from which it goes on: by one of the material's lobes, in
/// proportion to the light that these send on, or by the material itself. Nothing where all light ends. Uses
/// a number of the stream where there are lobes.
std::optional<LobeChoice> choose_lobe(const Material& material, rays::Hit& hit, Vec3& from,
                                      materials::Carried carried, math::SampleStream& stream);

}  // namespace stilb::transport
