
#include "patches/patches.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "geometry/harmonics/surface.h"
#include "geometry/mesh_topology.h"
#include "patches/vertex_interpolation.h"
#include "stilb/error.h"

namespace stilb::patches {

namespace {

/// The area of a patch in squares of the longest edge, approximately: halving leaves edges between half of
/// the limit and the limit.
constexpr double kMeanArea = 0.2;

/// The division of a shape: its starting mesh, the limit of its edges, and the positions of new vertices.
struct Division {
    Mesh coarse;
    double longest_edge_m;
    MiddleOf middle_of = [](const Vec3& a, const Vec3& b) { return 0.5 * (a + b); };
};

Division division_of(const Mesh& mesh, double longest_edge_m) {
    const std::vector<std::uint32_t> vertex_at = geometry::welded(mesh.vertices);
    Division division{{mesh.vertices, mesh.triangles}, longest_edge_m};
    for (Triangle& t : division.coarse.triangles) t = {vertex_at[t[0]], vertex_at[t[1]], vertex_at[t[2]]};
    return division;
}
Division division_of(const Rectangle& rectangle, double longest_edge_m) {
    return {triangulated(rectangle), longest_edge_m};
}
Division division_of(const Box& box, double longest_edge_m) { return {triangulated(box), longest_edge_m}; }

Division division_of(const Sphere& sphere, double longest_edge_m) {
    return {inscribed_icosahedron(sphere), std::min(longest_edge_m, kLongestCurvedEdge * sphere.radius),
            [sphere](const Vec3& a, const Vec3& b) {
                const Vec3 outwards = (a - sphere.center) + (b - sphere.center);
                return sphere.center + sphere.radius * normalized(outwards);
            }};
}

Division division_of(const Harmonics& harmonics, double longest_edge_m) {
    const double radius_m = harmonics.scale * harmonics.surface->greatest_radius();
    return {inscribed_icosahedron(harmonics), std::min(longest_edge_m, kLongestCurvedEdge * radius_m),
            [harmonics](const Vec3& a, const Vec3& b) {
                return harmonics.point_towards((a - harmonics.center) + (b - harmonics.center));
            }};
}

/// Six triangles about the middle. Only edges along the rim have both ends on it, and those that halve them.
Division division_of(const Disk& disk, double longest_edge_m) {
    const Frame frame = Frame::around(disk.normal);
    Mesh mesh{{disk.center}, {}};
    for (std::uint32_t i = 0; i < 6; ++i) {
        const double angle = i * std::numbers::pi / 3;
        mesh.vertices.push_back(disk.center +
                                disk.radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v));
        mesh.triangles.push_back({0, i + 1, (i + 1) % 6 + 1});
    }
    return {std::move(mesh), std::min(longest_edge_m, kLongestCurvedEdge * disk.radius),
            [disk](const Vec3& a, const Vec3& b) {
                const Vec3 middle = 0.5 * (a + b) - disk.center;
                const double inner = 0.999999 * disk.radius;
                const auto is_on_rim = [&](const Vec3& p) { return length(p - disk.center) > inner; };
                if (!is_on_rim(a) || !is_on_rim(b)) return disk.center + middle;
                return disk.center + disk.radius * normalized(middle);
            }};
}

void check_size(const Scene& scene, double longest_edge_m) {
    if (!(longest_edge_m > 0) || !std::isfinite(longest_edge_m)) {
        throw InputError(
            fmt::format("the patch size is {} m, but must be above 0; "
                        "about {:.2g} m gives 10,000 patches here.",
                        longest_edge_m, patch_size_m(scene)));
    }
    const double about = surface_area_m2(scene) / (kMeanArea * longest_edge_m * longest_edge_m);
    if (about > static_cast<double>(kMostPatches)) {
        throw InputError(fmt::format(
            "a patch size of {} m would give about {:.1g} patches, more than the limit of {}. "
            "Use {:.2g} m or more.",
            longest_edge_m, about, kMostPatches, patch_size_m(scene, static_cast<double>(kMostPatches))));
    }
}

/// Adds one object after another.
class Collector {
  public:
    explicit Collector(Patches& patches) : patches_(patches) {}

    void add(const Object& object, const Division& division) {
        const RefinedMesh fine = refined(division.coarse, division.longest_edge_m, division.middle_of);
        triangles_.clear();
        normals_.clear();
        const std::size_t first = patches_.count();
        for (std::size_t i = 0; i < fine.parents.size(); ++i) {
            const std::size_t parent = object.materials.size() == 1 ? 0 : fine.parents[i];
            add_triangle(fine.mesh, fine.mesh.triangles[i], object.materials[parent]);
        }
        const auto smooth =
            divide_at_creases(triangles_, normals_, std::span(patches_.materials).subspan(first));
        const auto before = static_cast<std::uint32_t>(patches_.vertices.size());
        for (const std::uint32_t vertex : smooth.original) {
            patches_.vertices.push_back(in_floats(fine.mesh.vertices[vertex] - patches_.center));
        }
        for (const Triangle& t : smooth.triangles) {
            patches_.corners.push_back({t[0] + before, t[1] + before, t[2] + before});
        }
        patches_.first_of_object.push_back(static_cast<std::uint32_t>(patches_.count()));
    }

  private:
    static Float3 in_floats(const Vec3& v) {
        return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    }

    void add_triangle(const Mesh& mesh, const Triangle& t, MaterialId material) {
        const Vec3& a = mesh.vertices[t[0]];
        const Vec3 doubled = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
        const double doubled_area = length(doubled);
        if (!(static_cast<float>(doubled_area) > 0)) return;
        triangles_.push_back(t);
        normals_.push_back(doubled / doubled_area);
        patches_.normals.push_back(in_floats(normals_.back()));
        patches_.areas_m2.push_back(static_cast<float>(doubled_area / 2));
        patches_.materials.push_back(material);
    }

    Patches& patches_;
    std::vector<Triangle> triangles_;  ///< of the object, by its own vertices
    std::vector<Vec3> normals_;
};

}  // namespace

ObjectId Patches::object_of(std::uint32_t patch) const {
    const auto after = std::ranges::upper_bound(first_of_object, patch);
    return ObjectId{static_cast<std::uint32_t>(after - first_of_object.begin() - 1)};
}

Vec3 Patches::position(std::uint32_t patch, const math::Barycentric& barycentric) const {
    const auto& [a, b, c] = corners[patch];
    return center + barycentric.b0 * Vec3(vertices[a]) + barycentric.b1 * Vec3(vertices[b]) +
           barycentric.b2 * Vec3(vertices[c]);
}

Vec3 Patches::middle(std::uint32_t patch) const { return position(patch, {1. / 3, 1. / 3, 1. / 3}); }

Vec3 Patches::normal_of(std::uint32_t side) const {
    const Vec3 normal(normals[patch_of(side)]);
    return is_front(side) ? normal : -normal;
}

Patches make_patches(const Scene& scene, double longest_edge_m, const Monitor& monitor) {
    check_size(scene, longest_edge_m);
    std::vector<Division> divisions;
    Bounds bounds;
    for (const Object& object : scene.objects) {
        divisions.push_back(
            std::visit([&](const auto& shape) { return division_of(shape, longest_edge_m); }, object.shape));
        for (const Vec3& vertex : divisions.back().coarse.vertices) bounds.include(vertex);
    }
    Patches patches;
    if (!bounds.is_empty()) patches.center = bounds.middle();
    Collector collector(patches);
    Stage stage(monitor, "patches", divisions.size());
    for (std::size_t i = 0; i < divisions.size(); ++i) {
        collector.add(scene.objects[i], divisions[i]);
        stage.advance();
    }
    return patches;
}

Bounds bounds_of(const Patches& patches) {
    Bounds bounds;
    for (const Float3& vertex : patches.vertices) bounds.include(Vec3(vertex));
    return bounds;
}

double patch_size_m(const Scene& scene, double count) {
    return std::sqrt(surface_area_m2(scene) / (kMeanArea * count));
}

namespace {

constexpr std::uint32_t kNone = ~0u;
/// A tolerance, so that edges of exactly the limit are not divided because of rounding.
constexpr double kRounding = 1 + 1e-9;

/// The vertices in the middle of edges, each created on first use.
class Middles {
  public:
    Middles(std::vector<Vec3>& vertices, const MiddleOf& middle_of, std::size_t about)
        : vertices_(vertices), middle_of_(middle_of) {
        of_edge_.reserve(about);
    }

    std::uint32_t between(std::uint32_t a, std::uint32_t b) {
        const std::uint64_t edge = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        const auto [found, is_new] = of_edge_.try_emplace(edge, static_cast<std::uint32_t>(vertices_.size()));
        if (is_new) vertices_.push_back(middle_of_(vertices_[a], vertices_[b]));
        return found->second;
    }

  private:
    std::vector<Vec3>& vertices_;
    const MiddleOf& middle_of_;
    std::unordered_map<std::uint64_t, std::uint32_t> of_edge_;
};

/// A triangle rotated so that its longest edge comes first; edge i runs from corner i to corner i + 1.
struct TurnedTriangle {
    Triangle corners;
    std::array<double, 3> squared_lengths;
};

TurnedTriangle longest_first(const Triangle& t, const std::vector<Vec3>& vertices) {
    TurnedTriangle turned{t, {}};
    for (std::size_t i = 0; i < 3; ++i) {
        turned.squared_lengths[i] = squared_length(vertices[t[(i + 1) % 3]] - vertices[t[i]]);
    }
    const auto longest = std::ranges::max_element(turned.squared_lengths) - turned.squared_lengths.begin();
    std::rotate(turned.squared_lengths.begin(), turned.squared_lengths.begin() + longest,
                turned.squared_lengths.end());
    std::rotate(turned.corners.begin(), turned.corners.begin() + longest, turned.corners.end());
    return turned;
}

/// One round: all edges above the limit are halved once.
class Halving {
  public:
    Halving(RefinedMesh& coarse, double longest_edge_m, const MiddleOf& middle_of)
        : coarse_(coarse),
          squared_limit_(longest_edge_m * longest_edge_m * kRounding),
          middles_(coarse.mesh.vertices, middle_of, coarse.mesh.triangles.size()) {}

    /// Returns false where no edge was left to halve.
    bool run() {
        const std::size_t count = coarse_.mesh.triangles.size();
        finer_.reserve(2 * count);
        parents_.reserve(2 * count);
        for (std::size_t i = 0; i < count; ++i) {
            divide(coarse_.mesh.triangles[i]);
            parents_.resize(finer_.size(), coarse_.parents[i]);
        }
        coarse_.mesh.triangles = std::move(finer_);
        coarse_.parents = std::move(parents_);
        return coarse_.mesh.triangles.size() > count;
    }

  private:
    void divide(const Triangle& triangle) {
        const TurnedTriangle turned = longest_first(triangle, coarse_.mesh.vertices);
        if (!is_too_long(turned.squared_lengths[0])) {
            finer_.push_back(triangle);
            return;
        }
        const auto [a, b, c] = turned.corners;
        const std::uint32_t ab = middles_.between(a, b);
        const std::uint32_t bc = is_too_long(turned.squared_lengths[1]) ? middles_.between(b, c) : kNone;
        const std::uint32_t ca = is_too_long(turned.squared_lengths[2]) ? middles_.between(c, a) : kNone;
        if (bc != kNone && ca != kNone && is_shorter(bc, ca, ab, c)) {
            finer_.insert(finer_.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}});
            return;
        }
        divide_half(a, ab, c, ca);
        divide_half(c, ab, b, bc);
    }

    /// The half whose corners `from` and `to` are the ends of an edge of the whole, with that edge's middle
    /// if it has one.
    void divide_half(std::uint32_t from, std::uint32_t ab, std::uint32_t to, std::uint32_t middle) {
        if (middle == kNone) {
            finer_.push_back({from, ab, to});
        } else {
            finer_.insert(finer_.end(), {{from, ab, middle}, {middle, ab, to}});
        }
    }

    bool is_too_long(double squared_length_m2) const { return squared_length_m2 > squared_limit_; }

    bool is_shorter(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
        const std::vector<Vec3>& v = coarse_.mesh.vertices;
        return squared_length(v[b] - v[a]) * kRounding < squared_length(v[d] - v[c]);
    }

    RefinedMesh& coarse_;
    double squared_limit_;
    Middles middles_;
    std::vector<Triangle> finer_;
    std::vector<std::uint32_t> parents_;
};

}  // namespace

RefinedMesh refined(Mesh coarse, double longest_edge_m, const MiddleOf& middle_of) {
    RefinedMesh result{std::move(coarse), {}};
    result.parents.resize(result.mesh.triangles.size());
    for (std::uint32_t i = 0; i < result.parents.size(); ++i) result.parents[i] = i;
    while (Halving(result, longest_edge_m, middle_of).run()) continue;
    return result;
}

}  // namespace stilb::patches
