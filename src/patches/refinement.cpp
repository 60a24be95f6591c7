#include "patches/refinement.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

namespace stilb::patches {
namespace {

constexpr std::uint32_t kNone = ~0u;
/// So that edges of exactly the length asked for stay whole, however they are rounded.
constexpr double kRounding = 1 + 1e-9;

/// The vertices in the middle of edges, each made when it is first asked for.
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

/// A triangle turned so that its longest edge comes first; edge i runs from corner i to corner i + 1.
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

/// One round: all edges longer than the limit are halved once.
class Halving {
  public:
    Halving(RefinedMesh& coarse, double longest_edge_m, const MiddleOf& middle_of)
        : coarse_(coarse),
          squared_limit_(longest_edge_m * longest_edge_m * kRounding),
          middles_(coarse.mesh.vertices, middle_of, coarse.mesh.triangles.size()) {}

    /// False where nothing was left to do.
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
    /// where it has one.
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
