// Scenes for Mitsuba 3: scene.xml, meshes as PLY, and two Python files.
#include "io/export/mitsuba_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/mesh/mesh_file.h"

namespace stilb::io::exporting {
namespace {

bool has_right_angle(const Rectangle& r) {
    return std::abs(dot(r.edge_u, r.edge_v)) <= 1e-7 * length(r.edge_u) * length(r.edge_v);
}

std::string mesh_shape(const std::string& name, const Mesh& mesh, Output& output) {
    output.write(name + ".ply", to_ply(mesh, PlyNumbers::float32));
    return fmt::format(
        "  <shape type=\"ply\" id=\"{}\">\n    <string name=\"filename\" value=\"{}.ply\"/>\n{}", name, name,
        mesh.normals.empty() ? "    <boolean name=\"face_normals\" value=\"true\"/>\n" : "");
}

/// Mitsuba's unit rectangle or disk, with these columns.
std::string flat_shape(std::string_view type, const std::string& name, const Vec3& x, const Vec3& y,
                       const Vec3& middle) {
    const Vec3 z = normalized(cross(x, y));
    return fmt::format(
        "  <shape type=\"{}\" id=\"{}\">\n    <transform name=\"to_world\">\n      <matrix value=\"{:.15g} "
        "{:.15g} {:.15g} {:.15g} {:.15g} {:.15g} {:.15g} {:.15g} {:.15g} {:.15g} {:.15g} {:.15g} 0 0 0 "
        "1\"/>\n    "
        "</transform>\n",
        type, name, x.x, y.x, z.x, middle.x, x.y, y.y, z.y, middle.y, x.z, y.z, z.z, middle.z);
}

/// The beginning of a <shape>.
struct MitsubaShape {
    const std::string& name;
    Output& output;

    std::string operator()(const Mesh& mesh) const { return mesh_shape(name, mesh, output); }
    std::string operator()(const Instance& instance) const { return (*this)(triangulated(instance)); }
    std::string operator()(const Rectangle& r) const {
        if (!has_right_angle(r)) return mesh_shape(name, triangulated(r), output);
        return flat_shape("rectangle", name, r.edge_u / 2, r.edge_v / 2,
                          r.corner + r.edge_u / 2 + r.edge_v / 2);
    }
    std::string operator()(const Sphere& s) const {
        return fmt::format(
            "  <shape type=\"sphere\" id=\"{}\">\n    <point name=\"center\" x=\"{:.15g}\" y=\"{:.15g}\" "
            "z=\"{:.15g}\"/>\n    <float name=\"radius\" value=\"{:.15g}\"/>\n",
            name, s.center.x, s.center.y, s.center.z, s.radius);
    }
    std::string operator()(const Disk& d) const {
        const Frame frame = Frame::of_surface(d.normal);
        return flat_shape("disk", name, d.radius * frame.u, d.radius * frame.v, d.center);
    }
};

std::string mitsuba_shape(const Surface& surface, const std::string& material, Output& output) {
    std::string text = std::visit(MitsubaShape{surface.name, output}, surface.shape);
    text += fmt::format("    <ref id=\"{}\"/>\n", material);
    if (surface.luminance_cd_m2) {
        text += fmt::format(
            "    <emitter type=\"area\">\n      <rgb name=\"radiance\" value=\"{}\"/>\n    </emitter>\n",
            text_of(*surface.luminance_cd_m2));
    }
    return text + "  </shape>\n";
}

std::string camera_sensor(const Camera& camera, const std::string& id) {
    const std::string filter =
        camera.filter == PixelFilter::box
            ? "<rfilter type=\"box\"/>"
            : "<rfilter type=\"gaussian\"><float name=\"stddev\" value=\"0.5\"/></rfilter>";
    return fmt::format(
        "  <sensor type=\"perspective\" id=\"{}\">\n    <string name=\"fov_axis\" value=\"x\"/>\n    <float "
        "name=\"fov\" value=\"{:.15g}\"/>\n    <float name=\"near_clip\" value=\"0.001\"/>\n    <transform "
        "name=\"to_world\">\n      <lookat origin=\"{}\" target=\"{}\" up=\"{}\"/>\n    </transform>\n    "
        "<film type=\"hdrfilm\">\n      <integer name=\"width\" value=\"{}\"/>\n      <integer "
        "name=\"height\" value=\"{}\"/>\n      <string name=\"pixel_format\" value=\"rgb\"/>\n      <string "
        "name=\"component_format\" value=\"float32\"/>\n      {}\n    </film>\n    <sampler "
        "type=\"$sampler\">\n      <integer name=\"sample_count\" value=\"64\"/>\n    </sampler>\n  "
        "</sensor>\n",
        id, camera.fov_deg, text_of(camera.position), text_of(camera.target), text_of(camera.up),
        camera.resolution[0], camera.resolution[1], filter);
}

std::string mitsuba_cameras(const std::vector<Sensor>& sensors, Identifiers& identifiers, Output& output) {
    std::string text;
    for (const Sensor& sensor : sensors) {
        const Camera* camera = sensor.camera();
        if (!camera) continue;
        if (camera->projection == Projection::perspective) {
            text += camera_sensor(*camera, identifiers.make(sensor.name));
        } else {
            output.warn(
                "sensor", sensor.name,
                fmt::format("Mitsuba has no {} camera, so it is left out.", name_of(camera->projection)));
        }
    }
    return text;
}

/// Mitsuba's numbers of single precision have a resolution of a millimetre there.
void warn_of_far_coordinates(const Scene& scene, Output& output) {
    constexpr double farthest_m = 1e4;
    const Bounds bounds = scene::bounds_of(scene);
    double largest_m = 0;
    for (const Vec3& corner : {bounds.min, bounds.max}) {
        for (std::size_t axis = 0; axis < 3; ++axis) largest_m = std::max(largest_m, std::abs(corner[axis]));
    }
    if (largest_m <= farthest_m) return;
    output.warn(
        "format", "mitsuba",
        fmt::format(
            "the scene reaches to {:.3g} m from the origin, where Mitsuba's single precision resolves "
            "{:.2g} m. Move the scene to the origin first.",
            largest_m, largest_m * 0x1p-23));
}

}  // namespace

void write_mitsuba(const SceneFile& file, Output& output) {
    const Scene& scene = file.scene;
    warn_of_far_coordinates(scene, output);
    std::string xml =
        "<!-- Written by Stilb. Radiances stand for luminances in cd/m2, so that irradiances are lux: "
        "docs/export.md. -->\n<scene version=\"3.0.0\">\n  <integrator type=\"path\">\n    <integer "
        "name=\"max_depth\" value=\"-1\"/>\n  </integrator>\n  <default name=\"sampler\" "
        "value=\"independent\"/>\n";
    Identifiers identifiers;
    std::vector<std::string> materials;
    for (const NamedMaterial& material : scene.materials) {
        materials.push_back(identifiers.make("material_" + material.name));
        xml += mitsuba_material(material, materials.back(), output);
    }
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const auto& back = scene.materials[i].back;
        if (!back) continue;
        const std::string id = identifiers.make(materials[i] + "_sides");
        xml += fmt::format(
            "  <bsdf type=\"twosided\" id=\"{}\">\n    <ref id=\"{}\"/>\n    <ref id=\"{}\"/>\n  </bsdf>\n",
            id, materials[i], materials[index_of(*back)]);
        materials[i] = id;
    }
    for (const Surface& surface : surfaces_of(scene, identifiers, output)) {
        xml += mitsuba_shape(surface, materials[index_of(surface.material)], output);
    }
    for (const Light& light : scene.lights) {
        xml += mitsuba_light(scene, light, identifiers.make("light_" + light.name), output);
    }
    for (std::size_t i = 0; i < scene.solids.size(); ++i) {
        output.write(fmt::format("solid{}.dat", i), photometric_table(scene.solids[i].solid));
    }
    xml += mitsuba_cameras(file.sensors, identifiers, output) + "</scene>\n";
    output.write("scene.xml", xml);
    output.write("stilb_plugins.py", kMitsubaPlugins);
    output.write("measure.py", kMitsubaMeasure);
}

}  // namespace stilb::io::exporting
