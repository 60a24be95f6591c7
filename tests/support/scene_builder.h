// Scenes made in code, for tests: one line per object or light.
#pragma once

#include <array>
#include <vector>

#include "lights/opening_shape.h"
#include "materials/black.h"
#include "materials/diffuse.h"
#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb {

inline constexpr Vec3 kUp{0, 0, 1};

Material diffuse(double reflectance);

MaterialId add_material(Scene& scene, const Material& material);

ObjectId add_object(Scene& scene, const Shape& shape, const Material& material);

void add_point_light(Scene& scene, const Vec3& position, const Rgb& intensity_cd);

void add_area_light(Scene& scene, const Shape& shape, const Rgb& luminance_cd_m2,
                    const Material& material = Black{});

void add_environment(Scene& scene, const Rgb& luminance_cd_m2);

/// A blue sky that is brighter towards its top, a dark ground, and a small sun behind haze towards (2, -1,
/// 2), of 16 x 8 pixels; `up` is the direction of its top.
void add_sky(Scene& scene, const Vec3& up = {0, 0, 1}, double rotation_deg = 0);

void add_luminaire(Scene& scene, const Vec3& position, const PhotometricSolid& solid, const Vec3& unit_aim,
                   double spin_deg, const Rgb& factor);

/// A luminaire that shines from an opening.
void add_opening(Scene& scene, const Vec3& position, const PhotometricSolid& solid,
                 const lights::Opening& opening, const Vec3& unit_aim = {0, 0, -1}, double spin_deg = 0,
                 const Rgb& factor = Rgb::grey(1));

/// A box that is seen from inside: fronts inwards.
Mesh inward(const Box& box);

/// One wall of a box, front inwards; `axis` 0 to 2.
enum class Side { low, high };
Rectangle wall(const Box& box, std::size_t axis, Side side);

/// The whole room, one material for each wall: x low, x high, y low ...
void add_walls(Scene& scene, const Box& room, const std::array<Material, 6>& materials);

/// Twenty triangles, fronts outside; each divided into four `subdivisions` times, vertices on the sphere.
Mesh icosphere(const Sphere& sphere, int subdivisions);

/// The same with the sphere's normals at its vertices.
Mesh smooth_icosphere(const Sphere& sphere, int subdivisions);

Sensor point_sensor(const std::vector<MeasuringPoint>& points);

}  // namespace stilb
