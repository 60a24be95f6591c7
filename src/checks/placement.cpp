#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <variant>

#include "checks/checks.h"
#include "checks/walks.h"
#include "sensors/place.h"

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

SurfacePoint point_of(const Measurand& measurand, const rays::RayCaster& caster) {
    const MeasuringPoint point = viewpoint_of(measurand);
    const auto* body = std::get_if<BodyPoint>(&measurand);
    if (!body) return place_of(point, caster);
    return {point.position, point.normal, place_of(*body, caster).lifted};
}

/// Where the light of the readings arrives.
std::vector<SurfacePoint> points_of(const Sensor& sensor, const rays::RayCaster& caster) {
    if (sensor.camera()) return {first_point_of(sensor, caster)};
    std::vector<SurfacePoint> points;
    for (const Measurand& measurand : sensor.measurands()) points.push_back(point_of(measurand, caster));
    return points;
}

/// Bodies are meant to stand free; one on a surface is probably a mistake.
std::optional<std::string> body_warning(const Sensor& sensor, const rays::RayCaster& caster) {
    std::size_t on_surfaces = 0;
    for (const Measurand& measurand : sensor.measurands()) {
        const auto* body = std::get_if<BodyPoint>(&measurand);
        on_surfaces += body && place_of(*body, caster).surface;
    }
    if (on_surfaces == 0) return std::nullopt;
    const std::string which =
        sensor.size() == 1 ? "it lies" : fmt::format("{} of {} points lie", on_surfaces, sensor.size());
    return fmt::format(
        "sensor \"{}\": {} on a surface, which hides half of the surroundings from a sensor of type {}. Move "
        "{} off the surface, or measure illuminance with a normal.",
        sensor.name, which, sensor.type(), on_surfaces == 1 ? "it" : "them");
}

/// Points of a sensor in one enclosure.
struct EnclosedPoints {
    std::size_t count = 0;
    Vec3 first;
};

std::optional<std::string> fault_of(const Sensor& sensor, const std::map<Enclosure, EnclosedPoints>& enclosed,
                                    const auto& is_dark, const EnclosureList& lit, const Scene& scene) {
    std::size_t dark_points = 0, points = 0;
    const Enclosure* most = nullptr;
    for (const auto& [enclosure, own] : enclosed) {
        points += own.count;
        if (contains(lit, enclosure) || !is_dark(own.first)) continue;
        if (most == nullptr || own.count > enclosed.at(*most).count) most = &enclosure;
        dark_points += own.count;
    }
    if (most == nullptr) return std::nullopt;
    const std::string which =
        points == 1 ? "it lies" : fmt::format("{} of {} points lie", dark_points, points);
    const std::string_view it = points == 1 ? "it" : "them", unit = sensor.quantity().unit;
    // Ratings of glare in the dark are what their formulas give.
    const std::string reading =
        unit.empty() ? "" : fmt::format(", {} 0 {}", points == 1 ? "it reads" : "they read", unit);
    return fmt::format(
        "sensor \"{}\": {} {}: no light arrives{}. Move {} to where light is, or a light to {}.", sensor.name,
        which, whereabouts(*most, lit, scene), reading, it, it);
}

// Lights whose light gets to no sensor.

enum class Fault { shut_in, shut_out, turned_round };

/// Lights with one fault, and the object that stops their light.
struct FaultyLights {
    Fault fault;
    ObjectId object{};
    std::vector<std::string> names;
};

/// Lamps of other rooms are no mistake, but the program does not know rooms.
std::string text_of_lights(const FaultyLights& lights, const Scene& scene, bool are_cameras) {
    const bool is_one = lights.names.size() == 1;
    const std::string subject =
        fmt::format("{} {} {}", is_one ? "light" : "lights", list_of(lights.names), is_one ? "is" : "are");
    const std::string_view its = is_one ? "its" : "their", it = is_one ? "it" : "them",
                           do_light = is_one ? "it lights" : "they light";
    const std::string& object = scene.object(lights.object).name;
    switch (lights.fault) {
        case Fault::shut_in:
            return fmt::format(
                "{} inside object \"{}\": {} light cannot get out to {}. Unless {} another room, move {}, or "
                "open the object.",
                subject, object, its, are_cameras ? "what the camera sees" : "any sensor", do_light, it);
        case Fault::shut_out:
            return fmt::format(
                "{} not inside object \"{}\", which encloses {}: {} light cannot get in. Unless {} another "
                "room, move {} inside, or open the object.",
                subject, object, are_cameras ? "the camera" : "all sensors", its, do_light, it);
        case Fault::turned_round:
            break;
    }
    return fmt::format(
        "{} mounted in object \"{}\" and turned round: {} light leaves on the side without sensors. Turn {} "
        "to the "
        "other side, by aim or (a rectangle) by exchanging edge_u and edge_v.",
        subject, object, its, it);
}

class PlacementCheck {
  public:
    PlacementCheck(const Scene& scene, const rays::RayCaster& caster, const Enclosures& enclosures,
                   std::span<const Sensor> sensors)
        : scene_(scene), caster_(caster), enclosures_(enclosures), sensors_(sensors) {
        for (const EnclosureList& of_light : enclosures.of_lights())
            lit_.insert(lit_.end(), of_light.begin(), of_light.end());
        for (const Sensor& sensor : sensors) {
            const std::vector<SurfacePoint> all = points_of(sensor, caster);
            auto& enclosed = enclosed_.emplace_back();
            for (const SurfacePoint& point : all) {
                EnclosedPoints& points = enclosed[enclosures.enclosure_of(point)];
                if (points.count++ == 0) points.first = point.lifted;
            }
            for (const auto& [enclosure, points] : enclosed) of_sensors_.push_back(enclosure);
            first_.push_back(all.front().lifted);
        }
    }

    std::vector<std::string> warnings(Explained& explained) {
        if (lit_.empty()) return {};
        const bool some_are_lit = std::ranges::any_of(
            of_sensors_, [&](const Enclosure& enclosure) { return contains(lit_, enclosure); });
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
            // One message for one mistake: where no sensor is lit, the sensors are named.
            explained.lights[i] = add_turned(i) || (some_are_lit && add_shut(i));
        }
        std::vector<std::string> warnings;
        const bool lights_explain_all = !some_are_lit && !faulty_.empty();
        for (std::size_t i = 0; i < sensors_.size(); ++i) {
            auto fault = fault_of(
                sensors_[i], enclosed_[i], [&](const Vec3& point) { return !sees_a_lamp(point); }, lit_,
                scene_);
            if (!fault) continue;
            explained.sensors[i] = true;
            if (!lights_explain_all) warnings.push_back(std::move(*fault));
        }
        warnings.insert(warnings.end(), of_sky_.begin(), of_sky_.end());
        const bool are_cameras =
            std::ranges::all_of(sensors_, [](const Sensor& sensor) { return sensor.camera() != nullptr; });
        for (const FaultyLights& lights : faulty_)
            warnings.push_back(text_of_lights(lights, scene_, are_cameras));
        return warnings;
    }

  private:
    void add(Fault fault, ObjectId object, const Light& light) {
        const auto same = std::ranges::find_if(faulty_, [&](const FaultyLights& lights) {
            return lights.fault == fault && lights.object == object;
        });
        if (same == faulty_.end()) {
            faulty_.push_back({fault, object, {light.name}});
        } else {
            same->names.push_back(light.name);
        }
    }

    bool is_measured(std::size_t i) const {
        return std::ranges::any_of(enclosures_.of_lights()[i], [&](const Enclosure& enclosure) {
            return contains(of_sensors_, enclosure);
        });
    }

    /// Lights in the surface of an object that shine away from it, while sensors are inside.
    bool add_turned(std::size_t i) {
        const Light& light = scene_.lights[i];
        const auto origin = lights::point_origin(light);
        const bool has_front = lights::emitting_object(light) || (origin && origin->axis);
        if (!has_front || is_measured(i)) return false;
        const SurfacePoint front = enclosures_.starts_of(light).front();
        // Behind the surface, even if the lamp was put in front of it (scene/overlaps.h).
        constexpr double offsets = 6;
        const double depth_m = offsets * caster_.offset_m(front.lifted, caster_.lift().largest_size_m());
        const Enclosure behind =
            enclosures_.enclosure_of({front.lifted - depth_m * front.normal, -front.normal});
        if (!contains(of_sensors_, behind)) return false;
        const auto component = only_around(behind, {enclosures_.of_lights()[i].front()});
        if (!component) return false;
        add(Fault::turned_round, component->object, light);
        return true;
    }

    /// Lights that a closed object separates from all sensors.
    bool add_shut(std::size_t i) {
        const Light& light = scene_.lights[i];
        const EnclosureList& of_light = enclosures_.of_lights()[i];
        if (is_measured(i)) return false;
        if (location_of(light) == LightLocation::infinity) {
            of_sky_.push_back(
                fmt::format("light \"{}\" surrounds the scene, but closed surfaces enclose all sensors: its "
                            "light cannot get "
                            "in. Open a window, or remove the light.",
                            light.name));
            return true;
        }
        if (const auto component = only_around(of_light.front(), of_sensors_)) {
            add(Fault::shut_in, component->object, light);
            return true;
        }
        const auto component = around_all(of_sensors_, of_light);
        if (!component || is_seen(i)) return false;
        add(Fault::shut_out, component->object, light);
        return true;
    }

    /// Whether the first point of a sensor sees the light: one that lies in a wall is on neither side of it.
    bool is_seen(std::size_t light) {
        const auto sees = [&](const Vec3& point) {
            const auto is_visible = [&](const Vec3& from) { return !caster_.occluded(point, from); };
            return std::ranges::any_of(enclosures_.starts_of(scene_.lights[light]), is_visible,
                                       &SurfacePoint::lifted) ||
                   std::ranges::any_of(points_of_lamps()[light], is_visible);
        };
        constexpr std::size_t most_sensors = 64;
        return std::ranges::any_of(std::span(first_).first(std::min(first_.size(), most_sensors)), sees);
    }

    /// A lamp may stand in a wall, with a small part on the side of the point.
    bool sees_a_lamp(const Vec3& point) {
        return std::ranges::any_of(points_of_lamps(), [&](const std::vector<Vec3>& points) {
            return std::ranges::any_of(points,
                                       [&](const Vec3& from) { return !caster_.occluded(point, from); });
        });
    }

    /// Points of each light from which it shines. Each light has fewer of them where there are many lights.
    const std::vector<std::vector<Vec3>>& points_of_lamps() {
        constexpr std::size_t in_all = 1024;
        const std::size_t each = std::max<std::size_t>(in_all / scene_.lights.size(), 1);
        for (std::size_t light = points_of_lamps_.size(); light < scene_.lights.size(); ++light) {
            const auto emitter =
                lights::make_emitter(scene_.lights[light], scene::LightSurroundings(scene_), caster_.lift());
            auto& points = points_of_lamps_.emplace_back();
            for (std::uint64_t i = 0; i < each; ++i) {
                math::SampleStream stream(math::RandomKey{}, i);
                points.push_back(
                    std::visit([&](const auto& own) { return own.emit(stream).origin; }, emitter));
            }
        }
        return points_of_lamps_;
    }

    const Scene& scene_;
    const rays::RayCaster& caster_;
    const Enclosures& enclosures_;
    std::span<const Sensor> sensors_;
    EnclosureList lit_, of_sensors_;
    std::vector<std::map<Enclosure, EnclosedPoints>> enclosed_;  ///< by sensor
    std::vector<Vec3> first_;                                    ///< by sensor: where its first ray starts
    std::vector<std::vector<Vec3>> points_of_lamps_;
    std::vector<FaultyLights> faulty_;
    std::vector<std::string> of_sky_;
};

}  // namespace

SurfacePoint first_point_of(const Sensor& sensor, const rays::RayCaster& caster) {
    const Camera* camera = sensor.camera();
    if (!camera) return point_of(sensor.measurand(0), caster);
    return place_of(MeasuringPoint{camera->position, sensors::CameraView(*camera).forward()}, caster);
}

std::vector<std::string> placement_warnings(const Scene& scene, const rays::RayCaster& caster,
                                            const Enclosures& enclosures, std::span<const Sensor> sensors,
                                            Explained& explained) {
    std::vector<std::string> warnings;
    for (const Sensor& sensor : sensors) {
        if (auto warning = body_warning(sensor, caster)) warnings.push_back(std::move(*warning));
    }
    for (std::string& warning : PlacementCheck(scene, caster, enclosures, sensors).warnings(explained))
        warnings.push_back(std::move(warning));
    return warnings;
}

}  // namespace stilb::checks
