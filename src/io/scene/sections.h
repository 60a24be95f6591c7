// The sections of a scene file, each read by its own source file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/warning.h"
#include "geometry/transform.h"
#include "io/scene/defaults.h"
#include "io/scene/mesh_parts.h"
#include "io/scene/scene_file.h"
#include "io/scene/toml.h"

namespace stilb::io {

struct NamedTable {
    std::string name;
    TomlTable table;
};
/// The tables of the section; throws for names that cannot be part of a file name.
std::vector<NamedTable> named_tables(const TomlTable& section);
/// The same, each table with the defaults that it takes.
std::vector<NamedTable> named_tables(const TomlTable& section, const Defaults& defaults);

/// Adds the section's materials to the scene, and behind all of these the materials of backs.
void read_materials(const TomlTable& section, const Defaults& defaults, Scene& scene);
/// Objects refer to the materials of `file.scene`. Returns the parts of those that are meshes.
PartsOfObjects read_objects(const TomlTable& section, const std::filesystem::path& directory, SceneFile& file,
                            const Monitor& monitor);

/// What lights depend on, besides their section.
struct LightContext {
    Defaults defaults;
    double maintenance = 1;  ///< of lights that do not give their own
    PartsOfObjects parts;
    const std::filesystem::path& directory;
};
/// Area lights refer to the objects of `file.scene`; those of some faces and luminous spheres add theirs.
void read_lights(const TomlTable& section, LightContext context, SceneFile& file);

void read_sensors(const TomlTable& section, const Defaults& defaults, SceneFile& file);
/// The areas that a sensor of type "plane" stands for, and its keys.
std::vector<std::string_view> plane_keys();
std::vector<Sensor> read_planes(const std::string& name, TomlTable& table, const Scene& scene);
RunOptions read_run(TomlTable section);
/// The key maintenance of [run] or of a light; `otherwise` where it is missing.
double read_maintenance(const TomlTable& table, double otherwise);

// All types with their keys.
std::vector<TypeKeys> material_types();
std::vector<TypeKeys> object_shapes();
std::vector<TypeKeys> light_types();
/// Those of lights that take defaults: daylight is not a lamp.
std::vector<TypeKeys> lamp_types();
std::vector<TypeKeys> sensor_types();

/// The body of a luminaire in its own coordinates, a mesh: the name of its file, or a table of the keys of
/// such an object.
Object read_body(const TomlItem& item, const std::filesystem::path& directory, SceneFile& file);

/// The keys scale, rotate, translate or transform of an object.
geometry::Transform read_transform(const TomlTable& object);

/// The elements of a list of triples, each a `what`.
std::vector<TomlItem> read_list(const TomlItem& list, std::string_view what);
/// A direction as a unit vector, with a warning where its length was far from 1.
Vec3 read_direction(const TomlItem& item, std::vector<Warning>& warnings);
/// The keys file or coefficients, degree, intersection, lod. The centre comes from the file; with
/// coefficients it is the origin.
Harmonics read_harmonic_shape(const TomlTable& table, const std::filesystem::path& directory,
                              SceneFile& file);
/// The keys corner, edge_u, edge_v.
Rectangle read_rectangle(const TomlTable& table);

}  // namespace stilb::io
