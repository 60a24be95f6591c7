// How to compute, and when to stop.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace stilb::api {

struct Options {
    /// As in docs/methods: "auto", "path" ...
    std::string method = "auto";
    /// Stop when 95 % of each sensor's readings have a 95 % interval within this share of their value.
    std::optional<double> error;
    std::optional<double> time_s;
    /// Stop after so many samples: what one is depends on the method (docs/methods).
    std::optional<std::uint64_t> samples;
    /// At most so many reflections; no limit where absent.
    std::optional<int> bounces;
    /// Another seed gives an independent result; the same one gives the same digits.
    std::uint64_t seed = 1;
    /// 0: as many as the machine has. The result does not depend on it.
    int threads = 0;
};

/// How far a run is.
struct Progress {
    double elapsed_s = 0;
    double remaining_s = 0;  ///< estimated; infinite where nothing is known yet
    double attained_error = 0;
};

/// How to follow and to end a run.
struct Control {
    /// Called from the run's own thread, a few times a second at most.
    std::function<void(const Progress&)> report;
    /// Ends the run in good order when it becomes true; outlives the run.
    const std::atomic<bool>* interrupt = nullptr;
};

}  // namespace stilb::api
