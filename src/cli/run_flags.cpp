
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
        flag = command.add(fmt::format("--{}", key), options.*option.member, std::string(option.meaning));
        limit(*flag, option.limits);
        flag->value_name(std::string(option.placeholder));
    });
    return flag.value();
}

void RunFlags::add_all_but(const std::vector<std::string_view>& left_out, Command& command) {
    for_each_field<api::Options>([&](const auto& option) {
        if (option.key != "patch" && std::ranges::find(left_out, option.key) == left_out.end())
            flags_.push_back(add_option(command, typed_, option.key));
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
    flags_.push_back(add_option(command, typed_, "patch").heading(group));
    const auto add = [&](const char* name, auto& value, const std::string& text, const char* type) {
        flags_.push_back(command.add(name, value, text).value_name(type).heading(group));
    };
    add("--first-shot", first_shot_,
        "First shot that replaces small lights: auto, none, classical, diffuse, incoming, on-the-fly "
        "(default: auto, which is incoming; path: none)",
        "NAME");
    add("--window", window_,
        "Shape of item buffers on area lights, and on patches of radiosity: cube (its rear half is empty), "
        "hemicube (default) or tetrahedron; point lights always have cubes",
        "NAME");
    add("--resolution", resolution_,
        "Pixels along an edge of item buffers (default: by the number of patches; 64 on patches of "
        "radiosity)",
        "R");
    add("--visibility", visibility_, "Visibility backend: rays (default) or opengl", "NAME");
    add("--directions", directions_,
        "Directions of the bundles in a step of ray-bundle: single, pair or frame (default)", "NAME");
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
        if (is_given(fmt::format("--{}", option.key))) options.*option.member = typed_.*option.member;
    });
    require_known_to(estimators::find_estimator(options.method));
    options.patches = patch_options();
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

namespace {

constexpr std::array<std::string_view, 3> kWindowNames{"cube", "hemicube", "tetrahedron"};

/// The value of `flag`, an enumerator with the index of its name; nothing where the flag was not typed.
template <typename Enum>
std::optional<Enum> read(const char* flag, const std::optional<std::string>& typed,
                         std::span<const std::string_view> names) {
    if (!typed) return std::nullopt;
    const auto found = std::ranges::find(names, *typed);
    if (found == names.end()) {
        throw InputError(fmt::format("{} {}: there is no such value.{} Allowed: {}.", flag, *typed,
                                     did_you_mean(*typed, names), fmt::join(names, ", ")));
    }
    return static_cast<Enum>(found - names.begin());
}

}  // namespace

void RunFlags::require_known_to(const estimators::EstimatorEntry& method) const {
    const auto goes_by = [](const estimators::EstimatorEntry& entry, std::string_view flag) {
        return std::ranges::find(entry.patch_options, flag.substr(2)) != entry.patch_options.end();
    };
    std::vector<std::string> flags = given();
    std::erase_if(flags, [](const std::string& flag) {
        return flag != kPatchFlag && std::ranges::find(kHelpedFlags, flag) == kHelpedFlags.end();
    });
    for (const std::string& flag : flags) {
        if (goes_by(method, flag)) continue;
        std::vector<std::string_view> methods;
        for (const estimators::EstimatorEntry& entry : estimators::estimator_list()) {
            if (goes_by(entry, flag)) methods.push_back(entry.name);
        }
        throw InputError(fmt::format("{} has no effect with method {}. It belongs to: {}.", flag, method.name,
                                     fmt::join(methods, ", ")));
    }
    if (!method.lights_patches && !flags.empty() && !first_shot_) {
        throw InputError(fmt::format("{} has no effect with method {} unless --first-shot is given.",
                                     flags.front(), method.name));
    }
}

estimators::PatchMethodOptions RunFlags::patch_options() const {
    estimators::PatchMethodOptions options;
    options.first_shot.variant =
        first_shot_ == "auto"
            ? estimators::kUsualFirstShot
            : read<estimators::FirstShotVariant>("--first-shot", first_shot_, estimators::kFirstShotNames);
    estimators::ShootingOptions& shooting = options.first_shot.shooting;
    shooting.window = read<patches::BufferShape>("--window", window_, kWindowNames).value_or(shooting.window);
    shooting.backend = read<patches::BufferBackend>("--visibility", visibility_, patches::kBufferBackendNames)
                           .value_or(shooting.backend);
    options.directions =
        read<estimators::BundleDirections>("--directions", directions_, estimators::kBundleDirectionsNames)
            .value_or(options.directions);
    options.resolution = resolution_;
    if (resolution_) options.shot_resolution = *resolution_;
    return options;
}

}  // namespace stilb::cli
