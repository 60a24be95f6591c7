// The sections of a scene file that import writes, each by its own source file.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene/scene_file.h"
#include "io/scene/toml.h"

namespace stilb::io {

/// The folder that is written.
class SceneOutput {
  public:
    explicit SceneOutput(std::filesystem::path folder) : folder_(std::move(folder)) {}
    /// Writes a file that is named after something in the scene, and returns its name in the folder.
    std::string write(std::string_view name, std::string_view extension, std::string_view content);
    /// The same, but a file with this content and name that was written before is taken again.
    std::string write_once(std::string_view name, std::string_view extension, const std::string& content);
    const std::vector<std::filesystem::path>& files() const { return files_; }

  private:
    std::filesystem::path folder_;
    std::set<std::string> names_;
    std::map<std::string, std::string> written_;  ///< names by content
    std::vector<std::filesystem::path> files_;
};

TomlMembers material_tables(const Scene& scene);
/// The objects without the lamps that were cut out of them, which their lights cut out again.
TomlMembers object_tables(const Scene& scene, SceneOutput& output);
TomlMembers light_tables(const SceneFile& file, SceneOutput& output);
TomlMembers sensor_tables(const std::vector<Sensor>& sensors);

/// The name of the faces of a lamp that was cut out of an object, in the mesh file of that object.
std::string part_name(const Scene& scene, ObjectId lamp);

}  // namespace stilb::io
