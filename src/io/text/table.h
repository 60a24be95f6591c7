// Tables as CSV.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace stilb::io {

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
