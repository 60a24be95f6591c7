#include "io/text/grouped_warnings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace stilb::io {

void GroupedWarnings::add(std::string_view kind, std::string_view name, std::string_view message) {
    const auto is_same = [&](const Warning& w) { return w.kind == kind && w.message == message; };
    auto found = std::find_if(warnings_.begin(), warnings_.end(), is_same);
    if (found == warnings_.end()) {
        warnings_.push_back({std::string(kind), std::string(message), {}});
        found = std::prev(warnings_.end());
    }
    found->names.emplace_back(name);
}

std::vector<std::string> GroupedWarnings::texts() const {
    std::vector<std::string> texts;
    for (const Warning& warning : warnings_) {
        texts.push_back(fmt::format("{}{} {}: {}", warning.kind, warning.names.size() > 1 ? "s" : "",
                                    fmt::join(warning.names, ", "), warning.message));
    }
    return texts;
}

}  // namespace stilb::io
