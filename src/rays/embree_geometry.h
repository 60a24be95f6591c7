// Shapes as Embree's geometries.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <memory>

#include "geometry/shape.h"
#include "rays/curved_surface.h"

namespace stilb::rays {

/// What rays that met a geometry need to know of it: a mesh in single precision, or a curved surface.
struct EmbreeGeometry {
    const std::array<float, 3>* vertices = nullptr;  ///< owned by Embree, as are the triangles; or null
    const Triangle* triangles = nullptr;
    const Mesh* smooth = nullptr;  ///< owned by the scene, where it has vertex normals; or null
    std::unique_ptr<CurvedSurface> curved;
};

/// The shape relative to `origin`, not committed yet. `kept` is filled and must outlive the geometry and stay
/// where it is. A curved surface's parts are the geometry's primitives.
RTCGeometry new_geometry(RTCDevice device, const Shape& shape, const Vec3& origin, EmbreeGeometry& kept);

}  // namespace stilb::rays
