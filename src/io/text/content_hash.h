// What tells one version of a scene from another: 64 bits, FNV-1a, against mistakes, not against forgery.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace stilb::io {

inline constexpr std::uint64_t kEmptyHash = 0xcbf29ce484222325;

/// Of what has the hash `before`, and the bytes after it.
std::uint64_t hash_of(std::string_view bytes, std::uint64_t before = kEmptyHash);

/// Of the files' contents, one after another, as 16 hexadecimal digits. Throws InputError where one cannot be
/// read.
std::string content_hash(std::span<const std::filesystem::path> files);

/// Of all that a scene's light depends on: the materials, objects and lights of the scene file, by their keys
/// and values, and the contents of the files that it refers to. Sensors, [run], the title, comments and
/// layout do not count. `sources`: the scene file and the others (SceneFile). Throws InputError where one
/// cannot be read.
std::string light_hash(std::span<const std::filesystem::path> sources);

}  // namespace stilb::io
