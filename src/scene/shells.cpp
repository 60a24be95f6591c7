#include "scene/shells.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace stilb {
namespace {

/// Per vertex, the first of those at the same place.
std::vector<std::uint32_t> welded(const std::vector<Vec3>& vertices) {
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto place = [&](std::uint32_t i) { return std::tie(vertices[i].x, vertices[i].y, vertices[i].z); };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return place(a) != place(b) ? place(a) < place(b) : a < b;
    });
    std::vector<std::uint32_t> first(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool is_repeated = i > 0 && place(order[i]) == place(order[i - 1]);
        first[order[i]] = is_repeated ? first[order[i - 1]] : order[i];
    }
    return first;
}

/// An edge as one of its triangles has it: between vertices low < high, run along from low to high or not.
struct EdgeUse {
    std::uint32_t low, high, triangle;
    bool upwards;

    bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

/// All uses of all edges, those of the same edge one after another.
std::vector<EdgeUse> edge_uses(const Mesh& mesh) {
    const std::vector<std::uint32_t> vertex = welded(mesh.vertices);
    std::vector<EdgeUse> uses;
    uses.reserve(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t from = vertex[mesh.triangles[t][side]];
            const std::uint32_t to = vertex[mesh.triangles[t][(side + 1) % 3]];
            uses.push_back({std::min(from, to), std::max(from, to), t, from < to});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    return uses;
}

/// Sets of triangles, joined step by step.
class Groups {
  public:
    explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[root(b)] = root(a); }
    /// Per member the number of its set, in the order of the sets' first members; and how many there are.
    std::pair<std::vector<std::uint32_t>, std::size_t> numbered() {
        constexpr std::uint32_t none = ~0u;
        std::vector<std::uint32_t> number_of_root(parent_.size(), none), numbers(parent_.size());
        std::uint32_t count = 0;
        for (std::uint32_t i = 0; i < parent_.size(); ++i) {
            std::uint32_t& number = number_of_root[root(i)];
            if (number == none) number = count++;
            numbers[i] = number;
        }
        return {std::move(numbers), count};
    }

  private:
    std::vector<std::uint32_t> parent_;
};

/// Calls `visit(first, last)` for the uses of every edge.
template <typename Visitor>
void for_each_edge(const std::vector<EdgeUse>& uses, const Visitor& visit) {
    for (auto first = uses.begin(); first != uses.end();) {
        const auto last =
            std::find_if(first, uses.end(), [&](const EdgeUse& use) { return !use.same_edge(*first); });
        visit(first, last);
        first = last;
    }
}

}  // namespace

std::size_t Shells::total_open_edges() const {
    return std::accumulate(open_edges.begin(), open_edges.end(), std::size_t{0});
}

Shells find_shells(const Mesh& mesh) {
    const std::vector<EdgeUse> uses = edge_uses(mesh);
    Groups groups(mesh.triangles.size());
    for_each_edge(uses, [&](auto first, auto last) {
        for (auto use = first + 1; use != last; ++use) groups.join(first->triangle, use->triangle);
    });
    auto [of_triangle, count] = groups.numbered();
    Shells shells{std::move(of_triangle), std::vector<std::size_t>(count), 0};
    for_each_edge(uses, [&](auto first, auto last) {
        const auto times = last - first;
        if (times % 2 != 0) ++shells.open_edges[shells.of_triangle[first->triangle]];
        if (times == 2 && first->upwards == (first + 1)->upwards) ++shells.turned_edges;
    });
    return shells;
}

Shells find_shells(const Shape& shape) {
    struct Finder {
        Shells operator()(const Mesh& mesh) const { return find_shells(mesh); }
        Shells operator()(const Rectangle& rectangle) const { return find_shells(triangulated(rectangle)); }
        Shells operator()(const Box& box) const { return find_shells(triangulated(box)); }
        Shells operator()(const Sphere&) const { return {{0}, {0}, 0}; }
        Shells operator()(const Disk&) const { return {{0}, {1}, 0}; }
    };
    return std::visit(Finder{}, shape);
}

}  // namespace stilb
