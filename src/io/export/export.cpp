#include "io/export/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "io/export/parts.h"
#include "io/text/table.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

/// No file of the scene may lie in the folder, where a new file could replace it.
void require_folder_apart(const SceneFile& file, const std::filesystem::path& folder) {
    std::error_code ignored;
    for (const std::filesystem::path& source : file.sources) {
        const std::filesystem::path parent = source.has_parent_path() ? source.parent_path() : ".";
        if (!std::filesystem::equivalent(parent, folder, ignored)) continue;
        throw InputError("this folder holds a file of the scene, " + source.filename().string() +
                             ", which the export could replace. Choose another folder.",
                         {folder.string()});
    }
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder)) {
        throw InputError("the folder cannot be made. Check the path and its permissions.", {folder.string()});
    }
}

}  // namespace

ExportFormat export_format(std::string_view name) {
    const auto found = std::find(kExportFormatNames.begin(), kExportFormatNames.end(), name);
    if (found == kExportFormatNames.end()) {
        throw InputError(fmt::format("there is no format {}.{} Formats: mitsuba, radiance.", name,
                                     did_you_mean(name, kExportFormatNames)));
    }
    return static_cast<ExportFormat>(found - kExportFormatNames.begin());
}

ExportReport export_scene(const SceneFile& file, ExportFormat format, const std::filesystem::path& folder) {
    make_folder(folder);
    require_folder_apart(file, folder);
    exporting::Output output(folder);
    format == ExportFormat::mitsuba ? write_mitsuba(file, output) : write_radiance(file, output);
    write_points(file.sensors, output);
    return output.report();
}

}  // namespace stilb::io

namespace stilb::io::exporting {

void Output::write(const std::string& name, std::string_view content) {
    const std::filesystem::path path = folder_ / name;
    replace_file(path, content);
    files_.push_back(path);
}

std::string Identifiers::make(std::string_view name) {
    std::string wanted;
    for (const char c : name) {
        const bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                              c == '_' || c == '-';
        wanted += is_plain ? c : '_';
    }
    std::string identifier = wanted;
    for (int i = 2; !used_.insert(identifier).second; ++i) identifier = fmt::format("{}_{}", wanted, i);
    return identifier;
}

std::string no_equal(std::string_view type, std::string_view program, std::string_view instead) {
    return fmt::format("{} has no equal to type \"{}\": {}.", program, type, instead);
}

std::string text_of(const Vec3& vector) {
    return fmt::format("{:.15g} {:.15g} {:.15g}", vector.x, vector.y, vector.z);
}

std::string text_of(const Rgb& rgb) { return fmt::format("{:.9g} {:.9g} {:.9g}", rgb[0], rgb[1], rgb[2]); }

}  // namespace stilb::io::exporting
