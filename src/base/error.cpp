#include "stilb/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace stilb {
namespace {

std::string located(const std::string& message, const SourceLocation& where) {
    if (where.file.empty()) return message;
    if (where.line == 0) return fmt::format("{}: {}", where.file, message);
    return fmt::format("{}:{}: {}", where.file, where.line, message);
}

/// Optimal string alignment distance: insertions, deletions, substitutions and swaps of neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), current(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        current[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            current[j] = std::min({last[j] + 1, current[j - 1] + 1, substituted});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) current[j] = std::min(current[j], before_last[j - 2] + 1);
        }
        before_last.swap(last);
        last.swap(current);
    }
    return last[b.size()];
}

}  // namespace

InputError::InputError(const std::string& message, const SourceLocation& where)
    : std::runtime_error(located(message, where)) {}

std::string nearest_name(std::string_view found, std::span<const std::string_view> allowed) {
    std::string_view best;
    std::size_t best_distance = std::max<std::size_t>(2, found.size() / 3) + 1;
    for (const std::string_view name : allowed) {
        const std::size_t distance = edit_distance(found, name);
        if (distance < best_distance) {
            best_distance = distance;
            best = name;
        }
    }
    return std::string(best);
}

std::string did_you_mean(std::string_view found, std::span<const std::string_view> allowed) {
    const std::string nearest = nearest_name(found, allowed);
    return nearest.empty() ? "" : fmt::format(" Did you mean \"{}\"?", nearest);
}

}  // namespace stilb
