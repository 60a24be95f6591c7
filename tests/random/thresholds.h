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

/// Other constants of a file: numbers of samples, costs and shares that weigh them, tolerances of rounding,
/// limits beyond which input is refused, formats and units; and limits by which warnings are given and rooms,
/// floors and bodies are recognised, which change no light where they are.
struct OtherConstants {
    std::string_view file, names;  ///< names with a space between them
};

std::span<const OtherConstants> other_constants();

/// Prints the table of thresholds. Returns the number of errors: constants that do not stand in their file
/// with their value, tests that do not exist, and numbers in the sources of what gives light that are in
/// neither of both lists.
int check_thresholds(const std::filesystem::path& sources);

}  // namespace stilb::random
