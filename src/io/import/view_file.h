// Views as other programs keep them: view files of Radiance, and pictures.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/transform.h"
#include "io/scene/scene_file.h"
#include "sensors/camera.h"

namespace stilb::io {

struct ViewFile {
    Camera camera;
    std::vector<std::string> warnings;  ///< what a camera cannot have
    bool is_of_stilb = false;           ///< a picture of Stilb: its view has the coordinates of its scene
};

/// A picture (.exr, .hdr) gives its own view and size. Other files are view files of Radiance: lines of `rvu`
/// or `rpict`, "VIEW=", or options alone. Each changes the view that the lines before it made; the last one
/// counts. A picture of it has 1280 pixels along its longer side, or fits the options -x and -y. Throws
/// InputError with file and line.
ViewFile read_view_file(const std::filesystem::path& path);
/// The reader of view files for content in memory; `name` is used in messages.
ViewFile read_view_file(std::string_view content, const std::string& name);

/// Adds the view as a camera with the name of the file, and its warnings. Returns the name of the camera.
/// `placement`: from the coordinates of views of other programs to those of the scene.
std::string add_view(const std::filesystem::path& path, const geometry::Transform& placement,
                     SceneFile& file);

}  // namespace stilb::io
