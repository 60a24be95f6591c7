// Closed bodies of glass in a scene, and faces of glass that close none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "materials/dielectric.h"
#include "scene/scene.h"

namespace stilb::scene {

using TriangleList = std::shared_ptr<const std::vector<std::uint32_t>>;  ///< shared by instances

/// Some triangles of an object.
struct Part {
    ObjectId object{};
    TriangleList triangles;
};

/// A closed body; one shape without a stored mesh (a box, a sphere ...) has no parts.
struct GlassBody {
    ObjectId object{};         ///< the first one
    std::vector<Part> parts;   ///< mostly one
    std::vector<Part> turned;  ///< whose fronts lie on the other side than those of most others
    materials::Medium medium;
    bool is_inside_out = false;  ///< the front of its surface, after `turned`, is the inside
    Bounds bounds;

    /// Points on its surface, spread over it.
    std::vector<Vec3> some_points(const Scene& scene) const;
    bool contains(const Vec3& point, const Scene& scene) const;
};

struct GlassBodies {
    std::vector<GlassBody> bodies;
    std::vector<Part> sheets;
    /// The names of objects, each once: of which only a part of a closed surface is glass, the larger or the
    /// smaller one; with bodies that are closed but for a few edges; with sheets.
    std::vector<std::string> mostly_glass, partly_glass, nearly_closed, open;
};

/// Inside of a triangle's glass; nothing of other materials. `triangle`: 0 for shapes without a mesh.
std::optional<materials::Medium> glass_medium(const Scene& scene, const Object& object,
                                              std::uint32_t triangle);

/// Lamps, and objects that lamps were cut out of, are left out.
GlassBodies find_glass_bodies(const Scene& scene);

}  // namespace stilb::scene
