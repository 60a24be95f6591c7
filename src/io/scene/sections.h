// The sections of a scene file, each read by its own source file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/transform.h"
#include "io/scene/scene_file.h"
#include "io/scene/toml.h"

namespace stilb::io {

struct NamedTable {
    std::string name;
    TomlTable table;
};
/// The tables of the section; throws for names that cannot be part of a file name.
std::vector<NamedTable> named_tables(const TomlTable& section);

std::vector<NamedMaterial> read_materials(const TomlTable& section);
/// Objects refer to the materials of `file.scene`.
void read_objects(const TomlTable& section, const std::filesystem::path& directory, SceneFile& file);
/// Area lights refer to the objects of `file.scene`; luminous spheres add theirs.
void read_lights(const TomlTable& section, const std::filesystem::path& directory, SceneFile& file);
void read_sensors(const TomlTable& section, SceneFile& file);
RunOptions read_run(TomlTable section);

/// The keys scale, rotate, translate or transform of an object.
geometry::Transform read_transform(const TomlTable& object);

/// A direction as a unit vector, with a warning where its length was far from 1.
Vec3 read_direction(const TomlItem& item, std::vector<std::string>& warnings);
/// The keys file or coefficients, degree, intersection, lod. The centre comes from the file; with
/// coefficients it is the origin.
Harmonics read_harmonic_shape(const TomlTable& table, const std::filesystem::path& directory,
                              SceneFile& file);
/// The keys corner, edge_u, edge_v.
Rectangle read_rectangle(const TomlTable& table);

}  // namespace stilb::io
