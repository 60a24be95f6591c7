// The light of uniform emitters on a surface in closed form: the projected solid angle of an emitter's front,
// which is the integral of the cosine over the directions to it above the horizon. Times the luminance it is
// the illuminance without shadows. Points are sampled by it, too, so that every sample that is seen carries
// the same light.
//
// A polygon's is Lambert's formula after clipping at the horizon [Lambert 1760]; it is sampled in sectors
// about the normal after [Peters 2021, BRDF importance sampling for polygonal lights], a rectangle wholly
// above the horizon along its edges. A sphere's cone is an ellipse in the projection, cut off by the
// horizon. A disk's is the contour integral along its rim, and it is sampled through its square.
#pragma once

#include <optional>
#include <span>

#include "base/surface_point.h"
#include "lights/emitter_elements.h"
#include "math/random.h"

namespace stilb::lights {

/// Whether an element has a closed form: all but surfaces by harmonics.
bool has_closed_form(const EmitterElement& element);

/// The projected solid angle of an element's front above the horizon [sr]; pi if it filled the sky. 0 in the
/// element's plane and behind it, and inside of spheres. Precondition: has_closed_form().
double projected_solid_angle_sr(const EmitterElement& element, const SurfacePoint& at);

/// A point of the element whose direction is uniform by projected solid angle; nothing where that is 0, or
/// too small for a direction in double precision. Precondition: has_closed_form().
struct ProjectedSample {
    SurfacePoint point;
    double projected_solid_angle_sr = 0;  ///< of the whole element
};
std::optional<ProjectedSample> sample_projected(const EmitterElement& element, const SurfacePoint& at,
                                                math::SampleStream& stream);

}  // namespace stilb::lights
