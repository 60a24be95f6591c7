// Lists of names in messages.
#pragma once

#include <span>
#include <string>

namespace stilb {

/// Whether a list has all names.
enum class Listed { all, some };

/// "a", "b", "c" and 19 more; "at least" 19 where there may be others.
std::string list_of(std::span<const std::string> names, Listed listed = Listed::all);

}  // namespace stilb
