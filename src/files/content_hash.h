// What tells one version of a scene from another.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace stilb {

/// 64 bits of the files' contents, one after another, as 16 hexadecimal digits (FNV-1a: against mistakes, not
/// against forgery). Throws InputError where one cannot be read.
std::string content_hash(std::span<const std::filesystem::path> files);

}  // namespace stilb
