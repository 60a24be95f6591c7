// Whole files written at once.
#pragma once

#include <filesystem>
#include <string_view>

namespace stilb::io {

/// Throws InputError where `path` is in a folder that does not exist. For a look before a long computation.
void require_folder_of(const std::filesystem::path& path);

/// Throws InputError naming the file where it cannot be written.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Likewise, in one step: who reads meanwhile finds the old content or the new one, never half of it. (What
/// is no plain file, such as a link or a device, is written to as it is.)
void replace_file(const std::filesystem::path& path, std::string_view content);

}  // namespace stilb::io
