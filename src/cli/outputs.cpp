#include "cli/outputs.h"

#include "cli/command_line.h"
#include "cli/progress.h"

namespace stilb::cli {

int Outputs::conclude(int otherwise) const {
    for (const std::string& failure : failures_) print_failure(failure);
    return failures_.empty() ? otherwise : kExitCheckFailed;
}

}  // namespace stilb::cli
