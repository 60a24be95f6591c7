// The header of the container "scene": all that is no long list of numbers.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "sensors/sensor.h"
#include "walk/data/highlight_points.h"
#include "walk/display/coarse_triangles.h"
#include "walk/display/display_mesh.h"

namespace stilb::walk {

/// [x, y, z]
nlohmann::ordered_json json_of(const Vec3& v);
nlohmann::ordered_json json_of(const Rgb& rgb);

/// Name, type and parameters as in scene files; the tables of reflection are not part of it.
nlohmann::ordered_json json_of(const NamedMaterial& material);
/// `group`: number of its group; `first`, `count`: its highlight points.
nlohmann::ordered_json json_of(const Scene& scene, const Light& light, std::size_t group, std::size_t first,
                               std::size_t count);
nlohmann::ordered_json json_of_cameras(const std::vector<Sensor>& sensors);
/// All but cameras; of several points the middle one.
nlohmann::ordered_json json_of_other_sensors(const std::vector<Sensor>& sensors);
nlohmann::ordered_json json_of_meshes(const Scene& scene, const std::vector<DisplayPart>& parts,
                                      const CoarseTriangles& coarse);

}  // namespace stilb::walk
