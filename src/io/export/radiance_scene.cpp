// Scenes for Radiance: scene.rad, a view NAME.vf of each camera, and tables of luminaires.
#include "io/export/radiance_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "io/image/picture.h"

namespace stilb::io::exporting {
namespace {

void add_polygon(std::string& text, const std::string& modifier, const std::string& name,
                 const std::vector<Vec3>& corners) {
    std::vector<double> numbers;
    for (const Vec3& corner : corners) numbers.insert(numbers.end(), {corner.x, corner.y, corner.z});
    text += radiance_primitive(modifier, "polygon", name, {}, numbers);
}

struct RadianceShape {
    const std::string& modifier;
    const std::string& name;

    std::string operator()(const Mesh& mesh) const {
        std::string text;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto& [a, b, c] = mesh.triangles[t];
            add_polygon(text, modifier, fmt::format("{}.{}", name, t),
                        {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
        }
        return text;
    }
    std::string operator()(const Rectangle& r) const {
        std::string text;
        add_polygon(text, modifier, name,
                    {r.corner, r.corner + r.edge_u, r.corner + r.edge_u + r.edge_v, r.corner + r.edge_v});
        return text;
    }
    std::string operator()(const Sphere& s) const {
        return radiance_primitive(modifier, "sphere", name, {},
                                  {s.center.x, s.center.y, s.center.z, s.radius});
    }
    std::string operator()(const Disk& d) const {
        return radiance_primitive(
            modifier, "ring", name, {},
            {d.center.x, d.center.y, d.center.z, d.normal.x, d.normal.y, d.normal.z, 0, d.radius});
    }
    std::string operator()(const Instance& instance) const { return (*this)(triangulated(instance)); }
    std::string operator()(const Box& box) const { return (*this)(triangulated(box)); }
    std::string operator()(const Harmonics&) const { return ""; }
};

bool has_normals(const Surface& surface) {
    const Mesh* mesh = std::get_if<Mesh>(&surface.shape);
    return mesh && !mesh->normals.empty();
}

/// The luminous surface, and the name of its modifier.
std::string luminous_material(const Surface& surface, const std::string& id) {
    const Rgb radiance = *surface.luminance_cd_m2 * (1 / kRadianceEfficacy_lm_w);
    return radiance_primitive("void", "light", id, {}, {radiance[0], radiance[1], radiance[2]});
}

void write_views(const std::vector<Sensor>& sensors, Output& output) {
    Identifiers identifiers;
    for (const Sensor& sensor : sensors) {
        const Camera* camera = sensor.camera();
        if (!camera) continue;
        if (camera->projection == Projection::panorama) {
            output.warn("sensor", sensor.name, "Radiance has no equirectangular view, so it is left out.");
            continue;
        }
        output.write(identifiers.make(sensor.name) + ".vf",
                     "rvu " + view_field(*camera).text + " -vo 0 -va 0 -vs 0 -vl 0\n");
    }
}

}  // namespace

std::string radiance_primitive(std::string_view modifier, std::string_view type, std::string_view name,
                               const std::vector<std::string>& texts, const std::vector<double>& numbers) {
    std::string text = fmt::format("{} {} {}\n{}", modifier, type, name, texts.size());
    for (const std::string& word : texts) text += " " + word;
    text += fmt::format("\n0\n{}", numbers.size());
    for (const double number : numbers) text += fmt::format(" {:.15g}", number);
    return text + "\n\n";
}

std::string radiance_opening(const Shape& shape, const std::string& modifier, const std::string& name) {
    const auto* mesh = std::get_if<Mesh>(&shape);
    if (!mesh) return std::visit(RadianceShape{modifier, name}, shape);
    // The triangles of a face begin at its first vertex, and its vertices follow one another.
    std::string text;
    for (std::size_t t = 0; t < mesh->triangles.size();) {
        const auto& [first, second, third] = mesh->triangles[t];
        std::size_t end = t;
        while (end < mesh->triangles.size() && mesh->triangles[end][0] == first) ++end;
        const auto corners = static_cast<std::ptrdiff_t>(end - t + 2);
        const auto begin = mesh->vertices.begin() + first;
        std::vector<Vec3> face(begin, begin + corners);
        if (second > third) std::ranges::reverse(face);
        add_polygon(text, modifier, fmt::format("{}.{}", name, t), face);
        t = end;
    }
    return text;
}

void write_radiance(const SceneFile& file, Output& output) {
    const Scene& scene = file.scene;
    std::string text =
        "# Written by Stilb. Radiances are luminances / 179 lm/W; irradiances times 179 are lux: "
        "docs/export.md.\n\n";
    Identifiers identifiers;
    std::vector<std::string> materials;
    for (const NamedMaterial& material : scene.materials) {
        materials.push_back(identifiers.make("material_" + material.name));
        text += radiance_material(material, materials.back(), output);
    }
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const auto& back = scene.materials[i].back;
        if (!back) continue;
        const std::string id = identifiers.make(materials[i] + "_sides");
        text += radiance_primitive("void", "mixfunc", id,
                                   {materials[i], materials[index_of(*back)], "if(Rdot,1,0)", "."}, {});
        materials[i] = id;
    }
    for (const Surface& surface : surfaces_of(scene, identifiers, output)) {
        std::string modifier = materials[index_of(surface.material)];
        if (surface.luminance_cd_m2) {
            modifier = identifiers.make("light_" + surface.name);
            text += luminous_material(surface, modifier);
            if (materials::reflectance_bound(scene.material(surface.material)).max() > 0) {
                output.warn("object", surface.name,
                            "in Radiance a surface that gives light reflects nothing.");
            }
        }
        if (has_normals(surface)) {
            output.warn("object", surface.name, "its smooth mesh becomes flat triangles.");
        }
        text += std::visit(RadianceShape{modifier, surface.name}, surface.shape);
    }
    for (const Light& light : scene.lights) {
        text += radiance_light(scene, light, identifiers.make("light_" + light.name), output);
    }
    for (std::size_t i = 0; i < scene.solids.size(); ++i) {
        output.write(fmt::format("solid{}.dat", i), photometric_table(scene.solids[i].solid));
    }
    if (!scene.solids.empty()) output.write("luminaire.cal", kLuminaireFunctions);
    output.write("scene.rad", text);
    write_views(file.sensors, output);
}

}  // namespace stilb::io::exporting
