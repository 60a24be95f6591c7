// How long a run will still take.
#pragma once

#include "run/options.h"

namespace stilb::run {

/// Seconds until the first of the targets is met, infinite without any: the error falls as the root of time,
/// paths take alike. `attained_error` may be infinite, `share_done` is that of the paths asked for.
double remaining_time_s(const RunOptions& options, double elapsed_s, double attained_error,
                        double share_done);

}  // namespace stilb::run
