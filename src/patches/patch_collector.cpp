#include "patches/patch_collector.h"

#include "patches/vertex_interpolation.h"

namespace stilb::patches {
namespace {

Float3 in_floats(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

std::vector<std::uint32_t> PatchCollector::add(const RefinedMesh& fine,
                                               std::span<const MaterialId> materials) {
    triangles_.clear();
    normals_.clear();
    std::vector<std::uint32_t> kept;
    const std::size_t first = patches_.count();
    for (std::uint32_t i = 0; i < fine.parents.size(); ++i) {
        const std::size_t parent = materials.size() == 1 ? 0 : fine.parents[i];
        if (add_triangle(fine.mesh, fine.mesh.triangles[i], materials[parent])) kept.push_back(i);
    }
    const auto smooth = divide_at_creases(triangles_, normals_, std::span(patches_.materials).subspan(first));
    const auto before = static_cast<std::uint32_t>(patches_.vertices.size());
    for (const std::uint32_t vertex : smooth.original)
        patches_.vertices.push_back(in_floats(fine.mesh.vertices[vertex] - patches_.center));
    for (const Triangle& t : smooth.triangles)
        patches_.corners.push_back({t[0] + before, t[1] + before, t[2] + before});
    patches_.first_of_object.push_back(static_cast<std::uint32_t>(patches_.count()));
    return kept;
}

bool PatchCollector::add_triangle(const Mesh& mesh, const Triangle& t, MaterialId material) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 doubled = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    const double doubled_area = length(doubled);
    if (!(static_cast<float>(doubled_area) > 0)) return false;
    triangles_.push_back(t);
    normals_.push_back(doubled / doubled_area);
    patches_.normals.push_back(in_floats(normals_.back()));
    patches_.areas_m2.push_back(static_cast<float>(doubled_area / 2));
    patches_.materials.push_back(material);
    return true;
}

}  // namespace stilb::patches
