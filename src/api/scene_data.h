// The content of the library's scenes.
#pragma once

#include <filesystem>
#include <utility>

#include "io/scene/scene_file.h"
#include "run/options.h"
#include "run/prepared_scene.h"
#include "stilb/scene.h"

namespace stilb::api {

struct Scene::Data {
    io::SceneFile file;
    std::filesystem::path path;  ///< of the scene file; empty where the scene was made otherwise
    run::PreparedScene prepared{file.scene};

    Data(io::SceneFile read, std::filesystem::path from) : file(std::move(read)), path(std::move(from)) {}
};

/// The options of a run: those given, or those of the scene. Throws InputError where one is wrong.
RunOptions run_options(const Scene& scene, const std::optional<Options>& options);

}  // namespace stilb::api
