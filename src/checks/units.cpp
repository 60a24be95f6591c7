// Meshes that are probably not in metres.
#include <fmt/format.h>

#include <algorithm>

#include "checks/checks.h"

namespace stilb::checks {
namespace {

/// No room is so high, nor so narrow. Grounds may extend farther, but are flat.
constexpr double kHugeRoom_m = 200;
/// From this length on, millimetres are more likely than centimetres: rooms are about 3 to 20 m long.
constexpr double kMillimetres_m = 2000;
/// The largest vector area of a room, as a share of its area. That of a closed surface is 0; a room without a
/// ceiling has 0.3. A terrain, which may be high, has nearly 1.
constexpr double kMostOpen = 0.35;

}  // namespace

std::vector<std::string> unit_warnings(const Scene& scene) {
    Bounds bounds;
    Vec3 vector_area;
    double area = 0;
    std::string name;
    for (const Object& object : scene.objects) {
        const Mesh* mesh = geometry::stored_mesh(object.shape);
        if (mesh == nullptr) continue;
        if (name.empty()) name = object.name;
        for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
            const auto [p, q, r] = geometry::corners_of(object.shape, t);
            bounds.include(p), bounds.include(q), bounds.include(r);
            const Vec3 doubled = cross(q - p, r - p);
            vector_area += doubled;
            area += length(doubled);
        }
    }
    if (bounds.is_empty() || length(vector_area) > kMostOpen * area) return {};
    const Vec3 extent = bounds.max - bounds.min;
    if (std::min({extent.x, extent.y, extent.z}) < kHugeRoom_m) return {};
    const double longest_m = std::max({extent.x, extent.y, extent.z});
    const bool is_in_millimetres = longest_m >= kMillimetres_m;
    return {
        fmt::format("object \"{}\": the meshes of the scene are {:.4g} m long and {:.4g} m high. If the file "
                    "is in {}, set "
                    "scale = {} for the object.",
                    name, longest_m, extent.z, is_in_millimetres ? "millimetres" : "centimetres",
                    is_in_millimetres ? "0.001" : "0.01")};
}

}  // namespace stilb::checks
