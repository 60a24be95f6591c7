// glTF files as the parser reads them, and checked access to their parts. Only io/import/gltf includes the
// parser.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/rgb.h"

namespace stilb::io::gltf {

/// The parsed file; images are as in the file, not decoded.
struct File {
    std::filesystem::path path;
    tinygltf::Model model;
    /// The other files that were read.
    std::vector<std::filesystem::path> sources;

    /// Throws an InputError that names the file and the part of it: "meshes[2]".
    [[noreturn]] void fail(std::string_view part, std::string_view message) const;
    /// Refuses a file that needs an extension which is not read.
    [[noreturn]] void fail_for_extension(const std::string& extension) const;
    /// Bytes of a file beside the scene. `part`: where it is named. Throws where it does not exist, or lies
    /// outside of the scene's folder.
    std::string read_beside(const std::string& uri, std::string_view part);
    /// The bytes of a bufferView. Throws where it or its buffer is too short.
    std::string_view bytes_of_view(int view, std::string_view part) const;
};

bool is_data_uri(std::string_view uri);
/// The bytes in a data URI, whatever parameters it has [RFC 2397]; nothing where they are not in base64.
std::optional<std::string> data_of_uri(std::string_view uri);

/// Parses .gltf or .glb, by its first bytes. Throws InputError.
File parse(std::string_view content, const std::filesystem::path& path);

/// The element of a list of the model, which a part of the file refers to by its index.
template <typename T>
const T& element(const File& file, const std::vector<T>& list, int index, std::string_view list_name,
                 std::string_view part) {
    if (index < 0 || static_cast<std::size_t>(index) >= list.size()) {
        file.fail(part, "it refers to " + std::string(list_name) + "[" + std::to_string(index) +
                            "], which does not exist.");
    }
    return list[static_cast<std::size_t>(index)];
}

// Accessors: numbers in buffers.

/// What becomes of numbers that are not finite.
enum class NotFinite { refused, kept };
/// Vectors of `components` numbers one after another; integers are scaled where the accessor is normalized.
/// Throws where the accessor has another type or reaches beyond its buffer.
std::vector<double> read_vectors(const File& file, int accessor, int components, std::string_view part,
                                 NotFinite others = NotFinite::refused);
/// Unsigned integers, all below `limit`.
std::vector<std::uint32_t> read_indices(const File& file, int accessor, std::size_t limit,
                                        std::string_view part);

// Values of extensions.

/// The extension's table; null where it is missing.
const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const std::string& name);
double number_in(const tinygltf::Value& table, const std::string& key, double otherwise);
/// -1 where it is missing.
int index_in(const tinygltf::Value& table, const std::string& key);
/// A texture that the table refers to; its index is -1 where there is none.
tinygltf::TextureInfo texture_in(const tinygltf::Value& table, const std::string& key);
/// The numbers of a list; empty where it is missing.
std::vector<double> numbers_in(const tinygltf::Value& table, const std::string& key);
Rgb rgb_in(const tinygltf::Value& table, const std::string& key, const Rgb& otherwise);
/// The three first numbers; `otherwise` where there are fewer.
Rgb rgb_of(const std::vector<double>& numbers, const Rgb& otherwise);

}  // namespace stilb::io::gltf
