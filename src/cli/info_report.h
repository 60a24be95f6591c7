// What files hold, as a JSON document and as text for people.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "io/scene/scene_file.h"

namespace stilb::cli {

/// The sections materials, objects, lights, luminaires, sensors, run, memory and warnings; those that do not
/// apply are left out. Keys carry their units; `stilb info --help` names them.
using InfoReport = nlohmann::ordered_json;

/// Everything that the scene file holds, checked as one (open edges, overlaps, unlit objects, placement).
InfoReport report_scene(const io::SceneFile& file, const std::string& name);
/// A luminaire file (IES or EULUMDAT) or a mesh file (OBJ or PLY) on its own.
InfoReport report_luminaire(const std::filesystem::path& path);
InfoReport report_mesh(const std::filesystem::path& path);

std::string to_text(const InfoReport& report);

}  // namespace stilb::cli
