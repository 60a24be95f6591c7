#include "patches/refinement.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace stilb::patches {
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
        const auto [found, is_new] =
            of_edge_.try_emplace(edge_key(a, b), static_cast<std::uint32_t>(vertices_.size()));
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

    Edge edge(std::size_t i) const { return {corners[i], corners[(i + 1) % 3], squared_lengths[i]}; }
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

class Halving {
  public:
    Halving(RefinedMesh& coarse, const IsTooLong& is_too_long, const MiddleOf& middle_of)
        : coarse_(coarse),
          is_too_long_(is_too_long),
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
        if (!is_too_long_(turned.edge(0))) {
            finer_.push_back(triangle);
            return;
        }
        const auto [a, b, c] = turned.corners;
        const std::uint32_t ab = middles_.between(a, b);
        const std::uint32_t bc = is_too_long_(turned.edge(1)) ? middles_.between(b, c) : kNone;
        const std::uint32_t ca = is_too_long_(turned.edge(2)) ? middles_.between(c, a) : kNone;
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

    bool is_shorter(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
        const std::vector<Vec3>& v = coarse_.mesh.vertices;
        return squared_length(v[b] - v[a]) * kRounding < squared_length(v[d] - v[c]);
    }

    RefinedMesh& coarse_;
    const IsTooLong& is_too_long_;
    Middles middles_;
    std::vector<Triangle> finer_;
    std::vector<std::uint32_t> parents_;
};

/// Edges that are too long, together with the longest edges of their triangles: a triangle is halved at its
/// longest edge first.
class EdgesToHalve {
  public:
    EdgesToHalve(const Mesh& mesh, const IsTooLong& is_too_long) {
        std::vector<TurnedTriangle> turned;
        for (const Triangle& t : mesh.triangles) turned.push_back(longest_first(t, mesh.vertices));
        for (const TurnedTriangle& t : turned) {
            for (std::size_t i = 0; i < 3; ++i) {
                if (is_too_long(t.edge(i))) add(t.edge(i));
            }
        }
        for (bool has_grown = !edges_.empty(); has_grown;) {
            has_grown = false;
            for (const TurnedTriangle& t : turned) {
                if (!contains(t.edge(0)) && (contains(t.edge(1)) || contains(t.edge(2)))) {
                    add(t.edge(0));
                    has_grown = true;
                }
            }
        }
    }

    bool contains(const Edge& edge) const { return edges_.contains(edge_key(edge.a, edge.b)); }

  private:
    void add(const Edge& edge) { edges_.insert(edge_key(edge.a, edge.b)); }

    std::unordered_set<std::uint64_t> edges_;
};

}  // namespace

RefinedMesh unrefined(Mesh mesh) {
    RefinedMesh result{std::move(mesh), {}};
    result.parents.resize(result.mesh.triangles.size());
    std::iota(result.parents.begin(), result.parents.end(), 0u);
    return result;
}

bool halve_edges(RefinedMesh& refined, const IsTooLong& is_too_long, const MiddleOf& middle_of) {
    const EdgesToHalve edges(refined.mesh, is_too_long);
    const IsTooLong is_to_be_halved = [&](const Edge& edge) { return edges.contains(edge); };
    return Halving(refined, is_to_be_halved, middle_of).run();
}

RefinedMesh refined(Mesh coarse, double longest_edge_m, const MiddleOf& middle_of) {
    RefinedMesh result = unrefined(std::move(coarse));
    const double squared_limit = longest_edge_m * longest_edge_m * kRounding;
    // By the length alone, the longest edge of a triangle is too long wherever another edge is.
    const IsTooLong is_too_long = [&](const Edge& edge) { return edge.squared_length_m2 > squared_limit; };
    while (Halving(result, is_too_long, middle_of).run()) continue;
    return result;
}

}  // namespace stilb::patches
