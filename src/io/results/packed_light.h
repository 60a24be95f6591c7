// The light of a solution as whole numbers of steps, as solution files have it. The light of the groups is
// rounded to steps of its error (run/solution_errors.h): whole numbers of them compress to a third of what
// numbers in half precision take, above all as differences of the colours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/half.h"

namespace stilb::io {

/// For each group of lights: its terms.
using LightOfGroups = std::vector<std::vector<HalfRgb>>;

struct PackedLight {
    /// Per term, of all groups: its steps are powers of two.
    std::vector<std::int16_t> exponents;
    /// Green, red - green, blue - green: each the steps of all groups' terms, as unsigned numbers of 32 bits
    /// (0, -1, 1, -2, 2 ...), of which all first bytes come first.
    std::string bytes;
};

/// `light`: of the same number of terms for each group. Nothing is lost unless numbers of one term differ by
/// factors of more than 2^28.
PackedLight pack(const LightOfGroups& light);
/// Nothing where the lengths do not fit each other, or a step is none of half precision.
std::optional<LightOfGroups> unpack(const PackedLight& packed, std::size_t groups);

}  // namespace stilb::io
