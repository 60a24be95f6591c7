#include "cli/run_flags.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>

#include "base/error.h"
#include "estimators/estimator_list.h"
#include "run/options.h"

namespace stilb::cli {
namespace {

/// As in scene files.
constexpr std::int64_t kMostPaths = std::int64_t{1} << 53;
constexpr std::int64_t kGreatestSeed = std::numeric_limits<std::int64_t>::max();

}  // namespace

void RunFlags::add_to(CLI::App& command) {
    std::string methods = "How to compute (default: auto)";
    for (const estimators::EstimatorEntry& entry : estimators::estimator_list()) {
        methods += fmt::format("\n  {:12} {}", entry.name, entry.summary);
    }
    command.add_option("--method", method, methods)->type_name("NAME");
    command
        .add_option("--bounces", bounces, "At most this many reflections (default: no limit, without bias)")
        ->type_name("N");
    add_those_of_one_method(command);
}

void RunFlags::add_those_of_one_method(CLI::App& command) {
    command
        .add_option(
            "--error", error,
            "Stop when 95 % of each sensor's readings have a 95 % interval within this share of their "
            "value: 1% or 0.01")
        ->type_name("SHARE");
    command.add_option("--time", time_s, "Stop after this many seconds")->type_name("S");
    command
        .add_option("--paths", paths, "Stop after this many light chains (method path: paths per reading)")
        ->check(CLI::Range(std::int64_t{1}, kMostPaths))
        ->type_name("N");
    command.add_option("--seed", seed, "Another seed gives an independent result")
        ->check(CLI::Range(std::int64_t{0}, kGreatestSeed))
        ->type_name("N");
    command
        .add_option("--threads", threads,
                    "Processor threads (default: all); the result does not depend on it")
        ->type_name("N");
    command.add_flag("--quiet", quiet, "No progress, no warnings on stderr");
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
