// What the verification cases' scenes are made of.
#pragma once

#include <numbers>
#include <vector>

#include "scene/scene.h"

namespace stilb::verification {

/// Directions each turned by it against the last never line up.
inline constexpr double kGoldenAngle = 2 * std::numbers::pi * (2 - std::numbers::phi);

MaterialId add_material(Scene& scene, const Material& material);
ObjectId add_object(Scene& scene, const Shape& shape, const Material& material);
void add_area_light(Scene& scene, ObjectId object, double luminance_cd_m2);

/// Of the same luminance all around.
void add_environment(Scene& scene, double luminance_cd_m2);

inline Diffuse diffuse(double reflectance) { return {Rgb::grey(reflectance)}; }

/// `count` unit vectors spread evenly over the sphere: a Fibonacci spiral, from +z to -z.
std::vector<Vec3> spread_directions(int count);

}  // namespace stilb::verification
