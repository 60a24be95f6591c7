#include "io/text/grouped_warnings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

namespace stilb::io {

void GroupedWarnings::add(std::string_view kind, std::string_view name, std::string_view message) {
    const auto [entry, is_new] = index_.try_emplace(fmt::format("{}\n{}", kind, message), warnings_.size());
    if (is_new) warnings_.push_back({std::string(kind), std::string(message), {}});
    std::vector<std::string>& names = warnings_[entry->second].names;
    if (names.empty() || names.back() != name) names.emplace_back(name);
}

std::vector<std::string> GroupedWarnings::list() const {
    constexpr std::size_t most_names = 12;
    std::vector<std::string> result;
    for (const Warning& warning : warnings_) {
        const std::size_t count = warning.names.size(), shown = std::min(count, most_names);
        result.push_back(fmt::format("{}{} {}{}: {}", warning.kind, count > 1 ? "s" : "",
                                     fmt::join(std::span(warning.names).first(shown), ", "),
                                     count > shown ? fmt::format(" and {} more", count - shown) : "",
                                     warning.message));
    }
    return result;
}

}  // namespace stilb::io
