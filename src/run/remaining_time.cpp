#include "run/remaining_time.h"

#include <algorithm>
#include <limits>

namespace stilb::run {

double remaining_time_s(const RunOptions& options, double elapsed_s, double attained_error,
                        double share_done) {
    double remaining_s = std::numeric_limits<double>::infinity();
    if (options.error) {
        const double ratio = attained_error / *options.error;
        remaining_s = std::min(remaining_s, elapsed_s * std::max(0.0, ratio * ratio - 1));
    }
    if (options.time_s) remaining_s = std::min(remaining_s, std::max(0.0, *options.time_s - elapsed_s));
    if (options.paths) remaining_s = std::min(remaining_s, elapsed_s * (1 / share_done - 1));
    return remaining_s;
}

}  // namespace stilb::run
