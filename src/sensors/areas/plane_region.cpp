#include "sensors/areas/plane_region.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stilb::sensors {
namespace {

/// Twice the signed area of a triangle.
double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

struct Edge {
    PlanePoint from, to;
};

Edge edge_of(const Ring& ring, std::size_t i) { return {ring[i], ring[(i + 1) % ring.size()]}; }

double distance_to(const Edge& edge, const PlanePoint& p) {
    const double dx = edge.to.x - edge.from.x, dy = edge.to.y - edge.from.y;
    const double along = ((p.x - edge.from.x) * dx + (p.y - edge.from.y) * dy) / (dx * dx + dy * dy);
    const double t = std::clamp(along, 0.0, 1.0);
    return std::hypot(edge.from.x + t * dx - p.x, edge.from.y + t * dy - p.y);
}

/// Whether the edges have a point in common.
bool meet(const Edge& a, const Edge& b) {
    const auto separates = [](const Edge& line, const Edge& other) {
        return turn(line.from, line.to, other.from) * turn(line.from, line.to, other.to) > 0;
    };
    if (separates(a, b) || separates(b, a)) return false;
    // Edges on one line overlap where their extents do.
    const auto overlap = [](double a0, double a1, double b0, double b1) {
        return std::max(std::min(a0, a1), std::min(b0, b1)) <= std::min(std::max(a0, a1), std::max(b0, b1));
    };
    return overlap(a.from.x, a.to.x, b.from.x, b.to.x) && overlap(a.from.y, a.to.y, b.from.y, b.to.y);
}

/// Neighbouring edges have a corner in common, and overlap where the outline turns back.
bool are_neighbours(std::size_t i, std::size_t j, std::size_t count) {
    return (i + 1) % count == j || (j + 1) % count == i;
}

bool turns_back(const Ring& ring, std::size_t corner) {
    const std::size_t n = ring.size();
    const PlanePoint &a = ring[(corner + n - 1) % n], &b = ring[corner], &c = ring[(corner + 1) % n];
    return turn(a, b, c) == 0 && (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y) <= 0;
}

std::optional<std::string> fault_of_ring(const Ring& ring) {
    if (ring.size() < 3) return fmt::format("has {} corners. Allowed: 3 or more.", ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
        if (turns_back(ring, i))
            return fmt::format("turns back at corner {}, counted from 0. Allowed: a simple polygon.", i);
        for (std::size_t j = 0; j < i; ++j) {
            if (are_neighbours(i, j, ring.size()) || !meet(edge_of(ring, i), edge_of(ring, j))) continue;
            return fmt::format(
                "crosses or touches itself: the edges from corners {} and {}, counted from 0, meet. Allowed: "
                "a simple polygon.",
                j, i);
        }
    }
    return std::nullopt;
}

bool meet(const Ring& a, const Ring& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j) {
            if (meet(edge_of(a, i), edge_of(b, j))) return true;
        }
    }
    return false;
}

}  // namespace

double doubled_area(const Ring& ring) {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum += turn(ring[0], ring[i], ring[i + 1]);
    return sum;
}

bool contains(const Ring& ring, const PlanePoint& p, double margin_m) {
    bool is_inside = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const auto [a, b] = edge_of(ring, i);
        // The edge crosses the ray from the point towards +x.
        const bool is_crossed =
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
        if (is_crossed) is_inside = !is_inside;
    }
    return is_inside || distance_to(ring, p) <= margin_m;
}

double distance_to(const Ring& ring, const PlanePoint& p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ring.size(); ++i) least = std::min(least, distance_to(edge_of(ring, i), p));
    return least;
}

std::optional<RegionFault> fault_of(const Region& region) {
    for (std::size_t r = 0; r < region.size(); ++r) {
        if (auto message = fault_of_ring(region[r])) return RegionFault{r, std::move(*message)};
        for (std::size_t other = 0; other < r; ++other) {
            const bool is_outline = other == 0;
            const bool is_apart = !meet(region[r], region[other]) &&
                                  contains(region[other], region[r].front(), 0) == is_outline &&
                                  (is_outline || !contains(region[r], region[other].front(), 0));
            if (is_apart) continue;
            return RegionFault{r, is_outline
                                      ? "is not inside the outline. Allowed: a hole that touches no edge."
                                      : fmt::format("meets hole {}. Allowed: separate holes.", other - 1)};
        }
    }
    return std::nullopt;
}

}  // namespace stilb::sensors
