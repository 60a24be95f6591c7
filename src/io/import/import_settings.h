// What the user may state beside a scene of another format: its units, and keys of scene files that such a
// format lacks.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "geometry/transform.h"
#include "io/scene/scene_file.h"
#include "io/scene/toml.h"

namespace stilb::io {

enum class UpAxis { y, z };

/// The table `import` of the overrides: import.scale, import.up, import.light_scale, import.textures.
struct ImportOptions {
    std::optional<double> scale;  ///< metres per unit of length of the file; nothing: as the format decides
    std::optional<UpAxis> up;     ///< the axis of the file that points upwards; nothing: likewise
    double light_scale = 1;       ///< factor on all light
    bool textures = false;        ///< surfaces show their textures; otherwise their mean colours

    /// To metres with z upwards; `usual`: the axis that points upwards in files of the format.
    geometry::Transform to_world(UpAxis usual) const;
    bool operator==(const ImportOptions&) const = default;
};

/// The overrides (--set KEY=VALUE) of a scene that is no TOML file: the tables `import`, `run` and `sensors`.
class ImportSettings {
  public:
    /// `name`: the scene's file, for messages. Throws InputError for other tables and wrong values.
    ImportSettings(std::span<const std::string> overrides, std::string name);

    const ImportOptions& options() const { return options_; }
    void scale_lights(SceneFile& file) const;
    /// Reads the sensors and the options of the run; scales the lamps by the maintenance factor.
    void apply_to(SceneFile& file) const;

  private:
    TomlTable section(std::string_view key) const;

    std::string name_;
    std::vector<std::string> overrides_;
    TomlMembers document_;
    TomlMembers nothing_;
    ImportOptions options_;
};

/// The turn that makes z point upwards, and the scale to metres.
geometry::Transform to_metres_and_z_up(double scale, UpAxis up);

}  // namespace stilb::io
