// The relative error that a user asks for.
#pragma once

#include <optional>
#include <string_view>

namespace stilb::run {

/// "0.01" or "1%" as 0.01; nothing where the text is neither, or not between 0 and 1.
std::optional<double> parse_relative_error(std::string_view text);

}  // namespace stilb::run
