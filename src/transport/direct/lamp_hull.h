// Whether a lamp is seen as a whole, or not at all: then its light needs no shadow rays.
#pragma once

#include <span>
#include <vector>

#include "lights/emitter_elements.h"
#include "rays/ray_caster.h"
#include "rays/shaft_query.h"
#include "scene/scene.h"

namespace stilb::transport {

/// The convex hull of all points of a lamp where shadow rays end.
class LampHull {
  public:
    LampHull(ObjectId object, std::span<const lights::EmitterElement> elements, const Lift& lift);

    /// Whether it is certain that all of the front is seen, through air, from all of the (lifted) points.
    bool is_seen_from(std::span<const Vec3> points, const rays::ShaftQuery& shafts) const {
        return is_convex_ && shafts.is_empty(points, corners_, object_);
    }
    /// Whether it is certain that one face of a box, a rectangle or a disk hides all of the front from the
    /// (lifted) point: such a face is convex, so that it hides what lies between points that it hides.
    bool is_hidden_from(const Vec3& point, const Scene& scene, const rays::RayCaster& caster) const;

  private:
    void add(const lights::EmitterElement& element, const Lift& lift);

    ObjectId object_;
    bool is_convex_;  ///< no part hides another one
    std::vector<Vec3> corners_;
};

}  // namespace stilb::transport
