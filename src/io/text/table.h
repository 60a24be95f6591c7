// Tables as CSV.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace stilb::io {

// Whole files written at once.

/// Throws InputError where `path` is in a folder that does not exist. For a look before a long computation.
void require_folder_of(const std::filesystem::path& path);

/// Throws InputError naming the file where it cannot be written.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Likewise, in one step: who reads meanwhile finds the old content or the new one, never half of it. (What
/// is no plain file, such as a link or a device, is written to as it is.)
void replace_file(const std::filesystem::path& path, std::string_view content);

struct Column {
    std::string name;
    std::variant<std::vector<double>, std::vector<std::string>> cells;
};

/// RFC 4180 with a header line. Numbers are written so that reading them gives the same double; NaN (no
/// value) is an empty cell. Throws std::invalid_argument for columns of different lengths.
std::string to_csv(std::span<const Column> columns);

/// Throws InputError where the file cannot be written.
void write_csv(std::span<const Column> columns, const std::filesystem::path& path);

}  // namespace stilb::io
