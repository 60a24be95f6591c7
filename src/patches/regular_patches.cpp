#include "patches/regular_patches.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include "patches/patch_collector.h"

namespace stilb::patches {
namespace {

using Floats = RayPacket::Floats;
using Words = RayPacket::Words;

/// Larger objects may have triangles that are small, near to where light is measured.
constexpr double kLargeObject_m = 1024;
constexpr std::uint32_t kMostParts = 1024;  ///< so that numbers of patches are exact in single precision

std::array<Vec3, 3> corners_of(const rays::TracedMesh& mesh, std::uint32_t triangle) {
    std::array<Vec3, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto& [x, y, z] = mesh.vertices[mesh.triangles[triangle][c]];
        corners[c] = {x, y, z};
    }
    return corners;
}

double area_of(const std::array<Vec3, 3>& corners) {
    return length(cross(corners[1] - corners[0], corners[2] - corners[0])) / 2;
}

double longest_edge_of(const std::array<Vec3, 3>& corners) {
    return std::max(
        {length(corners[1] - corners[0]), length(corners[2] - corners[1]), length(corners[0] - corners[2])});
}

/// The parts of triangles, with common vertices where they touch.
class PartsMesh {
  public:
    /// Positions that differ by less than about `tolerance_m` are one.
    explicit PartsMesh(double tolerance_m) : tolerance_m_(tolerance_m) {}

    /// The most parts along the edges of a triangle of this height, its least, that all have an area. A
    /// vertex may move by the diagonal of a cell, sqrt(3) x tolerance, and so may the edge opposite to it.
    double most_parts(double height_m) const {
        constexpr double least_height = 4;  // tolerances; more than 2 sqrt(3)
        return std::max(1.0, std::floor(height_m / (least_height * tolerance_m_)));
    }

    /// Row by row along the edge from corner 0 to 1; each upright part is followed by the one beside it that
    /// is upside down.
    void add(const std::array<Vec3, 3>& corners, std::uint32_t parts, std::uint32_t parent) {
        const double step = 1 / static_cast<double>(parts);
        const auto vertex = [&](std::uint32_t column, std::uint32_t row) {
            return number_of(corners[0] + (column * step) * (corners[1] - corners[0]) +
                             (row * step) * (corners[2] - corners[0]));
        };
        for (std::uint32_t row = 0; row < parts; ++row) {
            for (std::uint32_t column = 0; column + row < parts; ++column) {
                const std::uint32_t right = vertex(column + 1, row), above = vertex(column, row + 1);
                mesh_.mesh.triangles.push_back({vertex(column, row), right, above});
                if (column + row + 1 < parts)
                    mesh_.mesh.triangles.push_back({vertex(column + 1, row + 1), above, right});
            }
        }
        mesh_.parents.resize(mesh_.mesh.triangles.size(), parent);
    }

    std::uint32_t count() const { return static_cast<std::uint32_t>(mesh_.parents.size()); }

    RefinedMesh take(const Vec3& center) {
        for (Vec3& vertex : mesh_.mesh.vertices) vertex += center;
        return std::move(mesh_);
    }

  private:
    using Cell = std::array<std::int64_t, 3>;
    struct CellHash {
        std::size_t operator()(const Cell& cell) const {
            std::uint64_t hash = 0;
            for (const std::int64_t x : cell)
                hash = (hash ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ull, hash ^= hash >> 29;
            return hash;
        }
    };

    std::uint32_t number_of(const Vec3& position) {
        const auto cell_along = [&](double x) { return std::llround(x / tolerance_m_); };
        const auto [found, is_new] =
            numbers_.try_emplace({cell_along(position.x), cell_along(position.y), cell_along(position.z)},
                                 static_cast<std::uint32_t>(mesh_.mesh.vertices.size()));
        if (is_new) mesh_.mesh.vertices.push_back(position);
        return found->second;
    }

    double tolerance_m_;
    RefinedMesh mesh_;
    std::unordered_map<Cell, std::uint32_t, CellHash> numbers_;
};

/// Triangles in the order of PartsMesh: that of the barycentric coordinates (u, v), and the coordinates
/// there.
STILB_VECTORIZED void find_parts(const Floats& __restrict parts, const Floats& __restrict u,
                                 const Floats& __restrict v, Words& __restrict number, Floats& __restrict b1,
                                 Floats& __restrict b2) {
    for (int i = 0; i < kPacketWidth; ++i) {
        const float last = parts[i] - 1;
        const float x = u[i] * parts[i], y = v[i] * parts[i];
        const float row = std::min(std::max(std::floor(y), 0.0f), last);
        const float column = std::min(std::max(std::floor(x), 0.0f), last - row);
        const float along_x = std::min(std::max(x - column, 0.0f), 1.0f);
        const float along_y = std::min(std::max(y - row, 0.0f), 1.0f);
        const float is_upside_down = along_x + along_y > 1 && row + column < last ? 1.0f : 0.0f;
        b1[i] = std::abs(is_upside_down - along_x);
        b2[i] = std::min(std::abs(is_upside_down - along_y), 1 - b1[i]);
        number[i] = static_cast<std::uint32_t>(
            static_cast<std::int32_t>(row * (2 * parts[i] - row) + 2 * column + is_upside_down));
    }
}

}  // namespace

RegularPatches::RegularPatches(const Scene& scene, const rays::RayCaster& caster, double count,
                               const HasPatches& has_patches, const Monitor& monitor)
    : caster_(caster) {
    patches_.center = caster.center();
    const double patch_area_m2 = surface_area_m2(scene) / count;
    Stage stage(monitor, "patches", scene.objects.size());
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        add(scene.objects[i], ObjectId{i}, patch_area_m2, has_patches);
        stage.advance();
    }
}

void RegularPatches::add(const Object& object, ObjectId id, double patch_area_m2,
                         const HasPatches& has_patches) {
    const std::optional<rays::TracedMesh> mesh = caster_.traced_mesh(id);
    first_division_.push_back(mesh ? static_cast<std::uint32_t>(divisions_.size()) : kNoSide);
    const Bounds bounds = geometry::bounds_of(object.shape);
    const double offset_m = caster_.offset_m(bounds.middle(), length(bounds.max - bounds.min));
    PartsMesh parts(std::min(offset_m, Lift::kShare * kLargeObject_m) / 4);
    const std::size_t before = divisions_.size();
    for (std::uint32_t i = 0; mesh && i < mesh->triangles.size(); ++i) {
        const std::array<Vec3, 3> corners = corners_of(*mesh, i);
        const std::uint32_t parent = mesh->triangle_of(i);
        const double area_m2 = area_of(corners);
        Division& division = divisions_.emplace_back();
        const MaterialId material = object.materials[object.materials.size() == 1 ? 0 : parent];
        if (!(static_cast<float>(area_m2) > 0) || !has_patches(id, material)) continue;
        const double most =
            std::min(double{kMostParts}, parts.most_parts(2 * area_m2 / longest_edge_of(corners)));
        const double along = std::round(std::sqrt(area_m2 / patch_area_m2));
        division = {parts.count(), static_cast<std::uint32_t>(std::clamp(along, 1.0, most))};
        parts.add(corners, division.parts, parent);
    }
    const auto first = static_cast<std::uint32_t>(patches_.count());
    const std::vector<std::uint32_t> kept =
        PatchCollector(patches_).add(parts.take(patches_.center), object.materials);
    // Single parts without area are left out.
    for (Division& division : std::span(divisions_).subspan(before)) {
        if (division.parts == 0) continue;
        const auto own = std::ranges::lower_bound(kept, division.first);
        const bool is_kept = own != kept.end() && *own == division.first;
        division = is_kept ? Division{first + static_cast<std::uint32_t>(own - kept.begin()), division.parts}
                           : Division{};
    }
}

PatchHits RegularPatches::closest(rays::RayHitPacket& packet, const LaneMask& lanes,
                                  rays::Coherence coherence) const {
    caster_.closest(packet, lanes, coherence);
    PatchHits hits;
    alignas(64) Floats parts;
    alignas(64) Words numbers;
    std::array<std::uint32_t, kPacketWidth> first;
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        Division division;
        if (lanes[i] != 0 && packet.object[i] != rays::kNothing) {
            const std::uint32_t first_division = first_division_[packet.object[i]];
            if (first_division != kNoSide) division = divisions_[first_division + packet.primitive[i]];
            if (division.parts == 0) hits.exact_lanes |= 1u << i;
        }
        if (division.parts == 0) packet.u[i] = packet.v[i] = 0;
        first[i] = division.first;
        parts[i] = static_cast<float>(division.parts);
    }
    find_parts(parts, packet.u, packet.v, numbers, hits.b1, hits.b2);
    const auto fronts = static_cast<std::uint32_t>(patches_.count());
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        const float along_normal = packet.ray.direction_x[i] * packet.normal_x[i] +
                                   packet.ray.direction_y[i] * packet.normal_y[i] +
                                   packet.ray.direction_z[i] * packet.normal_z[i];
        const std::uint32_t patch = first[i] + numbers[i];
        hits.sides[i] = first[i] == kNoSide ? kNoSide : along_normal < 0 ? patch : patch + fronts;
    }
    return hits;
}

}  // namespace stilb::patches
