// One scene checked: every method and some other forms against path tracing and against exact values; what
// disagrees is measured again with more work, reduced, and described.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "random/compare.h"
#include "random/generator.h"

namespace stilb::random {

struct Options {
    std::filesystem::path folder;
    std::uint64_t seed = 1;
    std::size_t forms = 2;   ///< other forms of each scene
    std::uint64_t work = 1;  ///< a factor on all samples
    bool is_long = false;    ///< also methods that light patches
    std::string only;        ///< only methods and forms whose words contain this
};

struct Finding {
    std::uint64_t scene = 0;
    Setting setting;
    bool is_exact = false;  ///< against the exact value, else against the reference method
    std::string reference;
    Difference difference;
    std::string reading, kind;
    Draft draft;                        ///< reduced
    std::vector<std::string> warnings;  ///< of the disagreeing measurement and the reference
    bool is_explained = false;          ///< a warning says so
};

struct Checked {
    std::vector<Finding> findings;
    std::size_t comparisons = 0;
    std::string refusal;
};

Checked check(const RandomScene& random, std::uint64_t scene, const Options& options);

}  // namespace stilb::random
