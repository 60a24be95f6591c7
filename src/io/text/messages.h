// Wording that error messages share.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace stilb::io {

/// ` Did you mean "wall"? Allowed: wall, floor.` (the question only where a name is near), to follow a
/// sentence.
std::string suggestion(std::string_view found, std::span<const std::string_view> allowed);

}  // namespace stilb::io
