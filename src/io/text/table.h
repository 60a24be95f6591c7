// Tables as CSV.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace stilb::io {

// Whole files written at once. The path "-" is standard output.

bool is_standard_output(const std::filesystem::path& path);

/// Throws InputError where replace_file could not write: the folder is missing or not writable, or `path` is
/// itself a folder. For a check before a long computation; it tries to create a file beside `path`.
void require_writable(const std::filesystem::path& path);

/// Throws InputError with the file's name where it cannot be written.
void write_file(const std::filesystem::path& path, std::string_view content);

/// The same in one step: concurrent readers find the old content or the new one, never a part. The content
/// is written to a temporary file in the same folder, which then takes the name. Where the path is a link,
/// the file that it leads to is replaced. (What is not a plain file, such as a device, is written to
/// directly.)
void replace_file(const std::filesystem::path& path, std::string_view content);
/// The content in parts that follow each other.
void replace_file(const std::filesystem::path& path, std::span<const std::string> parts);

/// The temporary file that replace_file() is writing, or nullptr. For a signal handler, which may remove it;
/// it is one of them where several threads write files.
const char* unfinished_file();

struct Column {
    std::string name;
    std::variant<std::vector<double>, std::vector<std::string>> cells;
};

/// RFC 4180 with a header line. Numbers have enough digits to read back the same double; NaN (no
/// value) is an empty cell. Throws std::invalid_argument for columns of different lengths.
std::string to_csv(std::span<const Column> columns);

/// Throws InputError where the file cannot be written.
void write_csv(std::span<const Column> columns, const std::filesystem::path& path);

}  // namespace stilb::io
