#include "checks/spaces.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace stilb {
namespace {

/// Unit vectors in general position: along no axis, diagonal or symmetry that rooms have.
constexpr std::array<Vec3, 3> kDirections{
    {{0.2673, 0.5345, 0.8018}, {-0.6851, 0.2114, 0.6971}, {0.4412, -0.7727, 0.4565}}};
/// Rays through more surfaces than this say nothing.
constexpr int kMostCrossings = 10'000;
/// Lights that a point is tried to see before its space is found out.
constexpr std::size_t kMostLightsTried = 8;

/// Off the surface at `position` on the side of the unit vector `normal`.
Outlook outlook_off(const Vec3& position, const Vec3& normal, double size_m, const RayCaster& caster) {
    return {position + caster.offset_m(position, size_m) * normal, normal};
}

/// One from every shell, off its front.
struct OutlooksOfShape {
    const Shells& shells;
    const RayCaster& caster;

    std::vector<Outlook> operator()(const Mesh& mesh) const {
        std::vector<Outlook> outlooks;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            if (shells.of_triangle[t] != outlooks.size()) continue;  // numbered by their first triangles
            const auto [i, j, k] = mesh.triangles[t];
            const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
            const Vec3 normal = normalized(cross(b - a, c - a));
            outlooks.push_back(outlook_off((a + b + c) / 3, normal, length(b - a) + length(c - a), caster));
        }
        return outlooks;
    }
    std::vector<Outlook> operator()(const Rectangle& rectangle) const {
        return (*this)(triangulated(rectangle));
    }
    std::vector<Outlook> operator()(const Box& box) const { return (*this)(triangulated(box)); }
    std::vector<Outlook> operator()(const Sphere& sphere) const {
        const Vec3 up{0, 0, 1};
        return {outlook_off(sphere.center + sphere.radius * up, up, sphere.radius, caster)};
    }
    std::vector<Outlook> operator()(const Harmonics& harmonics) const {
        const Vec3 up{0, 0, 1}, top = harmonics.point_towards(up);
        return {outlook_off(top, harmonics.normal_towards(up), length(top - harmonics.center), caster)};
    }
    std::vector<Outlook> operator()(const Disk& disk) const {
        return {outlook_off(disk.center, disk.normal, disk.radius, caster)};
    }
};

}  // namespace

Spaces::Spaces(const Scene& scene, const RayCaster& caster) : scene_(scene), caster_(caster) {
    for (const Object& object : scene.objects) shells_.push_back(find_shells(object.shape));
    for (const Light& light : scene.lights) {
        std::vector<Space>& spaces = of_lights_.emplace_back();
        for (const Outlook& outlook : outlooks_of(light)) {
            spaces.push_back(voted_space(outlook));
            if (tried_.size() < kMostLightsTried) tried_.push_back({outlook.position, spaces.back()});
        }
    }
}

std::vector<Outlook> Spaces::outlooks_of(const Light& light) const {
    if (const auto* point = std::get_if<PointLight>(&light.source))
        return {{point->position, kDirections[0]}};
    if (const auto* luminaire = std::get_if<PhotometryLight>(&light.source))
        return {outlook_off(luminaire->position, luminaire->nadir, caster_.half_extent_m(), caster_)};
    const ObjectId object = std::get<AreaLight>(light.source).object;
    return std::visit(OutlooksOfShape{shells_[index_of(object)], caster_}, scene_.object(object).shape);
}

Space Spaces::crossed_an_odd_number_of_times(const Vec3& origin, const Vec3& direction) const {
    Space crossed;
    Vec3 from = origin;
    for (int i = 0; i < kMostCrossings; ++i) {
        const auto hit = caster_.closest(from, direction);
        if (!hit) break;
        const Shells& shells = shells_[index_of(hit->object)];
        const std::uint32_t shell = shells.of_triangle[hit->triangle];
        if (shells.is_closed(shell)) crossed.push_back({hit->object, shell});
        from = hit->position - (hit->lifted - hit->position);  // just behind the surface
    }
    std::sort(crossed.begin(), crossed.end());
    Space odd;
    for (auto first = crossed.begin(); first != crossed.end();) {
        const auto last = std::upper_bound(first, crossed.end(), *first);
        if ((last - first) % 2 != 0) odd.push_back(*first);
        first = last;
    }
    return odd;
}

Space Spaces::voted_space(const Outlook& outlook) const {
    std::array<Space, 3> votes;
    for (std::size_t i = 0; i < votes.size(); ++i) {
        const Vec3& d = kDirections[i];
        const bool is_outwards = dot(d, outlook.direction) > 0;
        votes[i] = crossed_an_odd_number_of_times(outlook.position, is_outwards ? d : -d);
    }
    Space space;
    const auto add_common = [&](const Space& a, const Space& b) {
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(space));
    };
    add_common(votes[0], votes[1]);
    add_common(votes[0], votes[2]);
    add_common(votes[1], votes[2]);
    std::sort(space.begin(), space.end());
    space.erase(std::unique(space.begin(), space.end()), space.end());
    return space;
}

Space Spaces::space_of(const Outlook& outlook) const {
    const auto seen = std::find_if(tried_.begin(), tried_.end(), [&](const LightPlace& light) {
        return !caster_.occluded(outlook.position, light.position);
    });
    return seen != tried_.end() ? seen->space : voted_space(outlook);
}

bool Spaces::is_lit(const Space& space) const {
    return std::any_of(of_lights_.begin(), of_lights_.end(), [&](const std::vector<Space>& spaces) {
        return std::find(spaces.begin(), spaces.end(), space) != spaces.end();
    });
}

}  // namespace stilb
