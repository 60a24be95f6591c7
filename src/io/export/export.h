// Scenes as files of other programs: Mitsuba 3 and Radiance. What maps and what does not: docs/export.md.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene/scene_file.h"

namespace stilb::io {

enum class ExportFormat { mitsuba, radiance };
inline constexpr std::array<std::string_view, 2> kExportFormatNames{"mitsuba", "radiance"};

struct ExportReport {
    std::vector<std::filesystem::path> files;
    /// What has no equal in the other program, one sentence or two each.
    std::vector<std::string> warnings;
};

/// The format of that name. Throws InputError where there is none.
ExportFormat export_format(std::string_view name);

/// Writes the scene, its points and its views to a folder, which is made where it does not exist. Throws
/// InputError where files cannot be written, and where the folder holds one of the scene's own files.
ExportReport export_scene(const SceneFile& file, ExportFormat format, const std::filesystem::path& folder);

}  // namespace stilb::io
