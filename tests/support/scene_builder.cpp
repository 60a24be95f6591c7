#include "support/scene_builder.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace stilb {

Material diffuse(double reflectance) { return Diffuse{Rgb::grey(reflectance)}; }

MaterialId add_material(Scene& scene, const Material& material) {
    scene.materials.push_back({std::to_string(scene.materials.size()), material});
    return MaterialId{static_cast<std::uint32_t>(scene.materials.size() - 1)};
}

ObjectId add_object(Scene& scene, const Shape& shape, const Material& material) {
    scene.objects.push_back({std::to_string(scene.objects.size()), shape, {add_material(scene, material)}});
    return ObjectId{static_cast<std::uint32_t>(scene.objects.size() - 1)};
}

void add_point_light(Scene& scene, const Vec3& position, const Rgb& intensity_cd) {
    scene.lights.push_back({std::to_string(scene.lights.size()), PointLight{position, intensity_cd}});
}

void add_area_light(Scene& scene, const Shape& shape, const Rgb& luminance_cd_m2, const Material& material) {
    const ObjectId object = add_object(scene, shape, material);
    scene.lights.push_back({std::to_string(scene.lights.size()), AreaLight{object, luminance_cd_m2}});
}

void add_environment(Scene& scene, const Rgb& luminance_cd_m2) {
    scene.lights.push_back({std::to_string(scene.lights.size()), EnvironmentLight{luminance_cd_m2}});
}

void add_sky(Scene& scene, const Vec3& up, double rotation_deg) {
    Panorama::Image image{16, 8, {}};
    for (int row = 0; row < 8; ++row) {
        for (int column = 0; column < 16; ++column) {
            const auto level = static_cast<float>(row < 4 ? 100 - 15 * row : 20);
            image.rgb_cd_m2.push_back({0.7F * level, level, (row < 4 ? 1.5F : 0.5F) * level});
        }
    }
    image.rgb_cd_m2[2 * 16 + 9] = {600, 500, 350};
    EnvironmentLight light;
    light.panorama = std::make_shared<const Panorama>(std::move(image));
    light.axes = lights::panorama_axes(normalized(up), rotation_deg);
    scene.lights.push_back({std::to_string(scene.lights.size()), light});
}

void add_luminaire(Scene& scene, const Vec3& position, const PhotometricSolid& solid, const Vec3& unit_aim,
                   double spin_deg, const Rgb& factor) {
    const lights::LuminaireFrame frame = lights::aim_luminaire(unit_aim, spin_deg);
    const SolidId id{static_cast<std::uint32_t>(scene.solids.size())};
    scene.solids.push_back({.file = "solid", .luminaire = "", .solid = solid});
    scene.lights.push_back({std::to_string(scene.lights.size()),
                            Luminaire{position, id, frame.c0, frame.c90, frame.nadir, factor}});
}

void add_opening(Scene& scene, const Vec3& position, const PhotometricSolid& solid,
                 const lights::Opening& opening, const Vec3& unit_aim, double spin_deg, const Rgb& factor) {
    add_luminaire(scene, position, solid, unit_aim, spin_deg, factor);
    Luminaire luminaire = std::get<Luminaire>(scene.lights.back().source);
    const lights::OpeningShape shape = lights::shape_of(opening, luminaire, solid);
    luminaire.scale(Rgb::grey(1 / (1 - shape.hidden_share)));
    scene.lights.back().source = LuminousOpening{add_object(scene, shape.shape, Black{}), luminaire};
}

Mesh inward(const Box& box) {
    Mesh mesh = triangulated(box);
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

Rectangle wall(const Box& box, std::size_t axis, Side side) {
    const Vec3 e = box.max - box.min;
    const std::array<Vec3, 3> edges{Vec3{e.x, 0, 0}, Vec3{0, e.y, 0}, Vec3{0, 0, e.z}};
    const Vec3& u = edges[(axis + 1) % 3];
    const Vec3& v = edges[(axis + 2) % 3];
    if (side == Side::low) return {box.min, u, v};
    return {box.min + edges[axis], v, u};
}

void add_walls(Scene& scene, const Box& room, const std::array<Material, 6>& materials) {
    for (std::size_t i = 0; i < 6; ++i) {
        add_object(scene, wall(room, i / 2, i % 2 == 0 ? Side::low : Side::high), materials[i]);
    }
}

Mesh icosphere(const Sphere& sphere, int subdivisions) {
    Mesh mesh = geometry::inscribed_icosahedron({{}, 1});
    for (int level = 0; level < subdivisions; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_of;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, is_new] =
                middle_of.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
            if (is_new) {
                mesh.vertices.push_back(normalized(mesh.vertices[a]) + normalized(mesh.vertices[b]));
            }
            return found->second;
        };
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        mesh.triangles = std::move(finer);
    }
    for (Vec3& vertex : mesh.vertices) vertex = sphere.center + sphere.radius * normalized(vertex);
    return mesh;
}

Mesh smooth_icosphere(const Sphere& sphere, int subdivisions) {
    Mesh mesh = icosphere(sphere, subdivisions);
    for (const Vec3& vertex : mesh.vertices) mesh.normals.push_back(normalized(vertex - sphere.center));
    return mesh;
}

Sensor point_sensor(const std::vector<MeasuringPoint>& points) {
    return {"points", IlluminancePoints{points}};
}

}  // namespace stilb
