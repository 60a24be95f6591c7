// The contents of files, as a JSON document and as text.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "base/monitor.h"
#include "io/scene/scene_file.h"

namespace stilb::cli {

/// The sections materials, objects, lights, luminaires, sensors, run, memory and warnings; sections that do
/// not apply are left out. Keys carry their units; `stilb info --help` names them.
using InfoReport = nlohmann::ordered_json;

/// The contents of the scene file, and the warnings of all checks of a scene (open edges, overlaps, unlit
/// objects, placement). The monitor takes the progress, as it does of report_mesh.
InfoReport report_scene(const io::SceneFile& file, const std::string& name, const Monitor& monitor);
enum class UgrTables { written, left_out };
/// The contents of a luminaire file (IES or EULUMDAT) or of a mesh file (OBJ or PLY).
InfoReport report_luminaire(const std::filesystem::path& path, UgrTables ugr);
InfoReport report_mesh(const std::filesystem::path& path, const Monitor& monitor);

std::string to_text(const InfoReport& report);

}  // namespace stilb::cli
