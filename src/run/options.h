// What a run is asked for: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "estimators/patch_light/patch_options.h"

namespace stilb::run {

struct RunOptions {
    std::string method = "auto";
    /// Stop at this relative half-width of the 95 % interval, met by 95 % of each sensor's readings (of a
    /// picture's pixels, of a solution's light).
    std::optional<double> error;
    std::optional<double> time_s;
    /// In all: light chains; of method `path` paths per reading; of pictures passes; of solutions steps.
    std::optional<std::uint64_t> paths;
    /// At most this many reflections; unlimited where absent (the estimators end chains without bias).
    std::optional<int> bounces;
    std::uint64_t seed = 1;
    /// 0: as many as the machine has.
    int threads = 0;
    /// Independent repetitions that standard errors of readings come from (theory 6).
    int replicates = 32;
    estimators::PatchOptions patches;
};

/// Throws InputError where one of them makes no sense.
void require_valid(const RunOptions& options);

/// "0.01" or "1%" as 0.01; nothing where the text is neither, or not between 0 and 1.
std::optional<double> parse_relative_error(std::string_view text);

}  // namespace stilb::run

namespace stilb {
using run::RunOptions;
}  // namespace stilb
