// The constants at which the program takes another way, and what crosses each of them.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace stilb::random {

struct Threshold {
    std::string_view constant, file, value;
    std::string_view what;     ///< the ways on both sides
    std::string_view crossed;  ///< by which scenes or tests; "not crossed" and why
};

std::span<const Threshold> thresholds();

/// Prints the table. Returns the number of constants that do not stand in their file with their value.
int check_thresholds(const std::filesystem::path& sources);

}  // namespace stilb::random
