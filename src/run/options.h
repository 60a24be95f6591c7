// What a run is asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "estimators/patch_light/patch_options.h"

namespace stilb::run {

struct RunOptions {
    std::string method = "auto";
    /// Stop at this relative half-width of the 95 % interval, met by 95 % of each sensor's readings.
    std::optional<double> error;
    std::optional<double> time_s;
    /// Chains (or, for `path`, paths per reading) in all.
    std::optional<std::uint64_t> paths;
    /// At most this many reflections; unlimited where absent (the estimators end chains without bias).
    std::optional<int> bounces;
    std::uint64_t seed = 1;
    /// 0: as many as the machine has.
    int threads = 0;
    /// Independent repetitions that standard errors come from (theory 6).
    int replicates = 32;
    estimators::PatchOptions patches;
};

/// Throws InputError where one of them makes no sense.
void require_valid(const RunOptions& options);

}  // namespace stilb::run

namespace stilb {
using run::RunOptions;
}  // namespace stilb
