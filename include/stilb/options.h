// How a scene is computed, and when the computation stops.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace stilb::api {

/// Without error, time and samples, measure() stops at an error of 1 % or after a minute, render() and
/// solve() after a minute.
struct Options {
    /// "auto", "local", "double-local", "path", "ray-bundle", "radiosity" or "particles"; or one of those
    /// that "auto" chooses from, as Summary::technique names it.
    std::string method = "auto";
    /// Stops when 95 % of each sensor's readings (of a picture's pixels) have a 95 % interval within this
    /// share of their value, such as 0.01.
    std::optional<double> error;
    /// The values that `error` is asked of: "readings", each of them, or "mean", the means and minima of all
    /// sensors.
    std::string target = "readings";
    /// Stops after this time [s].
    std::optional<double> time_s;
    /// Stops after this number of samples of the technique that the result names: light paths; "path": paths
    /// of each reading; pictures: samples of each pixel; solutions: steps of the iteration.
    std::optional<std::uint64_t> samples;
    /// The largest number of reflections; without it there is no limit, and no bias.
    std::optional<int> bounces;
    /// Longest edge of a patch [m], for methods that divide surfaces into patches.
    std::optional<double> patch_m;
    /// Each seed gives an independent result; the same seed and number of samples give the same digits.
    std::uint64_t seed = 1;
    /// 0: as many as the machine has. The result does not depend on it.
    int threads = 0;
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
