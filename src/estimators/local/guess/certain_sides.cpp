#include "estimators/local/guess/certain_sides.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace stilb::estimators {
namespace {

/// Queries for each group, on average: a fraction of a millisecond for about a hundred.
constexpr std::size_t kQueriesPerGroup = 150;

void include(Bounds& bounds, const Bounds& part) {
    bounds.include(part.min);
    bounds.include(part.max);
}

std::vector<Vec3> corners_of(const Bounds& box) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner{(i & 1 ? box.max : box.min).x, (i & 2 ? box.max : box.min).y,
                          (i & 4 ? box.max : box.min).z};
        if (std::ranges::find(corners, corner) == corners.end()) corners.push_back(corner);
    }
    return corners;
}

/// The largest product of vectors in two boxes.
double largest_dot(const Bounds& a, const Bounds& b) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
        sum += std::max({a.min[i] * b.min[i], a.min[i] * b.max[i], a.max[i] * b.min[i], a.max[i] * b.max[i]});
    return sum;
}

/// A polygon of up to five corners.
struct Polygon {
    std::array<Vec3, 8> corners{};
    std::size_t count = 0;
};

/// The part of a convex polygon where dot(up, p) is at least `lowest`.
Polygon part_above(std::span<const Vec3> polygon, const Vec3& up, double lowest) {
    Polygon part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double above_p = dot(up, p) - lowest, above_q = dot(up, q) - lowest;
        if (above_p >= 0) part.corners[part.count++] = p;
        if ((above_p < 0) != (above_q < 0))
            part.corners[part.count++] = p + (above_p / (above_p - above_q)) * (q - p);
    }
    return part;
}

}  // namespace

CertainSides::CertainSides(const Scene& scene, const LightGuess& guess, const rays::RayCaster& caster)
    : guess_(guess),
      lift_m_(caster.lift().common_offset_m()),
      shafts_(scene, caster.center()),
      sides_(guess.lit_sides()) {
    const auto end = static_cast<std::uint32_t>(sides_.size());
    for (std::uint32_t first = 0, last = 0; first < end; first = last) {
        while (last < end && are_in_one_plane(sides_[first], sides_[last])) ++last;
        add_plane(first, last);
    }
}

bool CertainSides::are_in_one_plane(std::uint32_t side, std::uint32_t other) const {
    const patches::Patches& patches = guess_.patches();
    if (side == other) return true;
    const Vec3 normal = patches.normal_of(side), other_normal = patches.normal_of(other);
    const Vec3 offset = patches.middle(patches.patch_of(other)) - patches.middle(patches.patch_of(side));
    constexpr double rounding = 1e-6;
    return length(normal - other_normal) < rounding && std::abs(dot(normal, offset)) < lift_m_ / 16;
}

void CertainSides::add_plane(std::uint32_t first, std::uint32_t last) {
    const patches::Patches& patches = guess_.patches();
    const auto& corners = patches.corners[patches.patch_of(sides_[first])];
    const Vec3 normal = normalized(patches.normal_of(sides_[first]));
    const Vec3 edge{Vec3(patches.vertices[corners[1]]) - Vec3(patches.vertices[corners[0]])};
    const Vec3 along = normalized(edge - dot(edge, normal) * normal);
    planes_.push_back(static_cast<std::uint32_t>(clusters_.size()));
    clusters_.push_back({first, last});
    divide(planes_.back(), {along, cross(normal, along), normal});
}

/// The triangle of a single side, all of whose edges move in by the lift.
void CertainSides::set_triangle(Cluster& cluster) const {
    const patches::Patches& patches = guess_.patches();
    const std::uint32_t side = sides_[cluster.first], patch = patches.patch_of(side);
    std::array<Vec3, 3> points;
    for (std::size_t c = 0; c < 3; ++c)
        points[c] = patches.center + Vec3(patches.vertices[patches.corners[patch][c]]);
    double around_m = 0;
    Vec3 incenter;
    for (std::size_t c = 0; c < 3; ++c) {
        const double opposite_m = length(points[(c + 1) % 3] - points[(c + 2) % 3]);
        around_m += opposite_m;
        incenter += opposite_m * points[c];
    }
    incenter = incenter / around_m;
    const double inradius_m = 2 * double{patches.areas_m2[patch]} / around_m;
    const double scale = std::max(0.0, 1 - lift_m_ / inradius_m);
    for (std::size_t c = 0; c < 3; ++c)
        cluster.corners[c] = incenter + scale * (points[c] - incenter) + lift_m_ * patches.normal_of(side);
    cluster.corner_count = 3;
}

/// Sets the polygon, a rectangle of the frame around several sides, and divides them at their median.
void CertainSides::divide(std::uint32_t number, const Frame& frame) {
    const auto [first, last] = std::pair(clusters_[number].first, clusters_[number].last);
    if (last - first == 1) return set_triangle(clusters_[number]);
    const patches::Patches& patches = guess_.patches();
    Bounds bounds, middles;
    for (std::uint32_t i = first; i < last; ++i) {
        const std::uint32_t patch = patches.patch_of(sides_[i]);
        for (const std::uint32_t corner : patches.corners[patch])
            bounds.include(frame.to_local(Vec3(patches.vertices[corner])));
        middles.include(frame.to_local(patches.middle(patch) - patches.center));
    }
    const double z = bounds.max.z + lift_m_;
    const double left = bounds.min.x + lift_m_, right = bounds.max.x - lift_m_;
    const double low = bounds.min.y + lift_m_, high = bounds.max.y - lift_m_;
    const std::array<Vec3, 4> local{{{left, low, z}, {right, low, z}, {right, high, z}, {left, high, z}}};
    for (std::size_t c = 0; c < 4; ++c)
        clusters_[number].corners[c] = patches.center + frame.to_world(local[c]);
    const Vec3 extent = middles.max - middles.min;
    const Vec3& axis = extent.x > extent.y ? frame.u : frame.v;
    const auto place = [&](std::uint32_t side) { return dot(axis, patches.middle(patches.patch_of(side))); };
    const std::uint32_t half = (first + last) / 2;
    std::nth_element(sides_.begin() + first, sides_.begin() + half, sides_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
    const auto children = static_cast<std::uint32_t>(clusters_.size());
    clusters_[number].children = children;
    clusters_.push_back({first, half});
    clusters_.push_back({half, last});
    divide(children, frame);
    divide(children + 1, frame);
}

/// Blocks of receivers against clusters of sides.
class CertainSides::Search {
  public:
    Search(const CertainSides& sides, std::span<const Group> groups) : sides_(sides), groups_(groups) {
        blocks_.emplace_back();
        make_block(0, 0, groups.size());
    }

    std::vector<Sights> run() {
        std::vector<Sights> sights(groups_.size(), Sights(2 * sides_.guess_.patches().count()));
        // Wide pairs first.
        std::queue<Pair> open;
        for (const std::uint32_t plane : sides_.planes_) open.push({0, plane});
        for (; !open.empty() && queries_ < kQueriesPerGroup * groups_.size(); open.pop()) {
            const Pair& pair = open.front();
            const Sight sight = sight_of(blocks_[pair.block], sides_.clusters_[pair.cluster]);
            if (sight == Sight::uncertain) {
                divide(Pair(pair), open);
            } else {
                set(pair, sight, sights);
            }
        }
        return sights;
    }

  private:
    /// Receivers of neighbouring groups: boxes around their points and their normals.
    struct Block {
        std::size_t first = 0, last = 0;  ///< groups
        std::size_t children = 0;         ///< the first of two; 0: none
        Bounds lifted, normals, points;   ///< `points`: lifted and not
        std::vector<Vec3> corners;        ///< of the box around the lifted points
        std::vector<Vec3> point_corners;

        bool has_one_normal() const { return normals.min == normals.max; }
        double size_m() const { return length(lifted.max - lifted.min); }
    };
    struct Pair {
        std::size_t block = 0;
        std::uint32_t cluster = 0;
    };

    void make_block(std::size_t number, std::size_t first, std::size_t last) {
        Block block{first, last, 0, {}, {}, {}, {}, {}};
        if (last - first == 1) {
            for (const transport::Receiver& receiver : groups_[first]) {
                block.lifted.include(receiver.lifted());
                block.points.include(receiver.lifted());
                block.points.include(receiver.position());
                block.normals.include(receiver.normal());
            }
        } else {
            block.children = blocks_.size();
            blocks_.resize(blocks_.size() + 2);
            make_block(block.children, first, (first + last) / 2);
            make_block(block.children + 1, (first + last) / 2, last);
            for (const std::size_t child : {block.children, block.children + 1}) {
                include(block.lifted, blocks_[child].lifted);
                include(block.points, blocks_[child].points);
                include(block.normals, blocks_[child].normals);
            }
        }
        block.corners = corners_of(block.lifted);
        block.point_corners = corners_of(block.points);
        blocks_[number] = std::move(block);
    }

    Sight sight_of(const Block& block, const Cluster& cluster) {
        ++queries_;
        // Receivers in the plane, too: they get nothing, and the closed form does not hold there. Where
        // planes meet, their lifted points are in front of it.
        const double near_m = 4 * sides_.lift_m_;
        const Vec3 normal = sides_.guess_.patches().normal_of(sides_.sides_[cluster.first]);
        const std::span<const Vec3> polygon = cluster.polygon();
        const auto is_in_front = [&](const Vec3& corner) {
            return dot(normal, corner - polygon[0]) > near_m;
        };
        const bool is_behind = std::ranges::none_of(block.point_corners, is_in_front);
        const bool is_below = std::ranges::all_of(polygon, [&](const Vec3& corner) {
            return largest_dot(block.normals, {corner - block.lifted.max, corner - block.lifted.min}) <
                   -near_m;
        });
        if (is_behind || is_below) return Sight::none;
        if (!std::ranges::all_of(block.point_corners, is_in_front)) return Sight::uncertain;
        const bool is_empty = block.has_one_normal() ? is_empty_above_horizons(block, polygon)
                                                     : sides_.shafts_.is_empty(block.corners, polygon, {});
        return is_empty ? Sight::certain : Sight::uncertain;
    }

    /// Surfaces below the horizons are ignored: they hide nothing that the receivers see.
    bool is_empty_above_horizons(const Block& block, std::span<const Vec3> polygon) const {
        const Vec3& up = block.normals.min;
        double lowest = dot(up, block.corners[0]);
        for (const Vec3& corner : block.corners) lowest = std::min(lowest, dot(up, corner));
        const Polygon part = part_above(polygon, up, lowest - sides_.lift_m_);
        return part.count > 0 &&
               sides_.shafts_.is_empty(block.corners, std::span(part.corners).first(part.count), {});
    }

    void set(const Pair& pair, Sight sight, std::vector<Sights>& sights) const {
        const Block& block = blocks_[pair.block];
        const Cluster& cluster = sides_.clusters_[pair.cluster];
        for (std::size_t group = block.first; group < block.last; ++group) {
            for (std::uint32_t i = cluster.first; i < cluster.last; ++i) {
                const std::uint32_t side = sides_.sides_[i];
                // Places of a side that another surface owns are not seen.
                const bool is_whole = !sides_.guess_.shared_places().shares(side);
                if (is_whole || sight == Sight::none) sights[group][side] = sight;
            }
        }
    }

    /// The larger of the two.
    void divide(const Pair& pair, std::queue<Pair>& open) const {
        const Block& block = blocks_[pair.block];
        const Cluster& cluster = sides_.clusters_[pair.cluster];
        const double cluster_size_m = length(cluster.corners[2] - cluster.corners[0]);
        if (cluster.children != 0 && (block.children == 0 || cluster_size_m > block.size_m())) {
            open.push({pair.block, cluster.children});
            open.push({pair.block, cluster.children + 1});
        } else if (block.children != 0) {
            open.push({block.children, pair.cluster});
            open.push({block.children + 1, pair.cluster});
        }
    }

    const CertainSides& sides_;
    std::span<const Group> groups_;
    std::vector<Block> blocks_;
    std::size_t queries_ = 0;
};

std::vector<Sights> CertainSides::find(std::span<const Group> groups) const {
    if (groups.empty()) return {};
    return Search(*this, groups).run();
}

}  // namespace stilb::estimators
