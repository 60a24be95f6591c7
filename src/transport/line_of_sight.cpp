
#include "transport/line_of_sight.h"

#include <algorithm>

#include "materials/solid.h"
#include "sensors/place.h"
#include "transport/lobe_choice.h"

namespace stilb::transport {

namespace {

/// Share of the luminance below which a branch is not followed.
constexpr double kLeastTransmission = 0.005;
/// The limit of interactions, because light can be trapped in glass.
constexpr int kMostFollowed = 32;

/// The first surface along a ray, where light can be measured on it.
std::optional<rays::Hit> first_met(const Vec3& origin, const Vec3& direction, const rays::RayCaster& caster) {
    const auto hit = caster.closest(origin, direction);
    if (!hit || is_specular(caster.scene().material(hit->material))) return hit;
    return sensors::clear_of_walls(*hit, origin, caster);
}

class LineOfSightFollower {
  public:
    LineOfSightFollower(const Scene& scene, const rays::RayCaster& caster, const LightSampler& lights,
                        int max_reflections)
        : scene_(scene), caster_(caster), lights_(lights), max_reflections_(max_reflections) {}

    /// `hit` is seen along `direction`.
    void follow(const rays::Hit& hit, const Vec3& direction, const Rgb& transmission, int reflections) {
        lights_.for_each_emission(hit, -direction, [&](std::size_t light, const Rgb& luminance) {
            add(transmission * luminance, light, reflections);
        });
        const Material& material = scene_.material(hit.material);
        const std::span<const materials::Lobe> lobes = lobes_at(hit, material, Carried::luminance);
        if (lobes.empty()) return follow(material, {hit, -direction, transmission, reflections});
        for (const materials::Lobe& lobe : lobes) {
            SubPoint point{hit, -direction, transmission * lobe.factor(Carried::luminance), reflections,
                           &lobe};
            cross(lobe, point.surface, point.outgoing);
            follow(lobe.scattering, point);
        }
    }

    /// `scattering`: of the point, its material or its lobe.
    void follow(const Material& scattering, const SubPoint& point) {
        if (!is_specular(scattering)) {
            sight.sub_points.push_back(point);
            return;
        }
        const auto& [hit, outgoing, transmission, reflections, lobe] = point;
        for (const SpecularRay& branch : specular_rays(scattering, hit, outgoing)) {
            const int met = reflections + (branch.straight ? 0 : 1);
            if (met > max_reflections_) {
                if (!sight.end) sight.end = hit.position;
                continue;
            }
            const Rgb left = transmission * branch.share * branch.luminance_factor;
            if (left.max() < kLeastTransmission || met > kMostFollowed) {
                sight.faint.push_back({branch.origin, branch.direction, left, met});
            } else if (const auto next = first_met(branch.origin, branch.direction, caster_)) {
                follow(*next, branch.direction, left, met);
            } else {
                add_outside(branch.direction, left, met);
            }
        }
    }

    void add_outside(const Vec3& direction, const Rgb& transmission, int reflections) {
        if (lights_.has_light_from_outside())
            add(transmission * lights_.outside_luminance(direction), lights_.light_from_outside(),
                reflections);
    }

    VisibleSurfaces sight;

  private:
    void add(const Rgb& value, std::size_t light, int reflections) {
        add_part(value, light, reflections, sight.emission_cd_m2, &sight.parts);
    }

    const Scene& scene_;
    const rays::RayCaster& caster_;
    const LightSampler& lights_;
    int max_reflections_;
};

}  // namespace

std::optional<rays::Hit> first_surface(const Measurand& luminance, const rays::RayCaster& caster) {
    const MeasuringPoint viewpoint = viewpoint_of(luminance);
    const sensors::Place place = place_of(viewpoint, caster);
    if (std::holds_alternative<LineOfSight>(luminance))
        return first_met(place.lifted, viewpoint.normal, caster);
    return place.surface;
}

Vec3 viewing_direction(const Measurand& luminance) {
    const auto* ray = std::get_if<EmergentRay>(&luminance);
    return ray ? -ray->direction : std::get<LineOfSight>(luminance).direction;
}

VisibleSurfaces trace_line_of_sight(const Measurand& luminance, const Scene& scene,
                                    const rays::RayCaster& caster, const LightSampler& lights,
                                    int max_reflections) {
    LineOfSightFollower follower(scene, caster, lights, max_reflections);
    follower.sight.first = first_surface(luminance, caster);
    if (follower.sight.first) {
        follower.follow(*follower.sight.first, viewing_direction(luminance), Rgb::grey(1), 0);
    } else {
        follower.add_outside(viewing_direction(luminance), Rgb::grey(1), 0);
    }
    std::stable_sort(follower.sight.sub_points.begin(), follower.sight.sub_points.end(),
                     [](const SubPoint& a, const SubPoint& b) {
                         return a.transmission.luminance() > b.transmission.luminance();
                     });
    VisibleSurfaces& sight = follower.sight;
    if (!sight.sub_points.empty()) sight.end = sight.sub_points.front().surface.position;
    return std::move(sight);
}

namespace {

/// The data of a surface and of the incoming path for the two functions.
struct Meeting {
    const rays::Hit& hit;
    bool is_pane;
    materials::LightSide side;
    Rgb left;  ///< of the light, on its way to the surface
    materials::ShadedSurface surface;
    materials::SpecularBranches branches;

    Meeting(const Material& material, const rays::Hit& met, const Vec3& from, Carried carried)
        : hit(met),
          is_pane(passes_straight(material)),
          side(met.on_front ? materials::LightSide::outside : materials::LightSide::inside),
          left(materials::left_on_the_way(material, side, met.distance_m)),
          surface(material, met.normal, met.shading_normal),
          branches(surface.branches(side, surface.frame().to_local(from), carried)) {}

    SpecularRay branch(const materials::SpecularBranch& branch, double probability) const {
        const bool reflected = branch.direction.z > 0;
        return {reflected ? hit.lifted : hit.lifted_behind(), surface.frame().to_world(branch.direction),
                left * branch.share * (1 / probability), branch.luminance_factor, is_pane && !reflected};
    }
};

}  // namespace

std::vector<SpecularRay> specular_rays(const Material& material, const rays::Hit& hit, const Vec3& from) {
    const Meeting meeting(material, hit, from, Carried::luminance);
    std::vector<SpecularRay> all;
    for (const materials::SpecularBranch& branch : meeting.branches.list())
        all.push_back(meeting.branch(branch, 1));
    return all;
}

std::optional<SpecularRay> choose_specular_ray(const Material& material, const rays::Hit& hit,
                                               const Vec3& from, Carried carried, double u) {
    const Meeting meeting(material, hit, from, carried);
    const auto branches = meeting.branches.list();
    if (branches.empty()) return std::nullopt;
    double total = 0;
    for (const materials::SpecularBranch& branch : branches) total += branch.share.luminance();
    double before = 0;
    for (const materials::SpecularBranch& branch : branches.first(branches.size() - 1)) {
        const double probability = branch.share.luminance() / total;
        if (u < before + probability) return meeting.branch(branch, probability);
        before += probability;
    }
    return meeting.branch(branches.back(), 1 - before);
}

}  // namespace stilb::transport
