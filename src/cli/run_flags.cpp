#include "cli/run_flags.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>

#include "estimators/estimator_list.h"
#include "run/options.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

/// As in scene files.
constexpr std::int64_t kMostPaths = std::int64_t{1} << 53;
constexpr std::int64_t kGreatestSeed = std::numeric_limits<std::int64_t>::max();

}  // namespace

void RunFlags::add_to(Command& command) {
    std::string methods = "How to compute (default: auto)";
    for (const estimators::EstimatorEntry& entry : estimators::estimator_list()) {
        methods += fmt::format("\n  {:12} {}", entry.name, entry.summary);
    }
    command.add("--method", method, methods).value_name("NAME");
    command.add("--bounces", bounces, "At most this many reflections (default: no limit, without bias)")
        .value_name("N");
    add_those_of_one_method(command);
}

void RunFlags::add_those_of_one_method(Command& command) {
    command
        .add("--error", error,
             "Stop when 95 % of each sensor's readings have a 95 % interval within this share of their "
             "value: 1% or 0.01")
        .value_name("SHARE");
    command.add("--time", time_s, "Stop after this many seconds").value_name("S");
    command.add("--paths", paths, "Stop after this many light chains (method path: paths per reading)")
        .from_to(1, kMostPaths)
        .value_name("N");
    command.add("--seed", seed, "Another seed gives an independent result")
        .from_to(0, kGreatestSeed)
        .value_name("N");
    command.add("--threads", threads, "Processor threads (default: all); the result does not depend on it")
        .value_name("N");
    command.add("--quiet", quiet, "No progress, no warnings on stderr");
    patches.add_to(command);
}

std::vector<std::string_view> RunFlags::given() const {
    std::vector<std::string_view> names = patches.given();
    const auto add = [&](std::string_view name, bool is_given) {
        if (is_given) names.push_back(name);
    };
    add("--method", method.has_value());
    add("--error", error.has_value());
    add("--time", time_s.has_value());
    add("--paths", paths.has_value());
    add("--bounces", bounces.has_value());
    add("--seed", seed.has_value());
    return names;
}

RunOptions RunFlags::over(RunOptions options) const {
    if (method) options.method = *method;
    estimators::find_estimator(options.method);
    if (paths) {
        options.paths = *paths;
        options.error.reset();
        options.time_s.reset();
    }
    if (error) {
        options.error = run::parse_relative_error(*error);
        if (!options.error) {
            throw InputError(
                fmt::format("--error {}: a share between 0 and 1 is needed, such as 0.01 or 1%", *error));
        }
    }
    if (time_s) options.time_s = *time_s;
    if (bounces) options.bounces = *bounces;
    if (seed) options.seed = *seed;
    if (threads) options.threads = *threads;
    options.patches = patches.options_for(options.method);
    return options;
}

}  // namespace stilb::cli
