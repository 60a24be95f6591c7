// The flags of methods that light patches.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line.h"
#include "estimators/patch_light/patch_options.h"

namespace stilb::estimators {
struct EstimatorEntry;
}

namespace stilb::cli {

struct PatchFlags {
    std::optional<double> patch_m;
    std::optional<std::string> first_shot, window, visibility, directions;
    std::optional<int> resolution;

    void add_to(Command& command);
    /// Throws InputError where one of them is given that means nothing to the method, or has no such value.
    estimators::PatchOptions options_for(const std::string& method) const;
    /// What was typed.
    std::vector<std::string_view> given() const;

  private:
    void require_known_to(const estimators::EstimatorEntry& method) const;
};

}  // namespace stilb::cli
