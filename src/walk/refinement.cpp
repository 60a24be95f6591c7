#include "walk/refinement.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "base/parallel.h"

namespace stilb::walk {
namespace {

constexpr std::uint32_t kNoIndex = ~0u;
/// Darkness against which errors are judged, as a share of the typical illuminance.
constexpr double kFloor = 0.1;
/// The bulge of a curved surface beyond an edge, over its radius, that is small enough.
constexpr double kSmallBulge = 0.005;
/// The largest error inside of a triangle over that in its edges' middles, for smooth light.
constexpr double kInside = 4. / 3;
/// Triangles that halving an edge adds, with those that have to follow it.
constexpr std::size_t kTrianglesPerEdge = 4;

/// Two vertices, a < b, with the triangles on the edge between them.
struct SurfaceEdge {
    std::uint32_t a = 0, b = 0;
    std::uint32_t triangle = kNoIndex, other_triangle = kNoIndex;
    double area_m2 = 0;               ///< of its triangles
    std::uint32_t middle = kNoIndex;  ///< the vertex that would halve it, where its light is known
};

std::uint64_t pair_of(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

class Refinement {
  public:
    Refinement(const RefinementScene& scene, const DisplayOptions& options, double typical_lx,
               double extent_m, DisplaySurface& surface, VertexLights& lights)
        : scene_(scene),
          options_(options),
          surface_(surface),
          lights_(lights),
          floor_lx_(kFloor * typical_lx),
          squared_shortest_m2_(extent_m * options.shortest_edge * extent_m * options.shortest_edge) {}

    void run(const Monitor& monitor) {
        if (surface_.triangles.size() > options_.most_triangles) return;
        while (run_round(monitor)) continue;
    }

    std::vector<float> interpolation_errors_lx() const {
        std::vector<float> errors(surface_.vertices.size());
        for (const SurfaceEdge& edge : edges()) {
            const auto error = static_cast<float>(error_lx(edge));
            for (const std::uint32_t end : {edge.a, edge.b}) errors[end] = std::max(errors[end], error);
        }
        return errors;
    }

  private:
    /// Returns false where nothing is left to do.
    bool run_round(const Monitor& monitor) {
        std::vector<SurfaceEdge> edges = this->edges();
        look_at_middles(edges, monitor);
        const std::size_t count = surface_.triangles.size();
        if (count >= options_.most_triangles) return false;
        const std::size_t affordable = (options_.most_triangles - count) / kTrianglesPerEdge;
        marked_ = most_urgent(edges, affordable);
        if (marked_.empty()) return false;
        mark_longest_edges();
        divide();
        return true;
    }

    std::vector<SurfaceEdge> edges() const {
        std::vector<SurfaceEdge> edges;
        std::unordered_map<std::uint64_t, std::uint32_t> number;
        number.reserve(2 * surface_.triangles.size());
        for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
            const Triangle& corners = surface_.triangles[t].corners;
            const double area_m2 = surface_.area_m2(surface_.triangles[t]);
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint64_t pair = pair_of(corners[i], corners[(i + 1) % 3]);
                const auto [found, is_new] =
                    number.try_emplace(pair, static_cast<std::uint32_t>(edges.size()));
                if (is_new) edges.push_back(new_edge(pair));
                SurfaceEdge& edge = edges[found->second];
                (edge.triangle == kNoIndex ? edge.triangle : edge.other_triangle) = t;
                edge.area_m2 += area_m2;
            }
        }
        return edges;
    }

    SurfaceEdge new_edge(std::uint64_t pair) const {
        SurfaceEdge edge{static_cast<std::uint32_t>(pair >> 32), static_cast<std::uint32_t>(pair)};
        if (const auto known = middles_.find(pair); known != middles_.end()) edge.middle = known->second;
        return edge;
    }

    double squared_length_m2(std::uint32_t a, std::uint32_t b) const {
        return squared_length(surface_.vertices[a].position - surface_.vertices[b].position);
    }

    // Middles.

    void look_at_middles(std::vector<SurfaceEdge>& edges, const Monitor& monitor) {
        const std::size_t first = surface_.vertices.size();
        std::vector<std::vector<Adjoining>> around;
        for (SurfaceEdge& edge : edges) {
            if (edge.middle != kNoIndex || squared_length_m2(edge.a, edge.b) <= squared_shortest_m2_)
                continue;
            edge.middle = add_middle(edge);
            around.push_back(around_middle(edge));
        }
        light_vertices(scene_, surface_, first, around, lights_, monitor);
    }

    std::uint32_t add_middle(const SurfaceEdge& edge) {
        const auto middle = static_cast<std::uint32_t>(surface_.vertices.size());
        const SurfaceVertex &a = surface_.vertices[edge.a], &b = surface_.vertices[edge.b];
        const Shape& shape = scene_.shape_of(surface_.triangles[edge.triangle].side);
        SurfaceVertex vertex = middle_between(shape, a, b);
        const auto [place, is_new] = middle_places_.try_emplace(pair_of(a.place, b.place), surface_.places);
        if (is_new) ++surface_.places;
        vertex.place = place->second;
        surface_.vertices.push_back(vertex);
        middles_.emplace(pair_of(edge.a, edge.b), middle);
        return middle;
    }

    std::vector<Adjoining> around_middle(const SurfaceEdge& edge) const {
        const SurfaceTriangle& one = surface_.triangles[edge.triangle];
        if (scene_.is_specular(one.side)) return {};
        if (edge.other_triangle == kNoIndex) return {{surface_.middle(one), one.side}};
        const SurfaceTriangle& other = surface_.triangles[edge.other_triangle];
        return {{surface_.middle(one), one.side},
                {surface_.middle(other), other.side},
                {surface_.vertices[edge.a].position, one.side},
                {surface_.vertices[edge.b].position, one.side}};
    }

    // Errors.

    /// In the middle, summed over lights.
    double middle_error_lx(const SurfaceEdge& edge) const {
        if (lights_.is_covered[edge.middle]) return 0;
        const auto a = lights_.of(edge.a), b = lights_.of(edge.b), middle = lights_.of(edge.middle);
        double sum = 0;
        for (std::size_t light = 0; light < a.size(); ++light)
            sum += std::abs(middle[light] - (a[light] + b[light]) / 2);
        return sum;
    }

    /// The largest error beside an edge. Where its middle was not looked at, half of the difference of its
    /// ends stands for it, as if there were a step between them.
    double error_lx(const SurfaceEdge& edge) const {
        if (edge.middle != kNoIndex) return kInside * middle_error_lx(edge);
        if (lights_.is_covered[edge.a] || lights_.is_covered[edge.b]) return 0;
        const auto a = lights_.of(edge.a), b = lights_.of(edge.b);
        double sum = 0;
        for (std::size_t light = 0; light < a.size(); ++light) sum += std::abs(a[light] - b[light]) / 2;
        return sum;
    }

    /// How many times the error is larger than one that is small enough.
    double excess(const SurfaceEdge& edge) const {
        const double local_lx =
            std::max(lights_.sum_lx(edge.middle), (lights_.sum_lx(edge.a) + lights_.sum_lx(edge.b)) / 2);
        const double allowed_lx = options_.tolerance * (local_lx + floor_lx_);
        const double of_light = allowed_lx > 0 ? middle_error_lx(edge) / allowed_lx : 0;
        return std::max(of_light, bulge(edge) / kSmallBulge);
    }

    /// Of the true surface beyond the edge, over its radius.
    double bulge(const SurfaceEdge& edge) const {
        const auto &a = surface_.vertices[edge.a], &b = surface_.vertices[edge.b];
        const Vec3 straight = 0.5 * (a.position + b.position);
        const Vec3 offset = surface_.vertices[edge.middle].position - straight;
        if (squared_length(offset) == 0) return 0;
        const Shape& shape = scene_.shape_of(surface_.triangles[edge.triangle].side);
        return length(offset) / bounds_of(shape).half_extent();
    }

    // Halving.

    /// The pairs of places between which edges are to be halved: those that need it, or the most urgent ones.
    std::unordered_set<std::uint64_t> most_urgent(const std::vector<SurfaceEdge>& edges,
                                                  std::size_t affordable) const {
        struct Wish {
            std::uint64_t places;
            double weight;
        };
        std::vector<Wish> wishes;
        for (const SurfaceEdge& edge : edges) {
            if (edge.middle == kNoIndex) continue;
            const double times = excess(edge);
            if (times > 1) {
                const double length_m = std::sqrt(squared_length_m2(edge.a, edge.b));
                wishes.push_back({places_of(edge.a, edge.b), times * edge.area_m2 * length_m});
            }
        }
        if (wishes.size() > affordable) {
            const auto is_before = [](const Wish& one, const Wish& other) {
                return one.weight != other.weight ? one.weight > other.weight : one.places < other.places;
            };
            std::ranges::nth_element(wishes, wishes.begin() + static_cast<std::ptrdiff_t>(affordable),
                                     is_before);
            wishes.resize(affordable);
        }
        std::unordered_set<std::uint64_t> marked;
        for (const Wish& wish : wishes) marked.insert(wish.places);
        return marked;
    }

    std::uint64_t places_of(std::uint32_t a, std::uint32_t b) const {
        return pair_of(surface_.vertices[a].place, surface_.vertices[b].place);
    }
    bool is_marked(std::uint32_t a, std::uint32_t b) const { return marked_.contains(places_of(a, b)); }

    /// The corner where the longest edge begins.
    std::size_t longest_edge(const Triangle& corners) const {
        std::array<double, 3> lengths{};
        for (std::size_t i = 0; i < 3; ++i) lengths[i] = squared_length_m2(corners[i], corners[(i + 1) % 3]);
        return static_cast<std::size_t>(std::ranges::max_element(lengths) - lengths.begin());
    }

    /// Marks the longest edge of each triangle with a marked edge, until no more follow.
    void mark_longest_edges() {
        for (bool is_changed = true; is_changed;) {
            is_changed = false;
            for (const SurfaceTriangle& triangle : surface_.triangles) {
                const Triangle& t = triangle.corners;
                if (!is_marked(t[0], t[1]) && !is_marked(t[1], t[2]) && !is_marked(t[2], t[0])) continue;
                const std::size_t longest = longest_edge(t);
                is_changed |= marked_.insert(places_of(t[longest], t[(longest + 1) % 3])).second;
            }
        }
    }

    void divide() {
        std::vector<SurfaceTriangle> finer;
        finer.reserve(2 * surface_.triangles.size());
        for (const SurfaceTriangle& triangle : surface_.triangles) divide(triangle, finer);
        surface_.triangles = std::move(finer);
    }

    /// A corner of a triangle to be divided, or the middle of one of its edges.
    struct Corner {
        std::uint32_t vertex = kNoIndex;
        CornerWeights barycentric{};

        bool exists() const { return vertex != kNoIndex; }
    };

    Corner middle_of(const Corner& a, const Corner& b) const {
        if (!is_marked(a.vertex, b.vertex)) return {};
        Corner middle{middles_.at(pair_of(a.vertex, b.vertex))};
        for (std::size_t i = 0; i < 3; ++i) middle.barycentric[i] = (a.barycentric[i] + b.barycentric[i]) / 2;
        return middle;
    }

    /// At its longest edge first, as patches are (patches.h).
    void divide(const SurfaceTriangle& triangle, std::vector<SurfaceTriangle>& finer) const {
        const std::size_t first = longest_edge(triangle.corners);
        const auto corner = [&](std::size_t i) {
            const std::size_t turned = (first + i) % 3;
            return Corner{triangle.corners[turned], triangle.barycentric[turned]};
        };
        const Corner a = corner(0), b = corner(1), c = corner(2);
        const Corner ab = middle_of(a, b), bc = middle_of(b, c), ca = middle_of(c, a);
        const auto add = [&](const Corner& p, const Corner& q, const Corner& r) {
            finer.push_back({{p.vertex, q.vertex, r.vertex},
                             triangle.side,
                             {p.barycentric, q.barycentric, r.barycentric}});
        };
        const auto add_half = [&](const Corner& from, const Corner& to, const Corner& middle) {
            if (middle.exists()) {
                add(from, ab, middle);
                add(middle, ab, to);
            } else {
                add(from, ab, to);
            }
        };
        if (!ab.exists()) {
            finer.push_back(triangle);
        } else if (bc.exists() && ca.exists() &&
                   squared_length_m2(bc.vertex, ca.vertex) < squared_length_m2(ab.vertex, c.vertex)) {
            add(a, ab, ca), add(ab, b, bc), add(ca, bc, c), add(bc, ca, ab);
        } else {
            add_half(a, c, ca);
            add_half(c, b, bc);
        }
    }

    const RefinementScene& scene_;
    const DisplayOptions& options_;
    DisplaySurface& surface_;
    VertexLights& lights_;
    double floor_lx_, squared_shortest_m2_;
    std::unordered_map<std::uint64_t, std::uint32_t> middles_;        ///< vertices, by two vertices
    std::unordered_map<std::uint64_t, std::uint32_t> middle_places_;  ///< by two places
    std::unordered_set<std::uint64_t> marked_;                        ///< pairs of places
};

}  // namespace

void VertexLights::resize(std::size_t vertices) {
    lx.resize(vertices * lights);
    squared_error_lx2.resize(vertices);
    is_covered.resize(vertices);
}

double VertexLights::sum_lx(std::uint32_t vertex) const {
    double sum = 0;
    for (const float of_light : of(vertex)) sum += of_light;
    return sum;
}

void light_vertices(const RefinementScene& scene, const DisplaySurface& surface, std::size_t first,
                    const std::vector<std::vector<Adjoining>>& around, VertexLights& lights,
                    const Monitor& monitor) {
    constexpr std::size_t kChunk = 64;
    lights.resize(first + around.size());
    Stage stage(monitor, "direct light", (around.size() + kChunk - 1) / kChunk);
    parallel_for((around.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
        const std::size_t end = std::min((chunk + 1) * kChunk, around.size());
        for (std::size_t i = chunk * kChunk; i < end; ++i) {
            if (around[i].empty()) continue;
            const std::size_t v = first + i;
            const auto of_vertex = std::span(lights.lx).subspan(v * lights.lights, lights.lights);
            std::ranges::fill(of_vertex, 0.f);
            const auto& [position, normal, place] = surface.vertices[v];
            const auto result = scene.light.at(position, normal, around[i], of_vertex);
            lights.squared_error_lx2[v] = static_cast<float>(result.squared_error);
            lights.is_covered[v] = result.is_covered ? 1 : 0;
        }
        stage.advance();
    });
}

std::vector<float> refine(const RefinementScene& scene, const DisplayOptions& options, double typical_lx,
                          double extent_m, DisplaySurface& surface, VertexLights& lights,
                          const Monitor& monitor) {
    Refinement refinement(scene, options, typical_lx, extent_m, surface, lights);
    refinement.run(monitor);
    return refinement.interpolation_errors_lx();
}

}  // namespace stilb::walk
