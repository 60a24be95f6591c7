#include "walk/data/scene_header.h"

#include <nlohmann/json.hpp>

#include "materials/model_list.h"

namespace stilb::walk {
namespace {

using Json = nlohmann::ordered_json;

Json value_json(double value) { return value; }
Json value_json(bool value) { return value; }
Json value_json(const Rgb& value) { return json_of(value); }
Json value_json(const materials::SharesByAngle& value) {
    Json rows = Json::array();
    for (const auto& [degrees, share] : value.rows) rows.push_back({degrees, json_of(share)});
    return rows;
}
Json value_json(const std::array<double, 2>& value) { return value; }

/// The light's colour with luminance 1; white where the light is dark.
Rgb colour_of(const Rgb& flux_lm) {
    const double luminous = flux_lm.luminance();
    return luminous > 0 ? flux_lm * (1 / luminous) : Rgb::grey(1);
}

/// A place to jump to: the middle of a grid, else the common point of all readings or that of the middle one.
Location place_of(const Sensor& sensor) {
    Location location =
        sensor.common_location() ? *sensor.common_location() : sensor.location(sensor.size() / 2);
    if (const auto* grid = std::get_if<Grid>(&sensor.kind))
        location.position = grid->corner + 0.5 * (grid->edge_u + grid->edge_v);
    return location;
}

}  // namespace

Json json_of(const Vec3& v) { return {v.x, v.y, v.z}; }
Json json_of(const Rgb& rgb) { return {rgb[0], rgb[1], rgb[2]}; }

Json json_of(const NamedMaterial& material) {
    Json json{{"name", material.name}};
    materials::visit_model(
        [&]<typename M>(const M& model) {
            using Parameters = materials::ParametersOf<M>;
            const Parameters& parameters = materials::parameters_of(model);
            json["type"] = M::kType;
            json["colour"] = json_of(materials::stated_reflectance(material.material));
            for_each_field<Parameters>([&](const auto& field) {
                const auto& value = parameters.*field.member;
                if (materials::is_given(value)) json[field.key] = value_json(value);
            });
        },
        material.material);
    return json;
}

Json json_of(const Scene& scene, const Light& light, std::size_t group, std::size_t first,
             std::size_t count) {
    const Rgb flux = flux_lm(scene, light);
    return {{"name", light.name},
            {"type", type_of(light)},
            {"group", group},
            {"colour", json_of(colour_of(flux))},
            {"flux_lm", flux.luminance()},
            {"points", {first, count}}};
}

Json json_of_cameras(const std::vector<Sensor>& sensors) {
    Json list = Json::array();
    for (const Sensor& sensor : sensors) {
        const Camera* camera = sensor.camera();
        if (camera == nullptr) continue;
        list.push_back({{"name", sensor.name},
                        {"position", json_of(camera->position)},
                        {"target", json_of(camera->target)},
                        {"up", json_of(camera->up)},
                        {"fov", camera->fov_deg}});
    }
    return list;
}

Json json_of_other_sensors(const std::vector<Sensor>& sensors) {
    Json list = Json::array();
    for (const Sensor& sensor : sensors) {
        if (sensor.camera() != nullptr || sensor.size() == 0) continue;
        const Location location = place_of(sensor);
        Json json{{"name", sensor.name}, {"type", sensor.type()}, {"position", json_of(location.position)}};
        for (const Location::Direction& direction : location.directions) {
            if (!direction.name.empty()) json[direction.name] = json_of(direction.value);
        }
        list.push_back(std::move(json));
    }
    return list;
}

Json json_of_meshes(const Scene& scene, const std::vector<DisplayPart>& parts,
                    const CoarseTriangles& coarse) {
    std::vector<int> light_of_object(scene.objects.size(), -1);
    std::vector<Rgb> luminance_cd_m2(scene.objects.size());
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const auto object = lights::emitting_object(scene.lights[i]);
        if (!object) continue;
        light_of_object[index_of(*object)] = static_cast<int>(i);
        luminance_cd_m2[index_of(*object)] =
            *lights::mean_luminance_cd_m2(scene.lights[i], scene::LightSurroundings(scene));
    }
    Json list = Json::array();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const DisplayPart& part = parts[i];
        const std::uint32_t object = index_of(part.object);
        const int light = part.is_front ? light_of_object[object] : -1;
        list.push_back({{"object", object},
                        {"material", index_of(part.material)},
                        {"first", part.first},
                        {"count", part.count},
                        {"light", light}});
        if (!coarse.parts.empty()) list.back()["coarse"] = {coarse.parts[i].first, coarse.parts[i].count};
        if (light >= 0) list.back()["luminance_cd_m2"] = json_of(luminance_cd_m2[object]);
    }
    return list;
}

}  // namespace stilb::walk
