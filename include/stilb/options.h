// How a scene is computed, and when the computation stops.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "stilb/range.h"

#pragma GCC visibility push(default)

namespace stilb::api {

/// The limits of a whole number.
struct WholeRange {
    std::int64_t min = 0, max = 0;
};
/// The range of a number that texts can give, too: 0.01 or "1%".
struct Share {
    Range range;
};
/// The texts that are allowed.
struct Names {
    std::span<const std::string_view> (*all)();
};

/// One of the Options. Scene files, the command line and Python have it from Options::fields().
template <typename Owner, typename Value, typename Limits>
struct Option {
    /// The type without std::optional.
    using Plain = typename decltype(std::optional{std::declval<Value>()})::value_type;

    std::string_view key;  ///< in [run] and Python; --key on the command line
    Value Owner::*member;
    Limits limits;
    std::string_view unit;         ///< "s", "m" or nothing
    std::string_view placeholder;  ///< of its value, in --help
    std::string_view meaning;
};
template <typename Owner, typename Value, typename Limits>
Option(std::string_view, Value Owner::*, Limits, std::string_view, std::string_view, std::string_view)
    -> Option<Owner, Value, Limits>;

/// The names of all methods; those that "auto" chooses from come last.
std::span<const std::string_view> method_names();
// Those of methods on patches.
std::span<const std::string_view> first_shot_names();
std::span<const std::string_view> window_names();
std::span<const std::string_view> visibility_names();
std::span<const std::string_view> directions_names();

/// fields() describes them. Without error, time and paths, measure() stops at an error of 1 % or after a
/// minute, render() and solve() after a minute.
struct Options {
    std::string method = "auto";
    std::optional<double> error;
    std::string target = "readings";
    std::optional<double> time_s;
    std::optional<std::uint64_t> paths;
    std::optional<int> bounces;
    std::optional<double> patch_m;
    std::string by = "none";
    std::optional<std::string> first_shot, window;
    std::optional<int> resolution;
    std::optional<std::string> visibility, directions;
    std::uint64_t seed = 1;
    int threads = 0;

    static constexpr auto fields() {
        return std::tuple{
            Option{"method", &Options::method, Names{method_names}, "", "NAME",
                   "Method of computation (default: auto)"},
            Option{"error", &Options::error,
                   Share{{1e-9, 0.999999, "a share between 0 and 1, such as 0.01 or \"1%\""}}, "", "SHARE",
                   "Stop when 95 % of the readings of each sensor have a 95 % interval within this share of "
                   "their value (dark ones of a hundredth of the mean): 1% or 0.01"},
            Option{"target", &Options::target, Names{target_names}, "", "NAME",
                   "Which values must reach the error: 95 % of each sensor's readings (readings, the "
                   "default) or the means and minima of all sensors (mean)"},
            Option{"time", &Options::time_s, Range{1e-3, 1e9, "a time above 0 (from 0.001 to 1e9 s)"}, "s",
                   "S",
                   "Stop after this many seconds; where they do not suffice for a first result, there is "
                   "none (exit code 3)"},
            Option{"paths", &Options::paths, WholeRange{1, std::int64_t{1} << 53}, "", "N",
                   "Stop after this many samples of the technique that the result names, rounded up: light "
                   "paths (light-paths, local, double-local) to a multiple of 2048 (of more or less with "
                   "many points), paths per reading (path) or samples (guided, radiosity) to a multiple of "
                   "32, steps (ray-bundle) to a multiple of 512 or more, particles (particles) to a "
                   "multiple of 131072; pictures: passes, at least 2"},
            Option{"bounces", &Options::bounces, WholeRange{0, 1'000'000}, "", "N",
                   "Limit the number of reflections (default: no limit, no bias)"},
            Option{"patch", &Options::patch_m, Range{1e-6, 1e9, "a length above 0 (from 1e-6 to 1e9 m)"}, "m",
                   "SIZE", "Longest edge of a patch [m] (default: about 10,000 patches)"},
            Option{
                "by", &Options::by, Names{division_names}, "", "NAME",
                "State also what each light or group of lights gives (light), or each number of reflections "
                "(bounce), with errors; default: none"},
            Option{"first_shot", &Options::first_shot, Names{first_shot_names}, "", "NAME",
                   "First shot that replaces small lights: auto, none, classical, diffuse, incoming, "
                   "on-the-fly (default: auto, which is incoming; path: none)"},
            Option{
                "window", &Options::window, Names{window_names}, "", "NAME",
                "Shape of item buffers on area lights, and on patches of radiosity: cube (its rear half is "
                "empty), hemicube (default) or tetrahedron; point lights always have cubes"},
            Option{
                "resolution", &Options::resolution, WholeRange{0, 16384}, "", "R",
                "Pixels along an edge of item buffers (default: by the number of patches; 64 on patches of "
                "radiosity)"},
            Option{"visibility", &Options::visibility, Names{visibility_names}, "", "NAME",
                   "Visibility backend: rays (default) or opengl"},
            Option{"directions", &Options::directions, Names{directions_names}, "", "NAME",
                   "Directions of the bundles in a step of ray-bundle: single, pair or frame (default)"},
            Option{"seed", &Options::seed, WholeRange{0, std::numeric_limits<std::int64_t>::max()}, "", "N",
                   "Seed of the random numbers: another seed gives an independent result"},
            Option{"threads", &Options::threads, WholeRange{0, 4096}, "", "N",
                   "Processor threads (default: all); the result does not depend on it"}};
    }
    static std::span<const std::string_view> division_names() {
        static constexpr std::array<std::string_view, 3> names{"none", "light", "bounce"};
        return names;
    }
    static std::span<const std::string_view> target_names() {
        static constexpr std::array<std::string_view, 2> names{"readings", "mean"};
        return names;
    }
};

struct Progress {
    /// The stage of the preparation, such as "first shot"; empty when samples are being drawn.
    std::string stage;
    double elapsed_s = 0;
    double remaining_s = 0;     ///< estimated; infinite where it is not known
    double attained_error = 0;  ///< relative; infinite before the first estimate
};

/// Follows and ends a computation.
struct Control {
    /// Called some ten times a second at most, one call at a time, from any thread.
    std::function<void(const Progress&)> report;
    /// Ends the computation when it becomes true: the result so far is returned. Must outlive the call.
    const std::atomic<bool>* interrupt = nullptr;
};

}  // namespace stilb::api

#pragma GCC visibility pop
