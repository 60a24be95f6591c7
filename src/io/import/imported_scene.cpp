#include "io/import/imported_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/mesh_part.h"
#include "geometry/mesh_topology.h"
#include "io/text/utf8.h"
#include "materials/solid.h"
#include "scene/cut_lamps.h"
#include "scene/glass.h"
#include "scene/instances.h"
#include "scene/overlaps.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

/// A candle has about 12 lm; a lamp below this was probably given in another unit.
constexpr double kFaintestLamp_lm = 10;
/// The longest edge of a scene that is probably in metres.
constexpr double kSmallestScene_m = 0.5, kLargestScene_m = 2000;

/// Six times the volume below some triangles.
double volume_below(const Mesh& mesh, std::uint32_t component,
                    const geometry::ConnectedComponents& components) {
    double sum = 0;
    const Vec3& origin = mesh.vertices.front();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (components.of_triangle[t] != component) continue;
        const auto& [a, b, c] = mesh.triangles[t];
        sum += dot(mesh.vertices[a] - origin, cross(mesh.vertices[b] - origin, mesh.vertices[c] - origin));
    }
    return sum;
}

bool contains_all_of(const Bounds& outer, const Bounds& inner) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (inner.min[axis] < outer.min[axis] || inner.max[axis] > outer.max[axis]) return false;
    }
    return true;
}

/// Whether another object lies within the bounds of this one, as furniture in a room does.
bool surrounds_another(const Scene& scene, ObjectId object) {
    const Bounds own = bounds_of(scene.object(object).shape);
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        if (ObjectId{i} != object && contains_all_of(own, bounds_of(scene.objects[i].shape))) return true;
    }
    return false;
}

/// Turns faces of closed components to where their light goes: outwards, in a room inwards. Returns those of
/// open components, which shine to both sides.
std::vector<std::uint32_t> turn_to_shine(Mesh& mesh, std::span<const std::uint32_t> triangles, bool is_room) {
    const geometry::ConnectedComponents components = geometry::find_components(mesh);
    enum class Outside { unknown, front, back };
    std::vector<Outside> outside(components.count(), Outside::unknown);
    for (std::uint32_t c = 0; c < outside.size(); ++c) {
        if (components.is_closed(c))
            outside[c] = volume_below(mesh, c, components) < 0 ? Outside::back : Outside::front;
    }
    std::vector<std::uint32_t> open;
    for (const std::uint32_t t : triangles) {
        const Outside side = outside[components.of_triangle[t]];
        if (side == Outside::unknown) open.push_back(t);
        if (side == (is_room ? Outside::front : Outside::back)) turn_over(mesh, t);
    }
    return open;
}

/// The triangles from their other side, this far behind the mesh. Where they touch they stay together.
Mesh back_of(const Mesh& mesh, std::span<const std::uint32_t> triangles, double distance_m) {
    Mesh back = geometry::part_of(mesh, triangles);
    const std::vector<std::uint32_t> vertex_at = geometry::welded(back.vertices);
    std::vector<Vec3> backwards(back.vertices.size());
    for (const Triangle& triangle : back.triangles) {
        const auto& [a, b, c] = triangle;
        const Vec3 area = cross(back.vertices[c] - back.vertices[a], back.vertices[b] - back.vertices[a]);
        for (const std::uint32_t corner : triangle) backwards[vertex_at[corner]] += area;
    }
    for (std::size_t v = 0; v < back.vertices.size(); ++v) {
        const Vec3& direction = backwards[vertex_at[v]];
        if (squared_length(direction) > 0) back.vertices[v] += distance_m * normalized(direction);
    }
    for (std::uint32_t t = 0; t < back.triangles.size(); ++t) turn_over(back, t);
    for (Vec3& normal : back.normals) normal = -normal;
    return back;
}

std::vector<std::uint32_t> triangles_of(const Object& object, MaterialId material) {
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t t = 0; t < object.materials.size(); ++t) {
        if (object.materials[t] == material) triangles.push_back(t);
    }
    return triangles;
}

}  // namespace

std::string UniqueNames::make(std::string_view name, std::string_view otherwise) {
    std::string wanted = as_utf8(name.empty() ? otherwise : name);
    for (char& c : wanted) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7f || c == '/' || c == '\\') c = '_';
    }
    std::string unique = wanted;
    int& number = last_number_.try_emplace(wanted, 1).first->second;
    while (!used_.insert(unique).second) unique = fmt::format("{}_{}", wanted, ++number);
    return unique;
}

void drop_flat_normals(Mesh& mesh) {
    constexpr double kSmallestTilt = 1e-6;  // 1 - cosine, of normals in single precision
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const Vec3 own =
            normalized(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
        const Triangle& normals = mesh.corner_normals.empty() ? mesh.triangles[t] : mesh.corner_normals[t];
        for (const std::uint32_t index : normals) {
            if (mesh.normals.empty() || index == kNoNormal || mesh.normals[index] == Vec3{}) continue;
            if (std::abs(dot(mesh.normals[index], own)) < 1 - kSmallestTilt) return;
        }
    }
    mesh.normals.clear();
    mesh.corner_normals.clear();
}

ImportedScene::ImportedScene(const std::filesystem::path& path) {
    file.sources.push_back(path);
    file.scene.name = as_utf8(path.stem().string());
}

void ImportedScene::note(std::string_view sentence, WarningKind kind) {
    file.warnings.emplace_back(kind,
                               InputError(std::string(sentence), {file.sources.front().string()}).what());
}

void ImportedScene::remark_mean_texture(std::string_view material) {
    remarks_.add("material", material,
                 "the texture counts by its mean over the surface; import.textures=true shows it.");
}

MaterialId ImportedScene::add_material(std::string_view name, const Material& material) {
    file.scene.materials.push_back({materials_.make(name, "material"), material});
    return MaterialId{static_cast<std::uint32_t>(file.scene.materials.size() - 1)};
}

void ImportedScene::set_texture(MaterialId material, FaceTexture texture) {
    textures_.of_material[material] = std::move(texture);
}

namespace {

ImportedMesh simplified(ImportedMesh imported) {
    drop_flat_normals(imported.mesh);
    auto& materials = imported.materials;
    const bool is_one = std::ranges::all_of(materials, [&](MaterialId m) { return m == materials.front(); });
    if (is_one) materials = std::vector(1, materials.front());
    return imported;
}

}  // namespace

SharedMesh::SharedMesh(ImportedMesh imported) {
    imported = simplified(std::move(imported));
    mesh = std::make_shared<const Mesh>(std::move(imported.mesh));
    materials = std::move(imported.materials);
}

void ImportedScene::add_object(std::string_view name, ImportedMesh imported) {
    imported = simplified(std::move(imported));
    const ObjectId id = add_object(name, std::move(imported.mesh), std::move(imported.materials));
    if (!imported.places.empty()) textures_.places[id] = std::move(imported.places);
}

ObjectId ImportedScene::add_object(std::string_view name, Shape shape, SharedList<MaterialId> materials) {
    file.scene.objects.push_back({objects_.make(name, "object"), std::move(shape), std::move(materials)});
    return ObjectId{static_cast<std::uint32_t>(file.scene.objects.size() - 1)};
}

void ImportedScene::add_instance(std::string_view name, const SharedMesh& shared,
                                 const geometry::Transform& to_world) {
    add_object(name, Instance{shared.mesh, to_world}, shared.materials);
}

void ImportedScene::add_light(std::string_view name, lights::LightSource source, std::string_view group) {
    file.scene.lights.push_back({lights_.make(name, "light"), std::move(source), std::string(group)});
}

void ImportedScene::add_sensor(std::string_view name, sensors::SensorKind kind) {
    file.sensors.push_back({sensors_.make(name, "sensor"), std::move(kind)});
}

void ImportedScene::light_triangles(ObjectId object, MaterialId material,
                                    std::vector<std::uint32_t> triangles, const Emission& emission) {
    Scene& scene = file.scene;
    scene::make_own_mesh(scene.objects[index_of(object)]);
    auto& mesh = std::get<Mesh>(scene.objects[index_of(object)].shape);
    std::optional<Object> back;
    if (emission.both_sides) {
        const std::vector<std::uint32_t> open =
            turn_to_shine(mesh, triangles, surrounds_another(scene, object));
        // More than points are lifted off surfaces; and little beside the lamp, however small it is.
        constexpr double usual_m = 1e-4, of_lamp = 1e-3, of_scene = 4e-6;
        const Bounds bounds = geometry::bounds_of(mesh);
        const double distance_m = std::max(std::min(usual_m, of_lamp * length(bounds.max - bounds.min)),
                                           of_scene * bounds_of(scene).half_extent());
        if (!open.empty()) back = Object{"", back_of(mesh, open, distance_m), {material}};
    }
    const std::string whole = scene.object(object).name;
    const std::string part = fmt::format("{} ({})", whole, scene.materials[index_of(material)].name);
    const bool is_whole = triangles.size() == mesh.triangles.size();
    const ObjectId lamp =
        is_whole ? object : scene::cut_out(scene, object, triangles, objects_.make(part, "lamp"));
    const std::string name = is_whole ? whole : part;
    if (scene::remove_repeated_faces(scene.objects[index_of(lamp)]) > 0)
        warnings.add("lamp", name, "some of its faces lie on others of it; each place shines once.");
    add_light(name, AreaLight{lamp, emission.luminance_cd_m2});
    if (!back) return;
    back->name = objects_.make(name + " (back)", "lamp");
    const ObjectId behind{static_cast<std::uint32_t>(scene.objects.size())};
    scene.objects.push_back(std::move(*back));
    add_light(name + " (back)", AreaLight{behind, emission.luminance_cd_m2});
}

void ImportedScene::light_faces(ObjectId id) {
    for (const auto& [material, emission] : emissions_) {
        const Object& object = file.scene.object(id);
        std::vector<std::uint32_t> triangles;
        if (object.materials.size() > 1) {
            triangles = triangles_of(object, material);
        } else if (object.materials.front() == material) {
            const Mesh* const mesh = geometry::stored_mesh(object.shape);
            if (mesh == nullptr) continue;
            triangles.resize(mesh->triangles.size());
            for (std::uint32_t t = 0; t < triangles.size(); ++t) triangles[t] = t;
        }
        if (!triangles.empty()) light_triangles(id, material, std::move(triangles), emission);
    }
}

void ImportedScene::warn_of_units(double light_scale) {
    const Bounds bounds = bounds_of(file.scene);
    const double longest_m = 2 * bounds.half_extent();
    if (!file.scene.objects.empty() && (longest_m < kSmallestScene_m || longest_m > kLargestScene_m)) {
        note(fmt::format(
            "the scene is {:.3g} m long. If its unit is another than the metre, give the metres in "
            "one: --set import.scale=0.001",
            longest_m));
    }
    bool has_daylight = false;
    for (const Light& light : file.scene.lights)
        has_daylight = has_daylight || location_of(light) == LightLocation::infinity;
    for (const Light& light : file.scene.lights) {
        if (has_daylight) return;
        const double flux_lm = light_scale * scene::flux_lm(file.scene, light).luminance();
        if (flux_lm >= kFaintestLamp_lm) continue;
        warnings.add(
            "light", fmt::format("{} ({:.3g} lm)", light.name, flux_lm),
            "this is less than a candle. If the file gives watts in place of lumens, as some exporters "
            "do, scale all light: --set import.light_scale=683 (lm per W)");
    }
}

void ImportedScene::scale_colours_of_glass(double scale) {
    for (NamedMaterial& named : file.scene.materials) {
        const auto* glass = named.material.get_if<Dielectric>();
        if (glass == nullptr || scale == 1) continue;
        materials::Medium inside = glass->inside(), outside = glass->outside;
        for (materials::Medium* medium : {&inside, &outside}) {
            for (double& per_m : medium->absorption_per_m) per_m /= scale;
        }
        named.material = materials::between_media(named.material, inside, outside);
    }
}

void ImportedScene::settle_faces(const ImportSettings& settings) {
    // Holes matter by their area, not by their outlines.
    constexpr TextureLimits of_holes{20'000, 400'000};
    apply_textures(file.scene, textures_, materials_, remarks_, warnings,
                   settings.options().textures ? TextureLimits{} : of_holes);
    const std::vector<std::string> notes = remarks_.list();
    file.notes.insert(file.notes.end(), notes.begin(), notes.end());
    const auto count = static_cast<std::uint32_t>(file.scene.objects.size());
    if (count == 0)
        throw InputError("the scene has no surface: there is nothing to light.", {file.sources[0].string()});
    for (std::uint32_t i = 0; i < count; ++i) light_faces(ObjectId{i});
    scale_colours_of_glass(settings.options().scale.value_or(1));
    std::ranges::move(scene::settle_glass(file.scene), std::back_inserter(file.warnings));
    warn_of_units(settings.options().light_scale);
}

SceneFile ImportedScene::finish(const ImportSettings& settings) && {
    scene::put_lamps_in_front(file.scene);
    settings.scale_lights(file);
    if (file.scene.lights.empty()) note(kNoLight, WarningKind::no_light);
    const std::string prefix = file.sources[0].string() + ": ";
    for (const std::string& warning : warnings.list()) file.warnings.push_back(prefix + warning);
    settings.apply_to(file);
    return std::move(file);
}

}  // namespace stilb::io
