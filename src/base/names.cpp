#include "base/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace stilb {

std::string list_of(std::span<const std::string> names, Listed listed) {
    constexpr std::size_t most = 3;
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
        list += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", names[i]);
    if (names.size() <= most) return list;
    return fmt::format("{} and {}{} more", list, listed == Listed::all ? "" : "at least ",
                       names.size() - most);
}

}  // namespace stilb
