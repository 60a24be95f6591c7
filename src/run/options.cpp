#include "run/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <concepts>
#include <utility>

#include "stilb/error.h"

namespace stilb::run {

namespace {

void expect_allowed(double value, const Range& limits, const std::string& key) {
    expect_inside(value, limits, key);
}
void expect_allowed(double value, const api::Share& limits, const std::string& key) {
    expect_inside(value, limits.range, key);
}
template <std::integral Value>
void expect_allowed(Value value, const api::WholeRange& limits, const std::string& key) {
    if (std::cmp_less(value, limits.min) || std::cmp_greater(value, limits.max))
        fail_at(key, fmt::format("{} is not allowed. Allowed: a whole number from {} to {}.", value,
                                 limits.min, limits.max));
}
void expect_allowed(const std::string& value, const api::Names& limits, const std::string& key) {
    const std::span<const std::string_view> all = limits.all();
    if (std::ranges::find(all, value) == all.end())
        fail_at(key, fmt::format("\"{}\" is not allowed.{} Allowed: {}.", value, did_you_mean(value, all),
                                 fmt::join(all, ", ")));
}

}  // namespace

void require_valid(const RunOptions& options) {
    for_each_value(options, [](const auto& option, const auto& value) {
        expect_allowed(value, option.limits, std::string(option.key));
    });
    if (options.replicates && *options.replicates < 2) throw InputError("replicates: expected 2 or more");
}

std::optional<double> parse_relative_error(std::string_view text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [stopped, failure] = std::from_chars(text.data(), end, number);
    const std::string_view unit(stopped, static_cast<std::size_t>(end - stopped));
    if (failure != std::errc() || (!unit.empty() && unit != "%")) return {};
    if (unit == "%") number /= 100;
    if (!(number > 0 && number < 1)) return {};
    return number;
}

}  // namespace stilb::run
