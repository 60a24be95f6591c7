#include "run/options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "stilb/error.h"

namespace stilb::run {

void require_valid(const RunOptions& options) {
    const auto positive = [](const char* name, double value) {
        if (!(value > 0) || !std::isfinite(value)) {
            throw InputError(fmt::format("{} = {}: expected a number above 0", name, value));
        }
    };
    if (options.error && !(*options.error > 0 && *options.error < 1)) {
        throw InputError(
            fmt::format("error = {}: expected a share between 0 and 1, such as 0.01", *options.error));
    }
    if (options.time_s) positive("time", *options.time_s);
    if (options.paths) positive("paths", static_cast<double>(*options.paths));
    if (options.bounces && *options.bounces < 0) throw InputError("bounces: expected 0 or more");
    if (options.threads < 0) throw InputError("threads: expected 0 (all) or more");
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
