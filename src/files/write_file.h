// Whole files written at once.
#pragma once

#include <filesystem>
#include <string_view>

namespace stilb {

/// Throws InputError naming the file where it cannot be written.
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace stilb
