
#include "cli/run_flags.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "estimators/estimator_list.h"
#include "math/zernike.h"
#include "run/options.h"
#include "run/solve.h"
#include "stilb/error.h"

namespace stilb::cli {

namespace {

constexpr const char* kPatchFlag = "--patch";
/// Those that `stilb help patches` explains.
constexpr std::array<const char*, 5> kHelpedFlags{"--first-shot", "--window", "--resolution", "--visibility",
                                                  "--directions"};
/// Their keys, and that of kPatchFlag.
constexpr std::array<std::string_view, 6> kPatchKeys{"patch",      "first_shot", "window",
                                                     "resolution", "visibility", "directions"};

void limit(Flag& flag, const Range& limits) { flag.within(limits); }
void limit(Flag& flag, const api::WholeRange& limits) { flag.from_to(limits.min, limits.max); }
void limit(Flag& flag, const api::Share& limits) { flag.share(limits.range); }
void limit(Flag& flag, const api::Names& limits) { flag.one_of(limits.all()); }

std::string list_of_methods() {
    std::string methods = "Method of computation (default: auto)";
    for (const estimators::EstimatorEntry& entry : estimators::estimator_list()) {
        if (!entry.is_technique) methods += fmt::format("\n  {:12} {}", entry.name, entry.summary);
    }
    return methods +
           "\nA result names the technique that auto has chosen: path, light-paths or guided. Each may be "
           "given.";
}

}  // namespace

Flag add_option(Command& command, api::Options& options, std::string_view key) {
    std::optional<Flag> flag;
    for_each_field<api::Options>([&](const auto& option) {
        if (option.key != key) return;
        flag = command.add(fmt::format("--{}", run::flag_of(key)), options.*option.member,
                           std::string(option.meaning));
        limit(*flag, option.limits);
        flag->value_name(std::string(option.placeholder));
    });
    return flag.value();
}

void RunFlags::add_all_but(const std::vector<std::string_view>& left_out, Command& command) {
    for_each_field<api::Options>([&](const auto& option) {
        const auto is_in = [&](const auto& keys) {
            return std::ranges::find(keys, option.key) != keys.end();
        };
        if (!is_in(kPatchKeys) && !is_in(left_out)) flags_.push_back(add_option(command, typed_, option.key));
    });
    command.add("--quiet", quiet, "Print no progress and no warnings");
    command.add("--progress", progress,
                "Print progress on stderr as plain lines, also where that is not a terminal");
    add_those_of_patches(command);
}

void RunFlags::add_to(Command& command, const std::vector<std::string_view>& left_out) {
    add_all_but(left_out, command);
    command.find("--method").description(list_of_methods());
    for (const char* name : kHelpedFlags) command.find(name).hidden();
    command.find(kPatchFlag).heading("Patches (ray-bundle, radiosity, particles)");
    command.set_footer("First shot, item buffers and bundles of methods on patches: stilb help patches");
}

void RunFlags::add_those_of_solutions(Command& command, std::optional<int>& degree) {
    command
        .add("--degree", degree,
             fmt::format("Degree of the directional basis that stores the light on glossy surfaces (default: "
                         "{}): a higher one is sharper and takes more memory",
                         run::kDefaultDegree))
        .from_to(0, math::ZernikeBasis::kMostDegree)
        .value_name("N");
    add_all_but({"method", "target", "bounces", "by"}, command);
    command.find("--error").description(
        "Stop when 95 % of the light falls on places with a 95 % interval within this share of their "
        "illuminance: 1% or 0.01");
    command.find(kPatchFlag).description("Longest edge of a patch [m] (default: about 3,000 patches)");
    command.find("--paths").description(
        "Stop after this many steps of ray-bundle iteration, rounded up to a multiple of 8");
    command.find("--first-shot")
        .description("First shot that replaces small lights: incoming (default) or none");
}

void RunFlags::add_those_of_patches(Command& command) {
    const std::string group =
        "Patches and first shot (ray-bundle, radiosity; path with --first-shot; particles: only --patch)";
    for (const std::string_view key : kPatchKeys)
        flags_.push_back(add_option(command, typed_, key).heading(group));
}

void add_patch_topic(CommandLine& line) {
    Command topic = line.add_topic(
        "patches",
        "The flags of methods on patches, for measure, render and report; solve has some of them, too. The\n"
        "methods are explained in docs/patches.md and docs/first-shot.md.");
    static RunFlags flags;  // nothing is parsed
    flags.add_those_of_patches(topic);
}

std::vector<std::string> RunFlags::given() const {
    std::vector<std::string> names;
    for (const Flag& flag : flags_) {
        if (flag.is_given() && flag.name() != "--threads") names.push_back(flag.name());
    }
    return names;
}

bool RunFlags::is_given(std::string_view flag) const {
    return std::ranges::any_of(flags_, [&](const Flag& own) { return own.name() == flag && own.is_given(); });
}

RunOptions RunFlags::over(RunOptions options) const {
    if (is_given("--paths")) {
        options.error.reset();
        options.time_s.reset();
    }
    for_each_field<api::Options>([&](const auto& option) {
        if (is_given(fmt::format("--{}", run::flag_of(option.key))))
            options.*option.member = typed_.*option.member;
    });
    for (const std::string& flag : given()) {
        if (const auto lack = run::lack_of_effect(options, flag.substr(2), "--first-shot"))
            throw InputError(fmt::format("{} {}", flag, *lack));
    }
    options.patches = run::patch_options(options);
    return options;
}

RunOptions with_reserve(RunOptions options, double time_s) {
    if (options.time_s) options.reserved_s = std::min(time_s, *options.time_s / 2);
    return options;
}

RunOptions with_picture_reserve(RunOptions options, const std::array<int, 2>& resolution) {
    // Seconds a pixel after the last pass. Two threads were measured.
    constexpr double kFinishing_s = 3e-7;
    return with_reserve(std::move(options), kFinishing_s * resolution[0] * resolution[1]);
}

}  // namespace stilb::cli
