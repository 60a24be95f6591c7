#include "lights/solid_angle/seen_polygon.h"

#include <algorithm>
#include <cmath>

namespace stilb::lights {
namespace {

/// Edges whose planes contain the zenith up to this cosine bound no area.
constexpr double kRadial = 1e-14;
/// The share of its area to which a sector is divided.
constexpr double kPrecision = 1e-11;

}  // namespace

struct SeenPolygon::Azimuth {
    double x = 1, y = 0;

    static Azimuth of(const Vec3& v) {
        const double size = std::sqrt(v.x * v.x + v.y * v.y);
        return size > 0 ? Azimuth{v.x / size, v.y / size} : Azimuth{};
    }
    /// Counterclockwise.
    double angle_to(const Azimuth& other) const {
        return std::atan2(x * other.y - y * other.x, x * other.x + y * other.y);
    }
};

/// The area between the zenith and a great circle, which is an ellipse in the projection, by the azimuth
/// from a start on.
class SeenPolygon::EllipseSector {
  public:
    EllipseSector() = default;
    /// `normal`: of the circle's plane.
    EllipseSector(const Vec3& normal, const Azimuth& start)
        : z_(std::abs(normal.z)),
          along_(normal.x * start.x + normal.y * start.y),
          across_(normal.y * start.x - normal.x * start.y) {}

    double area(double sine, double cosine) const {
        return z_ / 2 * std::atan2(z_ * sine, (z_ * z_ + along_ * along_) * cosine + along_ * across_ * sine);
    }
    double squared_radius(double sine, double cosine) const {
        if (z_ == 0) return 0;
        const double height = along_ * cosine + across_ * sine;
        return z_ * z_ / (z_ * z_ + height * height);
    }

  private:
    double z_ = 0, along_ = 0, across_ = 0;
};

/// A part of the projection between two azimuths with one outer and at most one inner edge.
struct SeenPolygon::Sector {
    Azimuth start;
    double span = 0;
    EllipseSector outer, inner;
    double area = 0;

    double area_to(double sine, double cosine) const {
        return outer.area(sine, cosine) - inner.area(sine, cosine);
    }
    double area_to(double angle) const { return area_to(std::sin(angle), std::cos(angle)); }
    double density(double sine, double cosine) const {
        return (outer.squared_radius(sine, cosine) - inner.squared_radius(sine, cosine)) / 2;
    }
    /// The angle from the start that cuts off a part of the area: Newton's method between bounds, from the
    /// root of a linear density.
    double angle_of(double part) const {
        const double at_start = density(0, 1), at_end = density(std::sin(span), std::cos(span));
        const double root =
            std::sqrt(std::max(0.0, at_start * at_start + 2 * (at_end - at_start) / span * part));
        double low = 0, high = span;
        double angle = std::clamp(at_start + root > 0 ? 2 * part / (at_start + root) : 0.0, low, high);
        constexpr int most_steps = 60;
        for (int step = 0; step < most_steps; ++step) {
            const double sine = std::sin(angle), cosine = std::cos(angle);
            const double excess = area_to(sine, cosine) - part;
            if (std::abs(excess) <= kPrecision * area) break;
            (excess > 0 ? high : low) = angle;
            angle -= excess / density(sine, cosine);
            if (!(angle > low && angle < high)) angle = (low + high) / 2;
        }
        return angle;
    }
    Vec3 direction(double angle, double u) const {
        const double sine = std::sin(angle), cosine = std::cos(angle);
        const double inside = inner.squared_radius(sine, cosine);
        const double squared = inside + u * (outer.squared_radius(sine, cosine) - inside);
        const double radius = std::sqrt(squared);
        return {radius * (start.x * cosine - start.y * sine), radius * (start.y * cosine + start.x * sine),
                std::sqrt(std::max(0.0, 1 - squared))};
    }
};

struct SeenPolygon::Sectors {
    std::array<Sector, 2 * (kMostVertices + 1)> list;
    std::size_t count = 0;
    double area = 0;
};

SeenPolygon::SeenPolygon(std::span<const Vec3> vertices) {
    const auto add = [&](const Vec3& vertex) { vertices_[count_++] = vertex; };
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vec3& from = vertices[i];
        const Vec3& to = vertices[i + 1 == vertices.size() ? 0 : i + 1];
        if (from.z > 0) add(from);
        if ((from.z > 0) != (to.z > 0)) {
            const Vec3 crossing = from + from.z / (from.z - to.z) * (to - from);
            add({crossing.x, crossing.y, 0});
        }
    }
    double sum = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        const Vec3& from = vertices_[i];
        const Vec3& to = vertices_[next(i)];
        const Vec3 across = cross(from, to - from);
        const double sine = length(across);
        if (sine == 0) continue;
        Edge& edge = edges_[i];
        edge.normal = across / sine;
        sum += std::atan2(sine, dot(from, to)) * edge.normal.z;
        if (std::abs(edge.normal.z) <= kRadial) edge.normal.z = 0;
        has_inner_ = has_inner_ || edge.is_inner();
    }
    projected_sr_ = std::max(0.0, sum / 2);
}

SeenPolygon::Sectors SeenPolygon::sectors() const {
    Sectors sectors;
    const auto add = [&](const Azimuth& start, double span, std::size_t outer, const Vec3& inner) {
        if (!(span > 0)) return;
        Sector& sector = sectors.list[sectors.count];
        sector = {start, span, {edges_[outer].normal, start}, {inner, start}};
        sectors.area += sector.area = std::max(0.0, sector.area_to(span));
        if (sector.area > 0) ++sectors.count;
    };
    if (!has_inner_) {  // the zenith is in the polygon or on its rim
        for (std::size_t i = 0; i < count_; ++i) {
            if (!edges_[i].is_outer()) continue;
            const Azimuth start = Azimuth::of(vertices_[i]);
            add(start, start.angle_to(Azimuth::of(vertices_[next(i)])), i, {});
        }
        return sectors;
    }
    // Outer and inner edges are two chains from the smallest azimuth to the largest.
    std::size_t outer = 0;
    while (outer + 1 < count_ && !(edges_[outer].is_outer() && !edges_[previous(outer)].is_outer())) ++outer;
    std::size_t inner = previous(outer);
    while (!edges_[inner].is_inner() && inner != outer) inner = previous(inner);
    Azimuth start = Azimuth::of(vertices_[outer]);
    while (edges_[outer].is_outer() && edges_[inner].is_inner()) {
        const Azimuth outer_end = Azimuth::of(vertices_[next(outer)]),
                      inner_end = Azimuth::of(vertices_[inner]);
        const double outer_span = start.angle_to(outer_end), inner_span = start.angle_to(inner_end);
        add(start, std::min(outer_span, inner_span), outer, edges_[inner].normal);
        if (outer_span <= inner_span) {
            start = outer_end, outer = next(outer);
        } else {
            start = inner_end, inner = previous(inner);
        }
    }
    return sectors;
}

std::optional<Vec3> SeenPolygon::sample(double u1, double u2) const {
    const Sectors sectors = this->sectors();
    if (sectors.count == 0) return std::nullopt;
    double part = u1 * sectors.area;
    const Sector* sector = sectors.list.data();
    const Sector* const last = sector + sectors.count - 1;
    for (; sector != last && part >= sector->area; ++sector) part -= sector->area;
    return sector->direction(sector->angle_of(std::min(part, sector->area)), u2);
}

}  // namespace stilb::lights
