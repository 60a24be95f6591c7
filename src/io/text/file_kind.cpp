#include "io/text/file_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "io/text/table.h"
#include "io/text/text.h"
#include "io/text/utf8.h"
#include "stilb/error.h"

namespace stilb::io {

namespace {

/// As many bytes as tell the kind: the keys that tell JSON documents apart stand near their beginnings.
constexpr std::size_t kBeginningSize = 4096;

struct Beginning {
    std::string_view bytes;
    FileKind kind;
};

constexpr std::array kBeginnings{
    Beginning{"\x76\x2f\x31\x01", FileKind::exr_picture},
    Beginning{"#?", FileKind::hdr_picture},
    Beginning{"\x89PNG\r\n\x1a\n", FileKind::png_picture},
    Beginning{kSolutionBeginning, FileKind::solution},
    Beginning{kRunBeginning, FileKind::run},
    Beginning{"ply\n", FileKind::ply_mesh},
    Beginning{"ply\r", FileKind::ply_mesh},
    Beginning{"IESNA", FileKind::ies_luminaire},
    Beginning{"IES:LM", FileKind::ies_luminaire},
    Beginning{"ANSI/IES", FileKind::ies_luminaire},
    Beginning{"glTF", FileKind::gltf_scene},
    Beginning{"ISO-10303-21;", FileKind::ifc_building},
    Beginning{"LOCATION,", FileKind::weather},
    Beginning{"AC10", FileKind::drawing},
};

struct Extension {
    std::string_view text;
    FileKind kind;
};

constexpr std::array kExtensions{
    Extension{".exr", FileKind::exr_picture},
    Extension{".hdr", FileKind::hdr_picture},
    Extension{".png", FileKind::png_picture},
    Extension{".svg", FileKind::svg_drawing},
    Extension{".obj", FileKind::obj_mesh},
    Extension{".ply", FileKind::ply_mesh},
    Extension{".ies", FileKind::ies_luminaire},
    Extension{".ldt", FileKind::eulumdat_luminaire},
    Extension{".rad", FileKind::radiance_scene},
    Extension{".gltf", FileKind::gltf_scene},
    Extension{".glb", FileKind::gltf_scene},
    Extension{".ifc", FileKind::ifc_building},
    Extension{".epw", FileKind::weather},
    Extension{".wea", FileKind::weather},
    Extension{".oct", FileKind::octree},
    Extension{".uld", FileKind::luminaire_of_another_kind},
    Extension{".gldf", FileKind::luminaire_of_another_kind},
    Extension{".rolf", FileKind::luminaire_of_another_kind},
    Extension{".rolfz", FileKind::luminaire_of_another_kind},
    Extension{".dxf", FileKind::drawing},
    Extension{".dwg", FileKind::drawing},
    Extension{".skp", FileKind::model},
    Extension{".3ds", FileKind::model},
    Extension{".3dm", FileKind::model},
    Extension{".fbx", FileKind::model},
    Extension{".dae", FileKind::model},
    Extension{".stl", FileKind::model},
    Extension{".blend", FileKind::model},
    Extension{".max", FileKind::model},
    Extension{".rvt", FileKind::model},
};

struct Description {
    FileKind kind;
    std::string_view name;
    std::string_view in_a_scene;  ///< its use in a scene, as a sentence; empty for none
};

constexpr std::string_view kPanorama =
    R"(A scene refers to it as the file of a light of type "environment", if it is a panorama.)";
constexpr std::string_view kMesh = R"(A scene refers to it as the file of an object of shape "mesh".)";
constexpr std::string_view kLuminaire =
    R"(A scene refers to it as the file of a light of type "photometry".)";

constexpr std::array kDescriptions{
    Description{FileKind::other, "a file of another kind", ""},
    Description{FileKind::empty, "an empty file", ""},
    Description{FileKind::exr_picture, "an OpenEXR picture", kPanorama},
    Description{FileKind::hdr_picture, "a Radiance picture", kPanorama},
    Description{FileKind::png_picture, "a PNG picture",
                "It is only for viewing: a PNG picture has no luminances that Stilb could read."},
    Description{FileKind::svg_drawing, "an SVG drawing", "It is only for viewing."},
    Description{FileKind::solution, "a solution",
                "Pictures are made from it, with the scene that was solved."},
    Description{FileKind::run, "the state of a run",
                "The run goes on by: stilb resume FILE; its results so far: stilb measure --from FILE."},
    Description{FileKind::walk, "a page to walk through a scene", "A browser opens it."},
    Description{FileKind::report, "a report", "A browser opens it."},
    Description{FileKind::series, "a surface by spherical harmonics",
                R"(A scene refers to it as the file of an object of shape "harmonics".)"},
    Description{FileKind::results, "a document with results", ""},
    Description{FileKind::json, "a JSON document", "Scenes are TOML files (docs/scene-format.md)."},
    Description{FileKind::obj_mesh, "an OBJ mesh", kMesh},
    Description{FileKind::ply_mesh, "a PLY mesh", kMesh},
    Description{FileKind::ies_luminaire, "an IES luminaire", kLuminaire},
    Description{FileKind::eulumdat_luminaire, "a EULUMDAT luminaire", kLuminaire},
    Description{FileKind::radiance_scene, "a Radiance scene",
                "Commands that take a scene read it by itself."},
    Description{FileKind::gltf_scene, "a glTF scene", "Commands that take a scene read it by itself."},
    Description{FileKind::ifc_building, "a building in IFC",
                "A scene is made of it by: stilb import FILE -o DIR."},
    Description{
        FileKind::weather, "weather data of a place (such as EPW)",
        "Stilb does not read it: give a sky by its luminance, by a panorama, or by a Radiance scene with "
        "the command gensky."},
    Description{FileKind::scattering, "a table of the light that a window or blind scatters (BSDF, XML)",
                "Stilb does not read it: give the material as a pane, or its openings as area lights."},
    Description{FileKind::drawing, "a CAD drawing (DXF or DWG)",
                "Stilb does not read it: export the model from the CAD program as IFC, glTF or OBJ."},
    Description{FileKind::luminaire_of_another_kind,
                "a luminaire in a format of lighting programs (ULD, ROLF or "
                "GLDF)",
                "Stilb does not read it: makers offer the same luminaires as IES or EULUMDAT files."},
    Description{FileKind::octree, "an octree of Radiance",
                "A Radiance scene refers to it by instance; or read the files (.rad) that it was made of."},
    Description{FileKind::model, "a 3D model in a format that Stilb does not read",
                "Export it as glTF or OBJ."},
};

const Description& description_of(FileKind kind) {
    return *std::ranges::find(kDescriptions, kind, &Description::kind);
}

bool contains(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

/// The kind of a text that begins with a brace.
FileKind kind_of_json(std::string_view beginning) {
    if (contains(beginning, kSeriesFormat)) return FileKind::series;
    if (contains(beginning, "\"stilb\"") && contains(beginning, "\"attained_error\""))
        return FileKind::results;
    if (contains(beginning, "\"asset\"")) return FileKind::gltf_scene;
    return FileKind::json;
}

}  // namespace

FileKind kind_of_content(std::string_view beginning) {
    if (beginning.empty()) return FileKind::empty;
    beginning = without_byte_order_mark(beginning);
    if (beginning.starts_with("#?") && contains(beginning, "\nFORMAT=Radiance_octree"))
        return FileKind::octree;
    for (const auto& [bytes, kind] : kBeginnings) {
        if (beginning.starts_with(bytes)) return kind;
    }
    const std::size_t first = beginning.find_first_not_of(" \t\r\n");
    if (first == beginning.npos) return FileKind::other;
    if (beginning[first] == '{') return kind_of_json(beginning);
    if (beginning[first] == '<' && contains(beginning, kWalkMark)) return FileKind::walk;
    if (beginning[first] == '<' && contains(beginning, kReportMark)) return FileKind::report;
    if (beginning[first] == '<' && contains(beginning, "<svg")) return FileKind::svg_drawing;
    if (beginning[first] == '<' && contains(beginning, "<WindowElement")) return FileKind::scattering;
    return FileKind::other;
}

FileKind kind_of_content_of(const std::filesystem::path& path) {
    return kind_of_content(read_beginning(path, kBeginningSize));
}

FileKind kind_of_name(const std::filesystem::path& path) {
    const auto known = std::ranges::find(kExtensions, extension_of(path), &Extension::text);
    return known == kExtensions.end() ? FileKind::other : known->kind;
}

FileKind kind_of_file(const std::filesystem::path& path) {
    const FileKind kind = kind_of_content_of(path);
    if (kind != FileKind::other && kind != FileKind::empty && kind != FileKind::json) return kind;
    const FileKind by_name = kind_of_name(path);
    return by_name == FileKind::other ? kind : by_name;
}

std::string_view name_of(FileKind kind) { return description_of(kind).name; }

bool is_luminance_picture(FileKind kind) {
    return kind == FileKind::exr_picture || kind == FileKind::hdr_picture;
}

bool may_be_scene_file(FileKind kind) { return kind == FileKind::other || kind == FileKind::empty; }

std::string not_a_scene(FileKind kind) {
    const auto& [_, name, in_a_scene] = description_of(kind);
    return fmt::format("not a scene but {}.{}{}", name, in_a_scene.empty() ? "" : " ", in_a_scene);
}

void require_output(const std::filesystem::path& output, FileKind kind,
                    std::span<const std::filesystem::path> inputs) {
    if (is_standard_output(output)) return;
    std::error_code error;
    for (const std::filesystem::path& input : inputs) {
        if (!std::filesystem::equivalent(output, input, error)) continue;
        throw InputError(fmt::format("the result cannot be written over '{}', which is read to compute it. "
                                     "Write the result to another file.",
                                     input.string()),
                         {output.string()});
    }
    require_writable(output);
    if (!std::filesystem::is_regular_file(output, error)) return;
    const FileKind existing = kind_of_content_of(output);
    if (existing == kind || existing == FileKind::empty) return;
    throw InputError(
        fmt::format("this file exists and is {}, but the result is {}. Write the result to another "
                    "file, or remove this one first.",
                    name_of(existing), name_of(kind)),
        {output.string()});
}

}  // namespace stilb::io
