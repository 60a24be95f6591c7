#include "walk/display/refinement.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "patches/refinement.h"

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

/// Numbers of pairs, by open addressing: several times faster than std::unordered_map.
class PairNumbers {
  public:
    explicit PairNumbers(std::size_t about = 16) : slots_(std::bit_ceil(2 * about)) {}

    /// The number of a pair, which is `number` where the pair is new.
    std::pair<std::uint32_t, bool> add(std::uint64_t pair, std::uint32_t number) {
        if (2 * ++count_ > slots_.size()) grow();
        Slot& slot = slot_of(pair);
        if (slot.number != kNoIndex) {
            --count_;
            return {slot.number, false};
        }
        slot = {pair, number};
        return {number, true};
    }
    /// kNoIndex where there is none.
    std::uint32_t of(std::uint64_t pair) const {
        return const_cast<PairNumbers*>(this)->slot_of(pair).number;
    }

  private:
    struct Slot {
        std::uint64_t pair = 0;
        std::uint32_t number = kNoIndex;
    };

    Slot& slot_of(std::uint64_t pair) {
        const std::size_t mask = slots_.size() - 1;
        std::uint64_t hash = pair * 0x9e3779b97f4a7c15u;
        std::size_t at = (hash ^ hash >> 32) & mask;
        while (slots_[at].number != kNoIndex && slots_[at].pair != pair) at = (at + 1) & mask;
        return slots_[at];
    }
    void grow() {
        std::vector<Slot> old(2 * slots_.size());
        old.swap(slots_);
        for (const Slot& slot : old) {
            if (slot.number != kNoIndex) slot_of(slot.pair) = slot;
        }
    }

    std::vector<Slot> slots_;
    std::size_t count_ = 0;
};

/// Two vertices, a < b, with the triangles on the edge between them.
struct SurfaceEdge {
    std::uint32_t a = 0, b = 0;
    std::uint32_t line = 0;  ///< equal for edges between the same places
    double squared_length_m2 = 0;
    std::uint32_t triangle = kNoIndex, other_triangle = kNoIndex;
    double area_m2 = 0;               ///< of its triangles
    std::uint32_t middle = kNoIndex;  ///< the vertex that would halve it, where its light is known
};

struct SurfaceEdges {
    std::vector<SurfaceEdge> edges;
    /// Per triangle: the edges from corner i to the next one.
    std::vector<std::array<std::uint32_t, 3>> of_triangle;
    std::uint32_t lines = 0;

    /// The corner where a triangle's longest edge begins.
    std::size_t longest(std::uint32_t triangle) const {
        const auto length_of = [&](std::uint32_t edge) { return edges[edge].squared_length_m2; };
        const auto& own = of_triangle[triangle];
        return static_cast<std::size_t>(std::ranges::max_element(own, {}, length_of) - own.begin());
    }
};

class Refinement {
  public:
    Refinement(const RefinementScene& scene, const DisplayOptions& options, double typical_lx,
               double extent_m, DisplaySurface& surface, VertexLights& lights)
        : scene_(scene),
          options_(options),
          surface_(surface),
          lights_(lights),
          floor_lx_(kFloor * typical_lx),
          squared_shortest_m2_(extent_m * options.shortest_edge * extent_m * options.shortest_edge) {
        for (const Object& object : scene.scene.objects)
            half_extents_m_.push_back(bounds_of(object.shape).half_extent());
    }

    void run(const Monitor& monitor) {
        edges_ = find_edges();
        if (surface_.triangles.size() > options_.most_triangles) return;
        while (run_round(monitor)) edges_ = find_edges();
    }

    std::vector<float> interpolation_errors_lx() const {
        std::vector<float> errors(surface_.vertices.size());
        for (const SurfaceEdge& edge : edges_.edges) {
            const auto error = static_cast<float>(error_lx(edge));
            for (const std::uint32_t end : {edge.a, edge.b}) errors[end] = std::max(errors[end], error);
        }
        return errors;
    }

  private:
    /// Returns false where nothing is left to do.
    bool run_round(const Monitor& monitor) {
        look_at_middles(edges_.edges, monitor);
        const std::size_t count = surface_.triangles.size();
        if (count >= options_.most_triangles) return false;
        const std::size_t affordable = (options_.most_triangles - count) / kTrianglesPerEdge;
        if (!mark_most_urgent(edges_, affordable)) return false;
        mark_longest_edges(edges_);
        divide(edges_);
        return true;
    }

    SurfaceEdges find_edges() const {
        SurfaceEdges all;
        PairNumbers numbers(2 * surface_.triangles.size()), lines(2 * surface_.triangles.size());
        for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
            const Triangle& corners = surface_.triangles[t].corners;
            const double area_m2 = surface_.area_m2(surface_.triangles[t]);
            auto& own = all.of_triangle.emplace_back();
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint64_t pair = patches::edge_key(corners[i], corners[(i + 1) % 3]);
                const auto next = static_cast<std::uint32_t>(all.edges.size());
                const auto [number, is_new] = numbers.add(pair, next);
                if (is_new) {
                    all.edges.push_back(new_edge(pair));
                    SurfaceEdge& edge = all.edges.back();
                    const auto [line, is_new_line] = lines.add(places_of(edge.a, edge.b), all.lines);
                    edge.line = line;
                    all.lines += is_new_line ? 1 : 0;
                }
                own[i] = number;
                SurfaceEdge& edge = all.edges[number];
                (edge.triangle == kNoIndex ? edge.triangle : edge.other_triangle) = t;
                edge.area_m2 += area_m2;
            }
        }
        return all;
    }

    SurfaceEdge new_edge(std::uint64_t pair) const {
        SurfaceEdge edge{static_cast<std::uint32_t>(pair >> 32), static_cast<std::uint32_t>(pair)};
        edge.squared_length_m2 = squared_length_m2(edge.a, edge.b);
        edge.middle = middles_.of(pair);
        return edge;
    }

    double squared_length_m2(std::uint32_t a, std::uint32_t b) const {
        return squared_length(surface_.vertices[a].position - surface_.vertices[b].position);
    }
    std::uint64_t places_of(std::uint32_t a, std::uint32_t b) const {
        return patches::edge_key(surface_.vertices[a].place, surface_.vertices[b].place);
    }

    // Middles.

    void look_at_middles(std::vector<SurfaceEdge>& edges, const Monitor& monitor) {
        const std::size_t first = surface_.vertices.size();
        std::vector<std::vector<Adjoining>> around;
        for (SurfaceEdge& edge : edges) {
            if (edge.middle != kNoIndex || edge.squared_length_m2 <= squared_shortest_m2_) continue;
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
        const auto [place, is_new] = middle_places_.add(patches::edge_key(a.place, b.place), surface_.places);
        if (is_new) ++surface_.places;
        vertex.place = place;
        surface_.vertices.push_back(vertex);
        middles_.add(patches::edge_key(edge.a, edge.b), middle);
        return middle;
    }

    std::vector<Adjoining> around_middle(const SurfaceEdge& edge) const {
        const SurfaceTriangle& one = surface_.triangles[edge.triangle];
        if (scene_.is_specular(one.side)) return {};
        if (edge.other_triangle == kNoIndex) return {{far_corner(one, edge), one.side}};
        const SurfaceTriangle& other = surface_.triangles[edge.other_triangle];
        return {{far_corner(one, edge), one.side},
                {far_corner(other, edge), other.side},
                {surface_.vertices[edge.a].position, one.side},
                {surface_.vertices[edge.b].position, one.side}};
    }

    const Vec3& far_corner(const SurfaceTriangle& triangle, const SurfaceEdge& edge) const {
        const auto is_far = [&](std::uint32_t corner) { return corner != edge.a && corner != edge.b; };
        return surface_.vertices[*std::ranges::find_if(triangle.corners, is_far)].position;
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

    /// How far the true surface lies beyond the edge, over the surface's radius.
    double bulge(const SurfaceEdge& edge) const {
        const auto &a = surface_.vertices[edge.a], &b = surface_.vertices[edge.b];
        const Vec3 straight = 0.5 * (a.position + b.position);
        const Vec3 offset = surface_.vertices[edge.middle].position - straight;
        if (squared_length(offset) == 0) return 0;
        const ObjectId object = scene_.object_of(surface_.triangles[edge.triangle].side);
        return length(offset) / half_extents_m_[index_of(object)];
    }

    // Halving.

    /// Marks the lines whose edges are to be halved: all that need it, or the most urgent ones. Returns false
    /// where there are none.
    bool mark_most_urgent(const SurfaceEdges& edges, std::size_t affordable) {
        struct Wish {
            double weight;
            std::uint32_t line;
        };
        std::vector<Wish> wishes;
        for (const SurfaceEdge& edge : edges.edges) {
            if (edge.middle == kNoIndex) continue;
            const double times = excess(edge);
            if (times > 1)
                wishes.push_back({times * edge.area_m2 * std::sqrt(edge.squared_length_m2), edge.line});
        }
        if (wishes.size() > affordable) {
            const auto is_before = [](const Wish& one, const Wish& other) {
                return one.weight != other.weight ? one.weight > other.weight : one.line < other.line;
            };
            std::ranges::nth_element(wishes, wishes.begin() + static_cast<std::ptrdiff_t>(affordable),
                                     is_before);
            wishes.resize(affordable);
        }
        is_marked_.assign(edges.lines, 0);
        for (const Wish& wish : wishes) is_marked_[wish.line] = 1;
        return !wishes.empty();
    }

    /// Marks the longest edge of each triangle with a marked edge, until no more follow.
    void mark_longest_edges(const SurfaceEdges& edges) {
        std::vector<std::size_t> longest;
        for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) longest.push_back(edges.longest(t));
        const auto mark = [&](std::uint32_t edge) -> std::uint8_t& {
            return is_marked_[edges.edges[edge].line];
        };
        for (bool is_changed = true; is_changed;) {
            is_changed = false;
            for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
                const auto& own = edges.of_triangle[t];
                if (mark(own[longest[t]]) || (!mark(own[0]) && !mark(own[1]) && !mark(own[2]))) continue;
                mark(own[longest[t]]) = 1;
                is_changed = true;
            }
        }
    }

    void divide(const SurfaceEdges& edges) {
        std::vector<SurfaceTriangle> finer;
        finer.reserve(2 * surface_.triangles.size());
        for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) divide(edges, t, finer);
        surface_.triangles = std::move(finer);
    }

    /// A corner of a triangle to be divided, or the middle of one of its edges.
    struct Corner {
        std::uint32_t vertex = kNoIndex;
        CornerWeights barycentric{};

        bool exists() const { return vertex != kNoIndex; }
    };

    Corner middle_of(const SurfaceEdge& edge, const Corner& a, const Corner& b) const {
        if (!is_marked_[edge.line]) return {};
        Corner middle{edge.middle};
        for (std::size_t i = 0; i < 3; ++i) middle.barycentric[i] = (a.barycentric[i] + b.barycentric[i]) / 2;
        return middle;
    }

    /// At its longest edge first, as patches are (patches/refinement.h).
    void divide(const SurfaceEdges& edges, std::uint32_t number, std::vector<SurfaceTriangle>& finer) const {
        const SurfaceTriangle& triangle = surface_.triangles[number];
        const std::size_t first = edges.longest(number);
        const auto corner = [&](std::size_t i) {
            const std::size_t turned = (first + i) % 3;
            return Corner{triangle.corners[turned], triangle.barycentric[turned]};
        };
        const auto edge = [&](std::size_t i) -> const SurfaceEdge& {
            return edges.edges[edges.of_triangle[number][(first + i) % 3]];
        };
        const Corner a = corner(0), b = corner(1), c = corner(2);
        const Corner ab = middle_of(edge(0), a, b), bc = middle_of(edge(1), b, c),
                     ca = middle_of(edge(2), c, a);
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
    std::vector<double> half_extents_m_;   ///< of the objects
    SurfaceEdges edges_;                   ///< of the surface as it is
    PairNumbers middles_;                  ///< vertices, by two vertices
    PairNumbers middle_places_;            ///< by two places
    std::vector<std::uint8_t> is_marked_;  ///< per line: its edges are to be halved
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
