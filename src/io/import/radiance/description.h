// A Radiance scene as its files describe it: modifiers and surfaces, all commands carried out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/transform.h"
#include "io/import/import_settings.h"
#include "stilb/error.h"

namespace stilb::io::radiance {

/// The place of a primitive in the files, for messages.
struct Place {
    std::uint32_t file = 0;  ///< an index into Description::files
    std::uint32_t line = 0;
};

/// A material, a pattern, a texture, a mixture or an alias.
struct Modifier {
    std::string type, name;
    std::vector<std::string> texts;
    std::vector<double> numbers;
    /// The modifier of this modifier, an earlier one; none for "void".
    std::optional<std::size_t> modifier;
    /// From the coordinates in which its functions are defined to those of the scene.
    geometry::Transform frame;
    Place place;
};

enum class SurfaceKind { polygon, sphere, bubble, ring, cylinder, tube, cone, cup, source, mesh };

/// A triangle of a compiled mesh: the corners as positions, then as unit normals (zero where there is none).
inline constexpr std::size_t kMeshTriangleNumbers = 18;

/// A surface in the coordinates of the scene. A mesh is a list of triangles of kMeshTriangleNumbers.
struct Surface {
    SurfaceKind kind{};
    std::string name;
    std::optional<std::size_t> modifier;  ///< an index into Description::modifiers; none for "void"
    std::size_t first = 0, count = 0;     ///< its arguments in Description::numbers
    Place place;
};

struct Description {
    std::vector<std::string> files;              ///< all that were read, the scene's first
    std::vector<std::filesystem::path> folders;  ///< the folder of each file
    std::vector<Modifier> modifiers;
    std::vector<Surface> surfaces;
    std::vector<double> numbers;

    SourceLocation where(const Place& place) const { return {files[place.file], place.line}; }
};

/// Bounds of what a description may unfold to.
struct Limits {
    std::size_t primitives = 50'000'000;
};

/// Reads a description and all files that it includes. `name` is that of the file in messages, `folder` the
/// base of its file names. Its lengths are metres with z upwards where the options do not say otherwise.
/// Throws InputError with file and line.
Description read_description(std::string_view text, const std::string& name,
                             const std::filesystem::path& folder, const ImportOptions& options = {},
                             const Limits& limits = {});

/// The file of this name: as it is where it is absolute, else in the folder of the file that names it, in
/// that of the scene, or in those of the environment variable RAYPATH. Throws InputError where there is none.
std::filesystem::path find_file(const Description& description, const Place& place, const std::string& name);

}  // namespace stilb::io::radiance
