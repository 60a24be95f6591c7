#include "random/motion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "random/generator.h"

namespace stilb::random {
namespace {

using namespace std::string_view_literals;

constexpr std::array kPoints{"position"sv, "corner"sv, "center"sv, "min"sv,  "max"sv,
                             "target"sv,   "point"sv,  "origin"sv, "room"sv, "translate"sv};
constexpr std::array kPointLists{"positions"sv, "points"sv, "targets"sv, "vertices"sv, "corners"sv};
constexpr std::array kVectors{"edge_u"sv, "edge_v"sv, "step_u"sv, "step_v"sv};
constexpr std::array kDirections{"normal"sv, "direction"sv, "aim"sv, "up"sv};
constexpr std::array kLengths{"radius"sv, "opening"sv, "coefficients"sv, "spacing"sv,
                              "scale"sv,  "height"sv,  "margin"sv};
constexpr std::array kBySquare{"flux"sv, "intensity"sv};

bool holds(const auto& keys, std::string_view key) { return std::ranges::find(keys, key) != keys.end(); }

template <typename Change>
void change_each(TomlValue& list, const Change& change) {
    for (TomlValue& value : std::get<TomlArray>(list.content)) value = vector(change(as_vector(value)));
}

void multiply(TomlValue& value, double factor) {
    if (auto* const array = std::get_if<TomlArray>(&value.content)) {
        for (TomlValue& element : *array) multiply(element, factor);
    } else if (!std::holds_alternative<std::string>(value.content)) {
        value = number(factor * as_number(value));
    }
}

void move_keys(TomlMembers& keys, const Motion& motion) {
    for (auto& [key, line, value] : keys) {
        if (auto* const table = std::get_if<TomlMembers>(&value.content)) move_keys(*table, motion);
        if (holds(kPoints, key)) value = vector(motion.point(as_vector(value)));
        if (holds(kPointLists, key)) change_each(value, [&](const Vec3& p) { return motion.point(p); });
        if (holds(kVectors, key)) value = vector(motion.vector(as_vector(value)));
        if (holds(kDirections, key)) value = vector(motion.direction(as_vector(value)));
        if (holds(kLengths, key)) multiply(value, motion.scale);
        if (holds(kBySquare, key)) multiply(value, motion.scale * motion.scale);
    }
}

void move_object(Part& object, const Motion& motion) {
    const std::string shape = object.text("shape");
    if (shape == "box") {
        const Vec3 low = object.vector("min"), high = object.vector("max");
        if (motion.turn_deg != 0) {
            object.set("rotate", {TomlArray{number(0), number(0), number(1), number(motion.turn_deg)}});
            object.set("translate", vector(motion.shift));
            return;
        }
        const Vec3 a = motion.point(low), b = motion.point(high);
        object.set("min", vector({std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}));
        object.set("max", vector({std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}));
        return;
    }
    if (motion.turn_deg != 0 && (shape == "harmonics" || shape == "mesh")) {
        const TomlValue* const own = object.find("rotate");
        const double before = own ? as_number(std::get<TomlArray>(own->content)[3]) : 0;
        object.set("rotate", {TomlArray{number(0), number(0), number(1), number(before + motion.turn_deg)}});
    }
    move_keys(object.keys, motion);
    if (!motion.is_mirrored) return;
    // The front stays in front.
    if (shape == "rectangle") std::swap(*object.find("edge_u"), *object.find("edge_v"));
    if (shape == "polygons") {
        for (TomlValue& face : std::get<TomlArray>(object.find("faces")->content))
            std::ranges::reverse(std::get<TomlArray>(face.content));
    }
}

/// Spins and azimuths count from an axis that a turn takes along; where the direction is straight against
/// the one from which it is reached by the shortest turn, that is a half turn, and they count backwards.
void move_azimuth(Part& part, std::string_view key, bool is_backwards, const Motion& motion,
                  double mirrored_from) {
    const double before = part.find(key) ? part.number(key) : 0;
    double after = before + (is_backwards ? -1 : 1) * motion.turn_deg;
    if (motion.is_mirrored) after = mirrored_from - before;
    if (after != before) part.set(key, number(after));
}

void move_light(Part& light, const Motion& motion) {
    if (light.text("type") == "photometry") {
        const bool is_up = light.find("aim") && normalized(light.vector("aim")).z > 1 - 1e-12;
        move_azimuth(light, "spin", is_up, motion, 0);
    }
    if (light.text("type") == "environment" && light.find("file"))
        move_azimuth(light, "rotation", false, motion, 0);
    move_keys(light.keys, motion);
}

void move_sensor(Part& sensor, const Motion& motion) {
    if (sensor.text("type") == "goniometer")
        move_azimuth(sensor, "plane", normalized(sensor.vector("normal")).z < -1 + 1e-12, motion, 180);
    move_keys(sensor.keys, motion);
}

bool has_type(const std::vector<Part>& parts, std::string_view key, std::string_view type) {
    return std::ranges::any_of(parts, [&](const Part& part) { return part.text(key) == type; });
}

}  // namespace

Motion turn_about(const Vec3& axis, double angle_deg) {
    const double angle = angle_deg * kPi / 180, c = std::cos(angle), s = std::sin(angle);
    const auto turned = [&](const Vec3& v) {
        return c * v + s * cross(axis, v) + (1 - c) * dot(axis, v) * axis;
    };
    Motion motion;
    motion.x = turned(motion.x);
    motion.y = turned(motion.y);
    motion.z = turned(motion.z);
    if (axis == Vec3{0, 0, 1}) motion.turn_deg = angle_deg;
    return motion;
}

bool depends_on_vertical(const Draft& draft) {
    return has_type(draft.lights, "type", "photometry") || has_type(draft.sensors, "type", "cylindrical") ||
           has_type(draft.sensors, "type", "semicylindrical") || has_type(draft.sensors, "type", "ugr") ||
           has_type(draft.sensors, "type", "area") || has_type(draft.sensors, "type", "camera") ||
           has_type(draft.sensors, "type", "goniometer") || has_type(draft.sensors, "type", "dgp") ||
           has_type(draft.sensors, "type", "plane") || has_type(draft.lights, "file", kSkyFile) ||
           has_type(draft.objects, "shape", "mesh") || has_type(draft.materials, "type", "ward") ||
           has_type(draft.objects, "shape", "box") || has_type(draft.objects, "shape", "harmonics");
}

bool depends_on_hand(const Draft& draft) {
    return has_type(draft.lights, "file", kWasherFile) || has_type(draft.lights, "file", kSkyFile) ||
           has_type(draft.objects, "shape", "harmonics") || has_type(draft.objects, "shape", "mesh");
}

Draft in_motion(Draft draft, const Motion& motion) {
    for (Part& material : draft.materials) {
        if (TomlValue* const distance = material.find("distance")) multiply(*distance, motion.scale);
    }
    for (Part& object : draft.objects) move_object(object, motion);
    for (Part& light : draft.lights) move_light(light, motion);
    for (Part& sensor : draft.sensors) move_sensor(sensor, motion);
    return draft;
}

double farthest_coordinate(const Draft& draft) {
    double farthest = 0;
    const auto look = [&](const auto& self, const TomlMembers& keys) -> void {
        const auto include = [&](const TomlValue& value) {
            const Vec3 p = as_vector(value);
            farthest = std::max({farthest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        };
        for (const auto& [key, line, value] : keys) {
            if (const auto* const table = std::get_if<TomlMembers>(&value.content)) self(self, *table);
            if (holds(kPoints, key) || holds(kVectors, key)) include(value);
            if (!holds(kPointLists, key)) continue;
            for (const TomlValue& point : std::get<TomlArray>(value.content)) include(point);
        }
    };
    for (const auto* const parts : {&draft.objects, &draft.lights, &draft.sensors}) {
        for (const Part& part : *parts) look(look, part.keys);
    }
    return farthest;
}

}  // namespace stilb::random
