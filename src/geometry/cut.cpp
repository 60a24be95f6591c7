#include "geometry/cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace stilb::geometry {
namespace {

double distance_to_edge(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double t = std::clamp(dot(point - a, along) / dot(along, along), 0.0, 1.0);
    return length(a + t * along - point);
}

constexpr std::size_t kNone = 3;

/// Which edges are cut.
struct CutRule {
    Vec3 center;
    double size_m;

    /// The number of a triangle's longest edge that is cut, or kNone.
    std::size_t longest_to_cut(const std::vector<Vec3>& vertices, const Triangle& t) const {
        std::size_t longest = kNone;
        double most = 0;
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const Vec3 &a = vertices[t[edge]], &b = vertices[t[(edge + 1) % 3]];
            const double length_m = length(b - a);
            if (length_m <= size_m || length_m <= most || length_m <= distance_to_edge(center, a, b))
                continue;
            longest = edge;
            most = length_m;
        }
        return longest;
    }
};

class Cutter {
  public:
    Cutter(const Mesh& mesh, const CutRule& rule) : rule_(rule) {
        cut_.vertices = mesh.vertices;
        cut_.triangles.reserve(mesh.triangles.size());
        cut_.parents.reserve(mesh.triangles.size());
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) add(mesh.triangles[t], t);
    }

    CutTriangles take() { return std::move(cut_); }

  private:
    /// Adds the parts of a triangle: its longest edge that is too long is halved first.
    void add(const Triangle& whole, std::uint32_t parent) {
        std::vector<Triangle> open{whole};
        while (!open.empty()) {
            const Triangle t = open.back();
            open.pop_back();
            const std::size_t edge = rule_.longest_to_cut(cut_.vertices, t);
            if (edge == kNone) {
                cut_.triangles.push_back(t);
                cut_.parents.push_back(parent);
                continue;
            }
            const std::uint32_t a = t[edge], b = t[(edge + 1) % 3], c = t[(edge + 2) % 3];
            const std::uint32_t middle = middle_of(a, b);
            open.push_back({middle, b, c});
            open.push_back({a, middle, c});
        }
    }

    /// The same for both triangles of an edge: the sum of two numbers does not depend on their order.
    std::uint32_t middle_of(std::uint32_t a, std::uint32_t b) {
        const auto next = static_cast<std::uint32_t>(cut_.vertices.size());
        const auto [found, is_new] = middles_.try_emplace(std::minmax(a, b), next);
        if (is_new) cut_.vertices.push_back(0.5 * (cut_.vertices[a] + cut_.vertices[b]));
        return found->second;
    }

    CutRule rule_;
    CutTriangles cut_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
};

}  // namespace

CutTriangles cut_large_triangles(const Mesh& mesh, const Vec3& center, double size_m) {
    return Cutter(mesh, {center, size_m}).take();
}

bool has_large_triangles(const Mesh& mesh, const Vec3& center, double size_m) {
    const CutRule rule{center, size_m};
    return std::ranges::any_of(mesh.triangles, [&](const Triangle& triangle) {
        return rule.longest_to_cut(mesh.vertices, triangle) != kNone;
    });
}

}  // namespace stilb::geometry
