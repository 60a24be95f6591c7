#include "cli/commands/info/info_report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <set>

#include "base/vec.h"
#include "base/version.h"
#include "checks/checks.h"
#include "cli/commands/info/ugr_report.h"
#include "geometry/harmonics/surface.h"
#include "io/mesh/mesh_file.h"
#include "io/photometry/photometry_file.h"
#include "materials/model_list.h"
#include "run/readings/campaign.h"
#include "scene/installed_power.h"

namespace stilb::cli {
namespace {

using Json = InfoReport;

/// A stage of the work.
constexpr std::string_view kChecking = "checks";

Json vector_json(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }
Json extent_json(const Bounds& bounds) {
    return Json::array({vector_json(bounds.min), vector_json(bounds.max)});
}

Json parameter_json(double value) { return value; }
Json parameter_json(const Rgb& value) { return value.luminance(); }
Json parameter_json(bool value) { return value; }
/// Rows of an angle and the luminance of a share.
Json parameter_json(const materials::SharesByAngle& value) {
    Json rows = Json::array();
    for (const auto& [degrees, share] : value.rows) rows.push_back({degrees, share.luminance()});
    return rows;
}
template <std::size_t count>
Json parameter_json(const std::array<double, count>& values) {
    return values;
}

/// The listed parameters of a material type. A colour is given by its luminance; "reflectance", which is
/// stated before, by its bands.
template <typename Parameters>
void add_parameters(Json& json, const Parameters& parameters) {
    for_each_field<Parameters>([&](const auto& field) {
        const auto& value = parameters.*field.member;
        if constexpr (std::same_as<decltype(value), const Rgb&>) {
            if (field.key == "reflectance") return void(json["rgb"] = value.band);
        } else if constexpr (std::same_as<decltype(value), const materials::SharesByAngle&>) {
            const std::string key(field.key);
            if (value.is_along_normal()) {
                json[key] = parameter_json(value.rows[0].share);
            } else if (value.is_given()) {
                json[key + "_by_angle"] = parameter_json(value);
            }
            return;
        }
        json[std::string(field.key)] = parameter_json(value);
    });
}

Json material_json(const NamedMaterial& named) {
    const Material& material = named.material;
    return materials::visit_model(
        [&]<typename Model>(const Model& model) {
            Json json{{"name", named.name},
                      {"type", Model::kType},
                      {"reflectance", stated_reflectance(material).luminance()}};
            if (passes_straight(material))
                json["transmittance"] = straight_transmittance(material, 1).luminance();
            add_parameters(json, materials::parameters_of(model));
            return json;
        },
        material);
}

struct ShapeReport {
    Json operator()(const Mesh& mesh) const { return of_triangles("mesh", mesh); }
    Json operator()(const Instance& instance) const { return of_triangles("mesh", *instance.mesh); }
    Json operator()(const Rectangle& rectangle) const {
        return of_triangles("rectangle", triangulated(rectangle));
    }
    Json operator()(const Box& box) const { return of_triangles("box", triangulated(box)); }
    Json operator()(const Sphere&) const { return {{"shape", "sphere"}, {"triangles", 0}}; }
    Json operator()(const Disk&) const { return {{"shape", "disk"}, {"triangles", 0}}; }
    Json operator()(const Harmonics& harmonics) const {
        return {{"shape", "harmonics"}, {"triangles", 0}, {"degree", harmonics.surface->radius().degree()}};
    }

  private:
    static Json of_triangles(const char* name, const Mesh& mesh) {
        return {{"shape", name}, {"triangles", mesh.triangles.size()}};
    }
};

Json shape_json(const std::string& name, const Shape& shape,
                const geometry::ConnectedComponents& components) {
    Json json{{"name", name}};
    json.update(std::visit(ShapeReport{}, shape));
    json["extent"] = extent_json(bounds_of(shape));
    json["area_m2"] = area_m2(shape);
    json["parts"] = components.count();
    json["open_edges"] = components.total_open_edges();
    json["closed"] = components.total_open_edges() == 0;
    return json;
}

Json object_json(const Object& object, const geometry::ConnectedComponents& components, const Scene& scene) {
    Json json = shape_json(object.name, object.shape, components);
    Json& names = json["materials"] = Json::array();
    for (const MaterialId material : materials_of(scene, object))
        names.push_back(scene.materials[index_of(material)].name);
    return json;
}

Json light_json(const Light& light, const Scene& scene) {
    Json json{{"name", light.name}, {"type", type_of(light)}};
    for (const auto& [key, value] : details_of(light, scene::LightSurroundings(scene))) {
        Json& member = json[std::string(key)];
        std::visit([&](const auto& is) { member = is; }, value);
    }
    if (location_of(light) != LightLocation::infinity) json["flux_lm"] = flux_lm(scene, light).luminance();
    if (light.maintenance < 1) json["maintenance"] = light.maintenance;
    if (light.power_w) json["power_w"] = *light.power_w;
    return json;
}

Json luminaire_json(const NamedSolid& solid) {
    return {{"file", solid.file},
            {"format", solid.format},
            {"name", solid.luminaire},
            {"flux_lm", solid.solid.flux_lm()},
            {"peak_intensity_cd", solid.solid.peak_cd()},
            {"flux_check", solid.flux_statement},
            {"power_w", solid.power_w ? Json(*solid.power_w) : Json()}};
}

Json power_json(const scene::InstalledPower& power, std::span<const Sensor> sensors) {
    Json json{{"installed_w", power.power_w ? Json(*power.power_w) : Json()}, {"unknown", power.unknown}};
    const double area_m2 = sensors::task_area_m2(sensors);
    if (!power.power_w || !(area_m2 > 0)) return json;
    json["task_area_m2"] = area_m2;
    json["w_m2"] = *power.power_w / area_m2;
    return json;
}

Json camera_json(const Camera& camera) {
    return {{"resolution", camera.resolution},
            {"projection", name_of(camera.projection)},
            {"fov_deg", camera.fov_deg},
            {"filter", name_of(camera.filter)},
            {"position", vector_json(camera.position)},
            {"target", vector_json(camera.target)}};
}

Json sensor_json(const Sensor& sensor) {
    Json json{{"name", sensor.name}, {"type", sensor.type()}};
    if (const Camera* camera = sensor.camera()) {
        json.update(camera_json(*camera));
        return json;
    }
    for (const auto& [criterion, limit] : sensor.requirements)
        json["require"][std::string(criterion->key)] = limit;
    if (const Derived* derived = sensor.derived()) {
        json["formula"] = derived->formula.text();
        json["unit"] = derived->unit;
        return json;
    }
    Bounds bounds;
    for (const Measurand& measurand : sensor.measurands()) bounds.include(position_of(measurand));
    json["points"] = sensor.size();
    if (const auto count = sensor.count()) json["count"] = *count;
    if (const auto* area = std::get_if<Area>(&sensor.kind)) {
        json["spacing_m"] = area->cell_m;
        json["left_out"] = area->left_out;
    }
    json["extent"] = extent_json(bounds);
    return json;
}

Json run_json(const RunOptions& run) {
    Json json;
    run::for_each_value(run, [&](const auto& option, const auto& value) {
        const bool is_always_shown = option.key == "method" || option.key == "seed";
        if (!is_always_shown && run.*option.member == RunOptions{}.*option.member) return;
        json[fmt::format("{}{}{}", option.key, option.unit.empty() ? "" : "_", option.unit)] = value;
    });
    return json;
}

std::size_t mesh_bytes(const Scene& scene) {
    std::size_t bytes = 0;
    std::set<const void*> counted;  // what several objects share counts once
    for (const Object& object : scene.objects) {
        if (counted.insert(object.materials.data()).second)
            bytes += object.materials.size() * sizeof(MaterialId);
        const Mesh* mesh = geometry::stored_mesh(object.shape);
        if (mesh != nullptr && counted.insert(mesh).second)
            bytes += (mesh->vertices.size() + mesh->normals.size()) * sizeof(Vec3) +
                     (mesh->triangles.size() + mesh->corner_normals.size()) * sizeof(Triangle);
    }
    return bytes;
}

/// The peak memory of this process so far.
std::size_t peak_resident_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

template <typename List, typename Describe>
Json list_json(const List& list, const Describe& describe) {
    Json json = Json::array();
    for (const auto& item : list) json.push_back(describe(item));
    return json;
}

}  // namespace

InfoReport report_scene(const io::SceneFile& file, const std::string& name, const Monitor& monitor) {
    const Scene& scene = file.scene;
    const rays::RayCaster caster(scene, monitor, sensors::measured_points(file.sensors));
    monitor.report(kChecking, 0);
    const checks::Enclosures enclosures(scene, caster);
    double total_flux_lm = 0;
    for (const Light& light : scene.lights) {
        if (location_of(light) != LightLocation::infinity) total_flux_lm += flux_lm(scene, light).luminance();
    }

    Json json{{"stilb", program_version()}, {"file", name}, {"name", scene.name}};
    json["materials"] = list_json(scene.materials, material_json);
    json["objects"] = Json::array();
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        json["objects"].push_back(object_json(scene.objects[i], enclosures.components()[i], scene));
    json["lights"] = list_json(scene.lights, [&](const Light& light) { return light_json(light, scene); });
    json["total_flux_lm"] = total_flux_lm;
    if (const auto maintenance = scene::maintenance_factors(scene)) json["maintenance"] = *maintenance;
    json["luminaires"] = list_json(scene.solids, luminaire_json);
    const std::vector<Sensor> sensors =
        checks::without_hidden_points(scene, caster, enclosures, file.sensors);
    json["sensors"] = list_json(sensors, sensor_json);
    if (const auto power = scene::installed_power(scene); power.has_lamps())
        json["power"] = power_json(power, sensors);
    if (!file.notes.empty()) json["notes"] = file.notes;
    json["run"] = run_json(file.run);
    const std::vector<Warning> warnings =
        checks::scene_warnings(file.scene, caster, enclosures, sensors, file.warnings);
    json["warnings"] = texts_of(warnings);
    json["warning_kinds"] = kind_names_of(warnings);
    json["memory"] = {{"meshes_bytes", mesh_bytes(scene)},
                      {"peak_bytes", peak_resident_bytes()},
                      {"readings_bytes", run::memory_of_readings_bytes(sensors, file.run)}};
    return json;
}

InfoReport report_luminaire(const std::filesystem::path& path, UgrTables ugr) {
    const io::PhotometryFile file = io::read_photometry_file(path);
    const PhotometricSolid solid(file.grid);
    const std::string statement = check_flux(file, solid.flux_lm()).description();
    Json luminaire =
        luminaire_json({path.string(), file.luminaire, solid, file.format, statement, {}, file.power_w});
    luminaire["lamp_flux_lm"] = file.lamp_flux_lm;
    luminaire["opening_m"] = vector_json(file.opening_m);
    luminaire["planes"] = file.grid.planes_deg.size();
    luminaire["angles"] = file.grid.polar_deg.size();
    if (ugr == UgrTables::written) luminaire["ugr"] = ugr_json(file, solid, path.string());
    std::vector<std::string> warnings = photometry_warnings(file, solid);
    if (const auto of_opening = io::opening_warning(file)) warnings.push_back(*of_opening);
    return {{"stilb", program_version()},
            {"file", path.string()},
            {"luminaires", Json::array({luminaire})},
            {"warnings", warnings}};
}

InfoReport report_mesh(const std::filesystem::path& path, const Monitor& monitor) {
    io::MeshFile file = io::read_mesh_file(path, monitor);
    monitor.report(kChecking, 0);
    // Only the names of the parts are reported, and the memory of a large file counts.
    std::vector<std::uint32_t>().swap(file.material_of_triangle);
    std::vector<std::uint32_t>().swap(file.group_of_triangle);
    Scene scene;
    scene.objects.push_back({path.filename().string(), std::move(file.mesh), {}});
    const Shape& shape = scene.objects[0].shape;
    const std::vector components{find_components(shape)};
    Json object = shape_json(scene.objects[0].name, shape, components[0]);
    object["vertices"] = std::get<Mesh>(shape).vertices.size();
    object["degenerate_triangles_left_out"] = file.degenerate_triangles;
    object["materials"] = file.material_names;
    object["groups"] = file.group_names;
    file.degenerate_triangles = 0;  // has been reported
    std::vector<std::string> warnings = io::mesh_warnings(file);
    for (std::string& warning : checks::hole_warnings(scene, components))
        warnings.push_back(std::move(warning));
    return {{"stilb", program_version()},
            {"file", path.string()},
            {"objects", Json::array({object})},
            {"warnings", warnings},
            {"memory", {{"meshes_bytes", mesh_bytes(scene)}, {"peak_bytes", peak_resident_bytes()}}}};
}

}  // namespace stilb::cli
