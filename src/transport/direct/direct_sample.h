// A sample of the direct light at a point.
#pragma once

#include <optional>

#include "base/surface_point.h"
#include "lights/light_kind.h"
#include "rays/ray_caster.h"

namespace stilb::transport {

/// The light of a lamp at a point of a surface, if nothing lies in between.
struct DirectSample {
    rays::Segment segment;  ///< of its shadow ray
    Rgb illuminance_lx;     ///< its mean over the samples is that of the whole lamp
};

/// Nothing where a sample of a light brings none.
inline std::optional<DirectSample> direct_sample(const std::optional<lights::IncidentLight>& incident,
                                                 const SurfacePoint& at) {
    if (!incident) return std::nullopt;
    const double cosine = dot(incident->direction, at.normal);
    if (!(cosine > 0) || !(incident->normal_illuminance_lx.max() > 0)) return std::nullopt;
    return DirectSample{{at.lifted, incident->source_point}, cosine * incident->normal_illuminance_lx};
}

}  // namespace stilb::transport
