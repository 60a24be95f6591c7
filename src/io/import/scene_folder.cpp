#include "io/import/scene_folder.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "io/import/scene_parts.h"
#include "io/scene/toml_text.h"
#include "io/text/table.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

constexpr std::string_view kSceneMark = "# A scene imported by Stilb";

/// Each line of the text as a comment of TOML.
std::string commented(const std::string& text) {
    std::string result = "# ";
    for (const char c : text) {
        if (c == '\n')
            result += "\n# ";
        else if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f)
            result += c;
    }
    return result + "\n";
}

std::string heading(const SceneFile& file) {
    std::string text = fmt::format("{} from {}.\n# Keys and values: docs/scene-format.md\n", kSceneMark,
                                   file.sources.front().filename().string());
    if (!file.warnings.empty()) text += "#\n# Warnings of the import:\n";
    for (const Warning& warning : file.warnings) text += commented(warning.text);
    return text;
}

/// The options that differ from those of a run without any.
TomlMembers run_table(const RunOptions& run) {
    TomlMembers members;
    run::for_each_value(run, [&](const auto& option, const auto& value) {
        if (run.*option.member != RunOptions{}.*option.member)
            members.push_back({std::string(option.key), 0, toml_value(value)});
    });
    return members;
}

void make_scene_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder))
        throw InputError("the folder cannot be made. Check the path and its permissions.", {folder.string()});
    const std::filesystem::path scene = folder / "scene.toml";
    if (!std::filesystem::exists(scene)) return;
    if (read_beginning(scene, kSceneMark.size()) != kSceneMark) {
        throw InputError(
            "this scene was not written by stilb import and would be lost. Choose another folder.",
            {scene.string()});
    }
}

}  // namespace

std::string SceneOutput::write(std::string_view name, std::string_view extension, std::string_view content) {
    std::string wanted;
    for (const char c : name) {
        const bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                              c == '_' || c == '-' || c == '.';
        wanted += is_plain ? c : '_';
    }
    std::string unique = fmt::format("{}{}", wanted, extension);
    for (int i = 2; !names_.insert(unique).second; ++i) unique = fmt::format("{}_{}{}", wanted, i, extension);
    replace_file(folder_ / unique, content);
    files_.push_back(folder_ / unique);
    return unique;
}

std::string SceneOutput::write_once(std::string_view name, std::string_view extension,
                                    const std::string& content) {
    const auto known = written_.find(content);
    if (known != written_.end()) return known->second;
    return written_[content] = write(name, extension, content);
}

std::vector<std::filesystem::path> write_scene_folder(const SceneFile& file,
                                                      const std::filesystem::path& folder) {
    make_scene_folder(folder);
    SceneOutput output(folder);
    TomlMembers document;
    const auto add = [&](std::string section, TomlMembers members) {
        if (!members.empty()) document.push_back({std::move(section), 0, {std::move(members)}});
    };
    if (!file.scene.name.empty()) add("scene", {{"name", 0, toml_text(file.scene.name)}});
    add("materials", material_tables(file.scene));
    add("objects", object_tables(file.scene, output));
    add("lights", light_tables(file, output));
    add("sensors", sensor_tables(file.sensors));
    add("run", run_table(file.run));
    const std::filesystem::path scene = folder / "scene.toml";
    replace_file(scene, heading(file) + to_toml(document));
    std::vector<std::filesystem::path> files{scene};
    files.insert(files.end(), output.files().begin(), output.files().end());
    return files;
}

}  // namespace stilb::io
