
#include "cli/run_flags.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <limits>
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

/// Limits as in scene files.
constexpr std::int64_t kMostPaths = std::int64_t{1} << 53;
constexpr std::int64_t kMostBounces = 1'000'000, kMostThreads = 4096;
constexpr std::int64_t kGreatestSeed = std::numeric_limits<std::int64_t>::max();

}  // namespace

void RunFlags::add_to(Command& command) {
    std::string methods = "Method of computation (default: auto)";
    for (const estimators::EstimatorEntry& entry : estimators::estimator_list()) {
        if (!entry.is_technique) methods += fmt::format("\n  {:12} {}", entry.name, entry.summary);
    }
    methods +=
        "\nA result names the technique that auto has chosen: path, light-paths or guided. Each may be "
        "given.";
    command.add("--method", method, methods).value_name("NAME");
    command.add("--bounces", bounces, "Limit the number of reflections (default: no limit, no bias)")
        .from_to(0, kMostBounces)
        .value_name("N");
    add_those_of_all(command);
    PatchFlags::hide_in(command);
}

void RunFlags::add_those_of_solutions(Command& command, std::optional<int>& degree) {
    command
        .add("--degree", degree,
             fmt::format("Degree of the directional basis that stores the light on glossy surfaces (default: "
                         "{}): a higher one is sharper and takes more memory",
                         run::kDefaultDegree))
        .from_to(0, math::ZernikeBasis::kMostDegree)
        .value_name("N");
    add_those_of_all(command);
    command.find("--error").description(
        "Stop when 95 % of the light falls on places with a 95 % interval within this share of their "
        "illuminance: 1% or 0.01");
    command.find("--patch").description("Longest edge of a patch [m] (default: about 3,000 patches)");
    command.find("--paths").description(
        "Stop after this many steps of ray-bundle iteration, rounded up to a multiple of 8");
    command.find("--first-shot")
        .description("First shot that replaces small lights: incoming (default) or none");
}

void RunFlags::add_those_of_all(Command& command) {
    command
        .add("--error", error,
             "Stop when 95 % of the readings of each sensor have a 95 % interval within this share of their "
             "value (dark ones of a hundredth of the mean): 1% or 0.01")
        .value_name("SHARE");
    command
        .add(
            "--time", time_s,
            "Stop after this many seconds; where they do not suffice for a first result, there is none (exit "
            "code 3)")
        .value_name("S");
    command
        .add("--paths", paths,
             "Stop after this many samples of the technique that the result names, rounded up: light paths "
             "(light-paths, local, double-local) to a multiple of 2048 (of more or less with many points), "
             "paths per reading (path) or samples (guided, radiosity) to a multiple of 32, steps "
             "(ray-bundle) to a multiple of 512 or more, particles (particles) to a multiple of 131072; "
             "pictures: passes, at least 2")
        .from_to(1, kMostPaths)
        .value_name("N");
    command.add("--seed", seed, "Seed of the random numbers: another seed gives an independent result")
        .from_to(0, kGreatestSeed)
        .value_name("N");
    command.add("--threads", threads, "Processor threads (default: all); the result does not depend on it")
        .from_to(0, kMostThreads)
        .value_name("N");
    command.add("--quiet", quiet, "Print no progress and no warnings");
    command.add("--progress", progress,
                "Print progress on stderr as plain lines, also where that is not a terminal");
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
                fmt::format("--error {}: expected a share between 0 and 1, such as 0.01 or 1%", *error));
        }
    }
    if (time_s) options.time_s = *time_s;
    if (bounces) options.bounces = *bounces;
    if (seed) options.seed = *seed;
    if (threads) options.threads = *threads;
    options.patches = patches.options_for(options.method);
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

void PatchFlags::add_to(Command& command) {
    const std::string group =
        "Patches and first shot (ray-bundle, radiosity; path with --first-shot; particles: only --patch)";
    const auto add = [&](const char* name, auto& value, const std::string& text, const char* type) {
        command.add(name, value, text).value_name(type).heading(group);
    };
    add("--patch", patch_m, "Longest edge of a patch [m] (default: about 10,000 patches)", "SIZE");
    add("--first-shot", first_shot,
        "First shot that replaces small lights: auto, none, classical, diffuse, incoming, on-the-fly "
        "(default: auto, "
        "which is incoming; path: none)",
        "NAME");
    add("--window", window,
        "Shape of item buffers on area lights, and on patches of radiosity: cube (its rear half is empty), "
        "hemicube (default) or tetrahedron; point lights always have cubes",
        "NAME");
    add("--resolution", resolution,
        "Pixels along an edge of item buffers (default: by the number of patches; 64 on patches of "
        "radiosity)",
        "R");
    add("--visibility", visibility, "Visibility backend: rays (default) or opengl", "NAME");
    add("--directions", directions,
        "Directions of the bundles in a step of ray-bundle: single, pair or frame (default)", "NAME");
}

void PatchFlags::hide_in(Command& command) {
    for (const char* name : {"--first-shot", "--window", "--resolution", "--visibility", "--directions"})
        command.find(name).hidden();
    command.find("--patch").heading("Patches (ray-bundle, radiosity, particles)");
    command.set_footer("First shot, item buffers and bundles of methods on patches: stilb help patches");
}

void add_patch_topic(CommandLine& line) {
    Command topic = line.add_topic(
        "patches",
        "The flags of methods on patches, for measure, render and report; solve has some of them, too. The\n"
        "methods are explained in docs/patches.md and docs/first-shot.md.");
    static PatchFlags flags;  // nothing is parsed
    flags.add_to(topic);
}

std::vector<std::string_view> PatchFlags::given() const {
    std::vector<std::string_view> names;
    const auto add = [&](std::string_view name, bool is_given) {
        if (is_given) names.push_back(name);
    };
    add("--patch", patch_m.has_value());
    add("--first-shot", first_shot.has_value());
    add("--window", window.has_value());
    add("--resolution", resolution.has_value());
    add("--visibility", visibility.has_value());
    add("--directions", directions.has_value());
    return names;
}

void PatchFlags::require_known_to(const estimators::EstimatorEntry& method) const {
    const auto goes_by = [](const estimators::EstimatorEntry& entry, std::string_view flag) {
        return std::ranges::find(entry.patch_options, flag.substr(2)) != entry.patch_options.end();
    };
    for (const std::string_view flag : given()) {
        if (goes_by(method, flag)) continue;
        std::vector<std::string_view> methods;
        for (const estimators::EstimatorEntry& entry : estimators::estimator_list()) {
            if (goes_by(entry, flag)) methods.push_back(entry.name);
        }
        throw InputError(fmt::format("{} has no effect with method {}. It belongs to: {}.", flag, method.name,
                                     fmt::join(methods, ", ")));
    }
    if (!method.lights_patches && !given().empty() && !first_shot) {
        throw InputError(fmt::format("{} has no effect with method {} unless --first-shot is given.",
                                     given().front(), method.name));
    }
}

estimators::PatchOptions PatchFlags::options_for(const std::string& method) const {
    require_known_to(estimators::find_estimator(method));
    estimators::PatchOptions options;
    options.patch_m = patch_m;
    options.first_shot.variant =
        first_shot == "auto"
            ? estimators::kUsualFirstShot
            : read<estimators::FirstShotVariant>("--first-shot", first_shot, estimators::kFirstShotNames);
    estimators::ShootingOptions& shooting = options.first_shot.shooting;
    shooting.window = read<patches::BufferShape>("--window", window, kWindowNames).value_or(shooting.window);
    shooting.backend = read<patches::BufferBackend>("--visibility", visibility, patches::kBufferBackendNames)
                           .value_or(shooting.backend);
    options.directions =
        read<estimators::BundleDirections>("--directions", directions, estimators::kBundleDirectionsNames)
            .value_or(options.directions);
    options.resolution = resolution;
    if (resolution) options.shot_resolution = *resolution;
    return options;
}

}  // namespace stilb::cli
