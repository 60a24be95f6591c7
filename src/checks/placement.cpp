#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "checks/checks.h"

namespace stilb::checks {
namespace {

using EnclosureList = std::vector<Enclosure>;

bool contains(const EnclosureList& enclosures, const Enclosure& enclosure) {
    return std::find(enclosures.begin(), enclosures.end(), enclosure) != enclosures.end();
}

/// A component that encloses the point of `enclosure` and none of the `others`.
std::optional<ComponentId> only_around(const Enclosure& enclosure, const EnclosureList& others) {
    const auto found = std::find_if(enclosure.begin(), enclosure.end(), [&](const ComponentId& component) {
        return std::none_of(others.begin(), others.end(), [&](const Enclosure& other) {
            return std::binary_search(other.begin(), other.end(), component);
        });
    });
    return found != enclosure.end() ? std::optional{*found} : std::nullopt;
}

/// A component around all of the `inner` points and none of the `others`.
std::optional<ComponentId> around_all(const EnclosureList& inner, const EnclosureList& others) {
    for (const ComponentId& component : inner.front()) {
        const auto is_around = [&](const Enclosure& enclosure) {
            return std::binary_search(enclosure.begin(), enclosure.end(), component);
        };
        if (std::ranges::all_of(inner, is_around) && std::ranges::none_of(others, is_around))
            return component;
    }
    return std::nullopt;
}

/// The position of a point without light, relative to the lights.
std::string whereabouts(const Enclosure& dark, const EnclosureList& lit, const Scene& scene) {
    if (const auto component = only_around(dark, lit))
        return fmt::format("inside object \"{}\", which contains no light",
                           scene.object(component->object).name);
    if (const auto component = only_around(lit.front(), {dark}))
        return fmt::format("outside object \"{}\", which encloses the light",
                           scene.object(component->object).name);
    return "in an enclosure without a light";
}

ProbeRay ray_of(const Measurand& measurand, const rays::RayCaster& caster) {
    const MeasuringPoint point = viewpoint_of(measurand);
    const auto* body = std::get_if<BodyPoint>(&measurand);
    return {body ? lifted_position(*body, caster) : lifted_position(point, caster), point.normal};
}

/// Rays along which the light of the readings arrives.
std::vector<ProbeRay> rays_of(const Sensor& sensor, const rays::RayCaster& caster) {
    if (sensor.camera()) return {first_ray_of(sensor, caster)};
    std::vector<ProbeRay> rays;
    for (const Measurand& measurand : sensor.measurands()) rays.push_back(ray_of(measurand, caster));
    return rays;
}

/// Bodies are meant to stand free; one on a surface is probably a mistake.
std::optional<std::string> body_warning(const Sensor& sensor, const rays::RayCaster& caster) {
    std::size_t on_surfaces = 0;
    for (const Measurand& measurand : sensor.measurands()) {
        const auto* body = std::get_if<BodyPoint>(&measurand);
        on_surfaces += body && surface_at(*body, caster);
    }
    if (on_surfaces == 0) return std::nullopt;
    const std::string which =
        sensor.size() == 1 ? "it lies" : fmt::format("{} of {} points lie", on_surfaces, sensor.size());
    return fmt::format(
        "sensor \"{}\": {} on a surface, which hides half of the surroundings from a sensor of type {}. Move "
        "{} off the surface, or measure illuminance with a normal.",
        sensor.name, which, sensor.type(), on_surfaces == 1 ? "it" : "them");
}

std::optional<std::string> fault_of(const Sensor& sensor, const std::map<Enclosure, std::size_t>& counts,
                                    const EnclosureList& lit, const Scene& scene) {
    std::size_t dark_points = 0, points = 0;
    const Enclosure* most = nullptr;
    for (const auto& [enclosure, count] : counts) {
        points += count;
        if (contains(lit, enclosure)) continue;
        if (most == nullptr || count > counts.at(*most)) most = &enclosure;
        dark_points += count;
    }
    if (most == nullptr) return std::nullopt;
    const std::string which =
        points == 1 ? "it lies" : fmt::format("{} of {} points lie", dark_points, points);
    return fmt::format("sensor \"{}\": {} {}: no light arrives, {} 0 {}. Move {} to where light is.",
                       sensor.name, which, whereabouts(*most, lit, scene),
                       points == 1 ? "it reads" : "they read", sensor.quantity().unit,
                       points == 1 ? "it" : "them");
}

std::optional<std::string> fault_of(const Light& light, const EnclosureList& of_light,
                                    const EnclosureList& of_sensors, const Scene& scene) {
    const bool is_measured = std::any_of(of_light.begin(), of_light.end(), [&](const Enclosure& enclosure) {
        return contains(of_sensors, enclosure);
    });
    if (is_measured) return std::nullopt;
    if (location_of(light) == LightLocation::infinity) {
        return fmt::format(
            "light \"{}\" surrounds the scene, but closed surfaces enclose all sensors: its light cannot "
            "get in. "
            "Open a window, or remove the light.",
            light.name);
    }
    if (const auto component = only_around(of_light.front(), of_sensors)) {
        return fmt::format(
            "light \"{}\" is inside object \"{}\": its light cannot get out to any sensor. Move it, or open "
            "the "
            "object.",
            light.name, scene.object(component->object).name);
    }
    if (const auto component = around_all(of_sensors, of_light)) {
        return fmt::format(
            "light \"{}\" is outside object \"{}\", which encloses all sensors: its light cannot get in. "
            "Move it, "
            "or open the object.",
            light.name, scene.object(component->object).name);
    }
    return std::nullopt;
}

/// Whether the light is mounted in a surface and shines to the side without sensors.
bool is_turned_round(const Light& light, const EnclosureList& of_sensors, const Enclosures& enclosures,
                     const rays::RayCaster& caster) {
    const auto origin = lights::point_origin(light);
    if (!origin || !origin->axis) return false;
    const Vec3 behind =
        origin->position - caster.offset_m(origin->position, caster.half_extent_m()) * *origin->axis;
    return contains(of_sensors, enclosures.enclosure_of({behind, -*origin->axis}));
}

}  // namespace

ProbeRay first_ray_of(const Sensor& sensor, const rays::RayCaster& caster) {
    const Camera* camera = sensor.camera();
    if (!camera) return ray_of(sensor.measurand(0), caster);
    const MeasuringPoint viewpoint{camera->position, sensors::CameraView(*camera).forward()};
    return {lifted_position(viewpoint, caster), viewpoint.normal};
}

std::vector<std::string> placement_warnings(const Scene& scene, const rays::RayCaster& caster,
                                            const Enclosures& enclosures, std::span<const Sensor> sensors,
                                            Explained& explained) {
    EnclosureList lit, of_sensors;
    for (const EnclosureList& of_light : enclosures.of_lights())
        lit.insert(lit.end(), of_light.begin(), of_light.end());
    std::vector<std::string> warnings;
    for (const Sensor& sensor : sensors) {
        if (auto warning = body_warning(sensor, caster)) warnings.push_back(std::move(*warning));
    }
    if (lit.empty()) return warnings;

    for (std::size_t i = 0; i < sensors.size(); ++i) {
        std::map<Enclosure, std::size_t> counts;
        for (const ProbeRay& ray : rays_of(sensors[i], caster)) ++counts[enclosures.enclosure_of(ray)];
        for (const auto& [enclosure, count] : counts) of_sensors.push_back(enclosure);
        auto fault = fault_of(sensors[i], counts, lit, scene);
        if (!fault) continue;
        explained.sensors[i] = true;
        warnings.push_back(std::move(*fault));
    }
    const bool some_are_lit =
        std::any_of(of_sensors.begin(), of_sensors.end(),
                    [&](const Enclosure& enclosure) { return contains(lit, enclosure); });
    if (!some_are_lit) return warnings;  // one message for one mistake
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        auto fault = fault_of(scene.lights[i], enclosures.of_lights()[i], of_sensors, scene);
        if (!fault) continue;
        if (is_turned_round(scene.lights[i], of_sensors, enclosures, caster)) {
            fault = fmt::format(
                "light \"{}\" is mounted in a surface and shines to its other side, away from all sensors. "
                "Turn "
                "its aim round, or move it.",
                scene.lights[i].name);
        }
        explained.lights[i] = true;
        warnings.push_back(std::move(*fault));
    }
    return warnings;
}

}  // namespace stilb::checks
