#include "walk/display/coarse_triangles.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <span>
#include <unordered_map>

#include "base/parallel.h"

namespace stilb::walk {
namespace {

/// Parts with fewer triangles stay as they are.
constexpr std::size_t kSmallPart = 500;
constexpr float kMostChange = 0.02F;

/// Triangles of a part with vertices of its own, so that the work depends on the part alone.
struct LocalMesh {
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> vertex_of;  ///< in the whole mesh
    std::vector<float> positions_m;        ///< x, y, z, from the first vertex
};

LocalMesh local_mesh(const DisplayMesh& mesh, std::span<const Triangle> triangles) {
    LocalMesh local;
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;
    const Vec3 origin = mesh.vertices[triangles[0][0]].position;
    for (const Triangle& triangle : triangles) {
        for (const std::uint32_t corner : triangle) {
            const auto next = static_cast<std::uint32_t>(numbers.size());
            const auto [found, is_new] = numbers.try_emplace(corner, next);
            local.corners.push_back(found->second);
            if (!is_new) continue;
            local.vertex_of.push_back(corner);
            const Vec3 position = mesh.vertices[corner].position - origin;
            for (const double x : {position.x, position.y, position.z})
                local.positions_m.push_back(static_cast<float>(x));
        }
    }
    return local;
}

std::vector<Triangle> coarse_part(const DisplayMesh& mesh, std::span<const Triangle> triangles,
                                  double share) {
    if (triangles.size() < kSmallPart) return {triangles.begin(), triangles.end()};
    const LocalMesh local = local_mesh(mesh, triangles);
    const auto wanted = static_cast<std::size_t>(share * static_cast<double>(triangles.size()));
    std::vector<std::uint32_t> corners(local.corners.size());
    corners.resize(meshopt_simplify(corners.data(), local.corners.data(), local.corners.size(),
                                    local.positions_m.data(), local.vertex_of.size(), 3 * sizeof(float),
                                    3 * wanted, kMostChange));
    std::vector<Triangle> coarse;
    for (std::size_t i = 0; i < corners.size(); i += 3)
        coarse.push_back(
            {local.vertex_of[corners[i]], local.vertex_of[corners[i + 1]], local.vertex_of[corners[i + 2]]});
    return coarse;
}

}  // namespace

CoarseTriangles coarse_triangles(const DisplayMesh& mesh, std::size_t most) {
    if (mesh.triangles.size() <= most) return {};
    const double share = static_cast<double>(most) / static_cast<double>(mesh.triangles.size());
    std::vector<std::vector<Triangle>> of_parts(mesh.parts.size());
    parallel_for(of_parts.size(), [&](std::size_t i) {
        const auto& [object, material, is_front, first, count] = mesh.parts[i];
        of_parts[i] = coarse_part(mesh, std::span(mesh.triangles).subspan(first, count), share);
    });
    CoarseTriangles coarse;
    for (const std::vector<Triangle>& part : of_parts) {
        coarse.parts.push_back({coarse.triangles.size(), part.size()});
        coarse.triangles.insert(coarse.triangles.end(), part.begin(), part.end());
    }
    return coarse;
}

}  // namespace stilb::walk
