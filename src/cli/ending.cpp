#include "cli/ending.h"

#include <fmt/format.h>

namespace stilb::cli {

std::string ending(StopReason reason, std::string_view all) {
    switch (reason) {
        case StopReason::target_reached:
            return "the error asked for is reached";
        case StopReason::paths_done:
            return fmt::format("all {} done", all);
        case StopReason::time_over:
            return "time limit reached";
        case StopReason::interrupted:
            return "interrupted";
        case StopReason::solved:
            break;
    }
    return "solved";
}

}  // namespace stilb::cli
