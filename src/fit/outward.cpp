#include "fit/outward.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/mesh_topology.h"

namespace stilb::fit {
namespace {

/// For each triangle, its neighbours across edges, and whether their fronts lie on different sides.
struct Neighbour {
    std::uint32_t triangle;
    bool is_turned;
};
using Neighbours = std::vector<std::vector<Neighbour>>;

Neighbours neighbours_of(const geometry::Edges& edges, std::size_t triangles) {
    Neighbours neighbours(triangles);
    edges.for_each([&](auto first, auto last) {
        if (last - first != 2) return;
        const geometry::EdgeUse &a = *first, &b = *(first + 1);
        const bool is_turned = a.upwards == b.upwards;
        neighbours[a.triangle].push_back({b.triangle, is_turned});
        neighbours[b.triangle].push_back({a.triangle, is_turned});
    });
    return neighbours;
}

/// Traverses a part and orients its triangles like the first one.
class Turner {
  public:
    explicit Turner(const Neighbours& neighbours)
        : neighbours_(neighbours), seen_(neighbours.size()), turned_(neighbours.size()) {}

    /// The triangles of the part that contains `first`; none where they were visited before.
    std::vector<std::uint32_t> part_of(std::uint32_t first) {
        std::vector<std::uint32_t> part;
        add(first, part);
        for (std::size_t i = 0; i < part.size(); ++i) {
            for (const auto& [triangle, is_turned] : neighbours_[part[i]]) {
                if (add(triangle, part)) turned_[triangle] = turned_[part[i]] != is_turned;
            }
        }
        return part;
    }
    void turn(const std::vector<std::uint32_t>& part) {
        for (const std::uint32_t t : part) turned_[t] = !turned_[t];
    }
    bool is_turned(std::uint32_t triangle) const { return turned_[triangle]; }

  private:
    /// False where it was visited before.
    bool add(std::uint32_t triangle, std::vector<std::uint32_t>& part) {
        if (seen_[triangle]) return false;
        seen_[triangle] = true;
        part.push_back(triangle);
        return true;
    }

    const Neighbours& neighbours_;
    std::vector<bool> seen_, turned_;
};

/// Six times the volume about the middle of the part's corners.
double volume_of(const Mesh& mesh, const std::vector<std::uint32_t>& part, const Turner& turner) {
    Vec3 middle;
    for (const std::uint32_t t : part) {
        for (const std::uint32_t corner : mesh.triangles[t]) middle += mesh.vertices[corner];
    }
    middle = middle / (3 * static_cast<double>(part.size()));
    double volume = 0;
    for (const std::uint32_t t : part) {
        const auto [a, b, c] = mesh.triangles[t];
        const double own =
            dot(mesh.vertices[a] - middle, cross(mesh.vertices[b] - middle, mesh.vertices[c] - middle));
        volume += turner.is_turned(t) ? -own : own;
    }
    return volume;
}

}  // namespace

OutwardMesh outward(const Mesh& mesh) {
    const geometry::Edges edges(mesh);
    OutwardMesh result{mesh};
    edges.for_each([&](auto first, auto last) { result.open_edges += last - first == 2 ? 0 : 1; });
    const Neighbours neighbours = neighbours_of(edges, mesh.triangles.size());
    Turner turner(neighbours);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::vector<std::uint32_t> part = turner.part_of(t);
        if (part.empty()) continue;
        ++result.parts;
        if (volume_of(mesh, part, turner) < 0) turner.turn(part);
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!turner.is_turned(t)) continue;
        geometry::turn_over(result.mesh, t);
        ++result.turned;
    }
    return result;
}

}  // namespace stilb::fit
