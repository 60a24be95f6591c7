#include "geometry/leaning_normals.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace stilb::geometry {

std::size_t drop_leaning_normals(Mesh& mesh) {
    static const double least_cosine = std::cos(kMostLean_deg * kPi / 180);
    std::vector<std::size_t> leaning;
    for (std::size_t t = 0; !mesh.normals.empty() && t < mesh.triangles.size(); ++t) {
        const Triangle& corners = mesh.corner_normals.empty() ? mesh.triangles[t] : mesh.corner_normals[t];
        if (std::ranges::count(corners, kNoNormal) > 0) continue;
        const auto [a, b, c] = mesh.corners_of(t);
        const Vec3 area = cross(b - a, c - a);
        const Vec3 sum = mesh.normals[corners[0]] + mesh.normals[corners[1]] + mesh.normals[corners[2]];
        if (std::abs(dot(sum, area)) < least_cosine * length(sum) * length(area)) leaning.push_back(t);
    }
    if (leaning.empty()) return 0;
    if (mesh.corner_normals.empty()) mesh.corner_normals = mesh.triangles;
    for (const std::size_t t : leaning) mesh.corner_normals[t] = {kNoNormal, kNoNormal, kNoNormal};
    return leaning.size();
}

}  // namespace stilb::geometry
