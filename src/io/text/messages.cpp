#include "io/text/messages.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "io/text/text.h"

namespace stilb::io {
namespace {

std::string listed(std::span<const std::string_view> names) {
    constexpr std::size_t most = 30;
    std::string result;
    for (const std::string_view name : names.first(std::min(names.size(), most))) {
        if (!result.empty()) result += ", ";
        result += name.empty() ? "\"\"" : name;
    }
    if (names.size() > most) result += fmt::format(" and {} more", names.size() - most);
    return result;
}

}  // namespace

std::string suggestion(std::string_view found, std::span<const std::string_view> allowed) {
    if (allowed.empty()) return " There is none to choose from.";
    const std::string near = nearest_name(found, allowed);
    const std::string question = near.empty() ? "" : fmt::format(" Did you mean {}?", in_quotes(near));
    return fmt::format("{} Allowed: {}.", question, listed(allowed));
}

}  // namespace stilb::io
