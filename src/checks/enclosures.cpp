#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <utility>
#include <variant>

#include "checks/checks.h"
#include "checks/walks.h"

namespace stilb::checks {
namespace {

/// Unit vectors in general position: along no axis, diagonal or symmetry that rooms have.
constexpr std::array<Vec3, 3> kDirections{
    {{0.2673, 0.5345, 0.8018}, {-0.6851, 0.2114, 0.6971}, {0.4412, -0.7727, 0.4565}}};
/// Directions all around, the first upwards.
constexpr std::array<Vec3, 6> kAround{{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}};
/// Where rays of a disk start, beside its middle: at this share of the radius.
constexpr double kNearRim = 0.8;
/// Lights whose visibility is tested before the enclosure of a point is determined.
constexpr std::size_t kMostLightsTried = 8;

/// On a surface of size `size_m`.
SurfacePoint lifted_point(const Vec3& position, const Vec3& normal, double size_m,
                          const rays::RayCaster& caster) {
    return {position, normal, position + caster.offset_m(position, size_m) * normal};
}

/// Points of the front: one from every component, and more from other parts, because a lamp may stand half
/// in a wall.
struct StartsOnShape {
    const geometry::ConnectedComponents& components;
    const rays::RayCaster& caster;

    static constexpr std::size_t kMoreOfMesh = 8;

    std::vector<SurfacePoint> operator()(const Mesh& mesh) const {
        std::vector<SurfacePoint> points;
        const std::size_t count = mesh.triangles.size();
        const auto add = [&](std::size_t triangle) {
            const auto [a, b, c] = mesh.corners_of(triangle);
            const Vec3 normal = normalized(cross(b - a, c - a));
            points.push_back(lifted_point((a + b + c) / 3, normal, length(b - a) + length(c - a), caster));
        };
        for (std::size_t t = 0; t < count; ++t) {
            // Components are numbered by their first triangles.
            if (components.of_triangle[t] == points.size()) add(t);
        }
        const std::size_t more = std::min(count, kMoreOfMesh);
        for (std::size_t i = 0; i < more; ++i) add((2 * i + 1) * count / (2 * more));
        return points;
    }
    std::vector<SurfacePoint> operator()(const Instance& instance) const {
        return (*this)(triangulated(instance));
    }
    std::vector<SurfacePoint> operator()(const Rectangle& rectangle) const {
        return (*this)(triangulated(rectangle));
    }
    std::vector<SurfacePoint> operator()(const Box& box) const { return (*this)(triangulated(box)); }
    std::vector<SurfacePoint> operator()(const Sphere& sphere) const {
        std::vector<SurfacePoint> points;
        for (const Vec3& normal : kAround)
            points.push_back(
                lifted_point(sphere.center + sphere.radius * normal, normal, sphere.radius, caster));
        return points;
    }
    std::vector<SurfacePoint> operator()(const Harmonics& harmonics) const {
        std::vector<SurfacePoint> points;
        for (const Vec3& direction : kAround) {
            const Vec3 point = harmonics.point_towards(direction);
            points.push_back(lifted_point(point, harmonics.normal_towards(direction),
                                          length(point - harmonics.center), caster));
        }
        return points;
    }
    std::vector<SurfacePoint> operator()(const Disk& disk) const {
        std::vector<SurfacePoint> points{lifted_point(disk.center, disk.normal, disk.radius, caster)};
        const Frame frame = Frame::around(disk.normal);
        for (const Vec3& along : {frame.u, -frame.u, frame.v, -frame.v})
            points.push_back(
                lifted_point(disk.center + kNearRim * disk.radius * along, disk.normal, disk.radius, caster));
        return points;
    }
};

}  // namespace

Enclosures::Enclosures(const Scene& scene, const rays::RayCaster& caster,
                       std::shared_ptr<const SceneFindings> findings)
    : scene_(scene),
      caster_(caster),
      findings_(findings ? std::move(findings) : std::make_shared<const SceneFindings>(scene)) {
    for (const Light& light : scene.lights) {
        std::vector<Enclosure>& enclosures = of_lights_.emplace_back();
        if (location_of(light) == LightLocation::infinity)
            enclosures.push_back({});  // outside of all components
        for (const SurfacePoint& point : starts_of(light)) {
            const Enclosure enclosure = voted_enclosure(point);
            if (std::ranges::find(enclosures, enclosure) != enclosures.end()) continue;
            enclosures.push_back(enclosure);
            if (tried_.size() < kMostLightsTried) tried_.push_back({point.lifted, enclosure});
        }
    }
}

std::optional<ComponentId> Enclosures::closed_component(const rays::Crossing& crossing) const {
    ComponentId id{crossing.object, components()[index_of(crossing.object)].of_triangle[crossing.triangle]};
    if (const auto lamp = findings_->cut_lamps.find(crossing.object); lamp != findings_->cut_lamps.end()) {
        const std::uint32_t component = lamp->second.component_of_triangle[crossing.triangle];
        const bool is_part = component < components()[index_of(lamp->second.from)].count();
        if (is_part) id = {lamp->second.from, component};
    }
    const bool is_closed = components()[index_of(id.object)].is_closed(id.component);
    return is_closed ? std::optional(id) : std::nullopt;
}

std::vector<SurfacePoint> Enclosures::starts_of(const Light& light) const {
    if (const auto origin = lights::point_origin(light)) {
        if (!origin->axis) return {{origin->position, kDirections[0]}};
        return {lifted_point(origin->position, *origin->axis, caster_.lift().largest_size_m(), caster_)};
    }
    const auto surface = lights::emitting_object(light);
    if (!surface) return {};
    std::vector<SurfacePoint> starts =
        std::visit(StartsOnShape{components()[index_of(*surface)], caster_}, scene_.object(*surface).shape);
    // An opening may reach through the walls around its luminaire.
    if (const Luminaire* luminaire = lights::luminaire_of(light)) {
        starts.push_back(lifted_point(luminaire->position, starts.front().normal,
                                      caster_.lift().largest_size_m(), caster_));
    }
    return starts;
}

Enclosure Enclosures::crossed_an_odd_number_of_times(const Vec3& origin, const Vec3& direction) const {
    Enclosure crossed;
    for (const rays::Crossing& crossing : caster_.crossings(origin, direction)) {
        const auto component = closed_component(crossing);
        // Glass encloses nothing.
        if (component && !transmits(scene_.material(crossing.material))) crossed.push_back(*component);
    }
    std::sort(crossed.begin(), crossed.end());
    Enclosure odd;
    for (auto first = crossed.begin(); first != crossed.end();) {
        const auto last = std::upper_bound(first, crossed.end(), *first);
        if ((last - first) % 2 != 0) odd.push_back(*first);
        first = last;
    }
    return odd;
}

Enclosure Enclosures::voted_enclosure(const SurfacePoint& point) const {
    std::array<Enclosure, 3> votes;
    for (std::size_t i = 0; i < votes.size(); ++i) {
        const Vec3& d = kDirections[i];
        const bool is_outwards = dot(d, point.normal) > 0;
        votes[i] = crossed_an_odd_number_of_times(point.lifted, is_outwards ? d : -d);
    }
    Enclosure enclosure;
    const auto add_common = [&](const Enclosure& a, const Enclosure& b) {
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(enclosure));
    };
    add_common(votes[0], votes[1]);
    add_common(votes[0], votes[2]);
    add_common(votes[1], votes[2]);
    std::sort(enclosure.begin(), enclosure.end());
    enclosure.erase(std::unique(enclosure.begin(), enclosure.end()), enclosure.end());
    return enclosure;
}

Enclosure Enclosures::enclosure_of(const SurfacePoint& point) const {
    const auto seen = std::find_if(tried_.begin(), tried_.end(), [&](const TriedLight& light) {
        return !caster_.occluded(point.lifted, light.position);
    });
    return seen != tried_.end() ? seen->enclosure : voted_enclosure(point);
}

bool Enclosures::is_lit(const Enclosure& enclosure) const {
    return std::any_of(of_lights_.begin(), of_lights_.end(), [&](const std::vector<Enclosure>& enclosures) {
        return std::find(enclosures.begin(), enclosures.end(), enclosure) != enclosures.end();
    });
}

}  // namespace stilb::checks
