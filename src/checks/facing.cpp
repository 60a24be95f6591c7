// Lamps and sensors whose fronts are turned the wrong way.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "checks/checks.h"
#include "checks/streams.h"
#include "checks/walks.h"
#include "sensors/place.h"

namespace stilb::checks {
namespace {

/// A lamp whose light is stopped within this distance, or within this share of the lamp's own size if that is
/// less, cannot light a room: in such a gap almost all of the light is absorbed.
constexpr double kNarrowGap_m = 0.1, kNarrowShare = 0.25;
/// A surface that a ray of a luminaire meets only beyond this distance lies beside it, not in front of it.
constexpr double kWidestGap_m = 1;
constexpr int kLampRays = 32, kMostThatEscape = 3;
constexpr std::size_t kMostLampsTested = 10'000;
/// A surface so close in front of a measuring point hides all else.
constexpr double kHiding_m = 0.02;
constexpr std::size_t kPointsTested = 64, kLightRays = 64, kMostSensorsTested = 256;
/// The share of a sensor's points that have to be turned: some may lie under things.
constexpr double kMostPoints = 0.9;

/// "1.2 cm", "3 mm".
std::string short_distance(double distance_m) {
    return distance_m < 0.0095 ? fmt::format("{:.2g} mm", 1000 * distance_m)
                               : fmt::format("{:.2g} cm", 100 * distance_m);
}

struct Facing {
    ObjectId object{};
    double distance_m = 0;
};

/// Surfaces so close to the front of a lamp stop its light.
struct NarrowGap {
    double depth_m = kNarrowGap_m;
    std::optional<Vec3>
        axis;  ///< of a luminaire: its depth is measured along it, as light leaves it to all sides
};

/// Nothing for lights that shine to all sides.
std::optional<NarrowGap> narrow_gap(const Light& light, const Scene& scene) {
    if (const auto object = lights::emitting_object(light)) {
        const double size_m = std::sqrt(area_m2(scene.object(*object).shape));
        return NarrowGap{std::min(kNarrowGap_m, kNarrowShare * size_m), std::nullopt};
    }
    const auto origin = lights::point_origin(light);
    return origin && origin->axis ? std::optional(NarrowGap{kNarrowGap_m, origin->axis}) : std::nullopt;
}

/// The object close to the front of a lamp that stops almost all of its light, if there is one.
std::optional<Facing> faced_by(const Light& light, const Scene& scene, const rays::RayCaster& caster) {
    const auto gap = narrow_gap(light, scene);
    if (!gap) return std::nullopt;
    const auto emitter = lights::make_emitter(light, scene::LightSurroundings(scene), caster.lift());
    Facing facing{{}, gap->depth_m};
    int escaped = 0;
    for (std::uint64_t i = 0; i < kLampRays; ++i) {
        math::SampleStream stream(kCheckKey.derived(CheckStream::lamp_fronts), i);
        const lights::Emission ray = std::visit([&](const auto& own) { return own.emit(stream); }, emitter);
        const auto hit = caster.closest(ray.origin, ray.direction);
        const double distance_m = hit ? hit->distance_m : std::numeric_limits<double>::infinity();
        const double depth_m = gap->axis ? std::abs(dot(ray.direction, *gap->axis)) * distance_m : distance_m;
        if (!(depth_m <= gap->depth_m && distance_m <= kWidestGap_m) ||
            transmits(scene.material(hit->material))) {
            if (++escaped > kMostThatEscape) return std::nullopt;
        } else if (depth_m < facing.distance_m) {
            facing = {hit->object, depth_m};
        }
    }
    return facing;
}

/// The illuminance points of a sensor; a part of them where there are many.
std::vector<MeasuringPoint> points_of(const Sensor& sensor) {
    std::vector<MeasuringPoint> points;
    if (sensor.camera()) return points;
    const std::size_t count = std::min(sensor.size(), kPointsTested);
    for (std::size_t i = 0; i < count; ++i) {
        const Measurand measurand = sensor.measurand(i * sensor.size() / count);
        if (const auto* point = std::get_if<MeasuringPoint>(&measurand)) points.push_back(*point);
    }
    return points;
}

/// The surface close in front of most points.
std::optional<Facing> faced_by(const std::vector<MeasuringPoint>& points, const rays::RayCaster& caster) {
    std::size_t hidden = 0;
    Facing facing{{}, kHiding_m};
    for (const MeasuringPoint& point : points) {
        const auto hit = caster.closest(place_of(point, caster).lifted, point.normal);
        if (!hit || hit->distance_m > kHiding_m) continue;
        ++hidden;
        if (hit->distance_m < facing.distance_m) facing = {hit->object, hit->distance_m};
    }
    if (static_cast<double>(hidden) < kMostPoints * static_cast<double>(points.size())) return std::nullopt;
    return facing;
}

/// The surface that most points lie on, where lamps shine on its other side and not on that of the points.
std::optional<ObjectId> lit_from_behind(const std::vector<MeasuringPoint>& points,
                                        const std::vector<SurfacePoint>& lamps,
                                        const rays::RayCaster& caster) {
    const auto is_lit = [&](const SurfacePoint& place) {
        return std::ranges::any_of(lamps, [&](const SurfacePoint& lamp) {
            // A lamp shines into the whole half space, of which its particle took one direction.
            return dot(lamp.lifted - place.lifted, place.normal) > 0 &&
                   caster.transmittance({place.lifted, lamp.lifted}).max() > 0;
        });
    };
    std::size_t turned = 0;
    std::optional<ObjectId> object;
    for (const MeasuringPoint& point : points) {
        const auto surface = place_of(point, caster).surface;
        if (!surface || is_lit(*surface) ||
            !is_lit({surface->position, -surface->normal, surface->lifted_behind()}))
            continue;
        ++turned;
        object = surface->object;
    }
    if (static_cast<double>(turned) < kMostPoints * static_cast<double>(points.size())) return std::nullopt;
    return object;
}

/// Points on lamps from which particles start.
std::vector<SurfacePoint> lamp_points(const Scene& scene, const rays::RayCaster& caster) {
    std::vector<SurfacePoint> points;
    const std::size_t count = std::min<std::size_t>(kLightRays, 4 * scene.lights.size());
    for (std::size_t i = 0; i < count; ++i) {
        math::SampleStream stream(kCheckKey.derived(CheckStream::light_origins), i);
        const Light& light = scene.lights[i * scene.lights.size() / count];
        const auto emitter = lights::make_emitter(light, scene::LightSurroundings(scene), caster.lift());
        const lights::Emission ray = std::visit([&](const auto& own) { return own.emit(stream); }, emitter);
        points.push_back({ray.origin, ray.direction});
    }
    return points;
}

std::optional<std::string> fault_of(const Sensor& sensor, const std::vector<SurfacePoint>& lamps,
                                    const Scene& scene, const rays::RayCaster& caster) {
    const std::vector<MeasuringPoint> points = points_of(sensor);
    if (points.empty()) return std::nullopt;
    if (const auto faced = faced_by(points, caster)) {
        return fmt::format(
            "sensor \"{}\": its normal points to object \"{}\", {} away, which hides everything else. Turn "
            "the "
            "normal round (of a grid by exchanging edge_u and edge_v), or move the sensor.",
            sensor.name, scene.object(faced->object).name, short_distance(faced->distance_m));
    }
    const auto object = lit_from_behind(points, lamps, caster);
    if (!object) return std::nullopt;
    return fmt::format(
        "sensor \"{}\": it lies on object \"{}\", but its normal points into it, to the side where no lamp "
        "shines. Turn the normal round (of a grid by exchanging edge_u and edge_v), unless that side is "
        "meant.",
        sensor.name, scene.object(*object).name);
}

/// Lamps whose fronts face one object.
struct FacedLamps {
    bool are_area_lights = false;
    Facing facing;  ///< the closest
    std::vector<std::string> names;
};

std::string text_of_lamps(const FacedLamps& lamps, const Scene& scene) {
    const bool is_one = lamps.names.size() == 1;
    const std::string remedy =
        lamps.are_area_lights
            ? fmt::format(
                  "Only fronts emit light: turn {} round (a rectangle by exchanging edge_u and edge_v), or "
                  "move {}.",
                  is_one ? "the lamp" : "the lamps", is_one ? "it" : "them")
            : fmt::format("Move {} to the other side, or turn {} aim round.", is_one ? "it" : "them",
                          is_one ? "its" : "their");
    return fmt::format("{} {}: {} object \"{}\", {} away, which stops almost all of {} light. {}",
                       is_one ? "light" : "lights", list_of(lamps.names),
                       is_one ? "its front faces" : "their fronts face",
                       scene.object(lamps.facing.object).name, short_distance(lamps.facing.distance_m),
                       is_one ? "its" : "their", remedy);
}

std::vector<FacedLamps> faced_lamps(const Scene& scene, const rays::RayCaster& caster, Explained& explained) {
    std::vector<FacedLamps> all;
    for (std::size_t i = 0; i < std::min(scene.lights.size(), kMostLampsTested); ++i) {
        const Light& light = scene.lights[i];
        const auto facing = explained.lights[i] ? std::nullopt : faced_by(light, scene, caster);
        if (!facing) continue;
        explained.lights[i] = true;
        const bool is_area_light = lights::uniform_emission(light).has_value();
        auto same = std::ranges::find_if(all, [&](const FacedLamps& lamps) {
            return lamps.are_area_lights == is_area_light && lamps.facing.object == facing->object;
        });
        if (same == all.end()) same = all.insert(all.end(), {is_area_light, *facing, {}});
        same->names.push_back(light.name);
        same->facing.distance_m = std::min(same->facing.distance_m, facing->distance_m);
    }
    return all;
}

}  // namespace

std::vector<std::string> facing_warnings(const Scene& scene, const rays::RayCaster& caster,
                                         std::span<const Sensor> sensors, Explained& explained) {
    std::vector<std::string> warnings;
    for (const FacedLamps& lamps : faced_lamps(scene, caster, explained))
        warnings.push_back(text_of_lamps(lamps, scene));
    const std::vector<SurfacePoint> lamps = lamp_points(scene, caster);
    for (std::size_t i = 0; i < std::min(sensors.size(), kMostSensorsTested); ++i) {
        if (explained.sensors[i]) continue;
        auto fault = fault_of(sensors[i], lamps, scene, caster);
        if (!fault) continue;
        explained.sensors[i] = true;
        warnings.push_back(std::move(*fault));
    }
    return warnings;
}

}  // namespace stilb::checks
