// Lists of names in messages.
#pragma once

#include <span>
#include <string>

namespace stilb {

/// "a", "b", "c" and 19 more; "at least" 19 where there may be others.
std::string list_of(std::span<const std::string> names, bool is_complete = true);

}  // namespace stilb
