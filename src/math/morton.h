// A space-filling curve: neighbours along it are neighbours in space.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace stilb::math {

/// Positions of points on the Morton curve through the cube about their bounding box: 63-bit codes.
std::vector<std::uint64_t> morton_codes(std::span<const Vec3> points);
/// Indices of the points in their order along the curve; points in one place keep theirs.
std::vector<std::uint32_t> morton_order(std::span<const Vec3> points);

}  // namespace stilb::math
