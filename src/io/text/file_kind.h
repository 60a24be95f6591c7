// The kinds of files, and the check that a result destroys no file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace stilb::io {

enum class FileKind {
    other,  ///< also scene files, which have no beginning of their own
    empty,
    exr_picture,
    hdr_picture,
    png_picture,
    svg_drawing,
    solution,
    run,      ///< the state of a run
    walk,     ///< a page to walk through a scene
    report,   ///< a page with the results of a scene
    series,   ///< a surface by spherical harmonics
    results,  ///< of measurements
    json,     ///< of no kind above
    obj_mesh,
    ply_mesh,
    ies_luminaire,
    eulumdat_luminaire,
    radiance_scene,
    gltf_scene,
    ifc_building,  ///< read by the Python package alone
    // Of other programs, which Stilb does not read:
    weather,
    scattering,
    drawing,
    luminaire_of_another_kind,
    octree,
    model,
};

/// The first bytes of a solution.
inline constexpr std::string_view kSolutionBeginning = "STILBSOL";
/// The same of the state of a run.
inline constexpr std::string_view kRunBeginning = "STILBRUN";
/// How the head of a page to walk through a scene names its origin.
inline constexpr std::string_view kWalkMark = R"(<meta name="generator" content="stilb view">)";
/// The same of a report.
inline constexpr std::string_view kReportMark = R"(<meta name="generator" content="stilb report">)";
/// The value of "format" in a file with a surface by spherical harmonics.
inline constexpr std::string_view kSeriesFormat = "stilb-harmonics";

/// The kind by the first bytes of a file. Kinds that begin in no way of their own (OBJ, EULUMDAT, Radiance
/// scenes, TOML) are `other`.
FileKind kind_of_content(std::string_view beginning);
/// The same of a file. Throws InputError where it cannot be read.
FileKind kind_of_content_of(const std::filesystem::path& path);
/// The kind by the extension of the file's name.
FileKind kind_of_name(const std::filesystem::path& path);
/// The kind by the file's content, or by the extension of its name where the content does not tell. Throws
/// InputError where it cannot be read.
FileKind kind_of_file(const std::filesystem::path& path);

/// The kind in words: "an OpenEXR picture".
std::string_view name_of(FileKind kind);

/// Whether it is a picture whose luminances can be read.
bool is_luminance_picture(FileKind kind);
/// Whether a file of this kind may be a scene file of Stilb, which has no beginning of its own.
bool may_be_scene_file(FileKind kind);
/// The message that a file of this kind is no scene, with its use in a scene.
std::string not_a_scene(FileKind kind);

/// For a check before a long computation. Throws InputError where a result of this kind should not be written
/// to `output`: where its folder does not exist, where `output` is one of the files that the run reads
/// (`inputs`; also by a link or another path), and where it is an existing file of another kind. Files that
/// are empty or not plain (such as /dev/null) may be written over.
void require_output(const std::filesystem::path& output, FileKind kind,
                    std::span<const std::filesystem::path> inputs);

}  // namespace stilb::io
