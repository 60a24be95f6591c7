// The contents of a state file.
#pragma once

#include <filesystem>
#include <string>

#include "cli/commands/info/info_report.h"

namespace stilb::cli {

/// The section "state": the command of the run, its samples and why it ended.
InfoReport report_state(const std::filesystem::path& path);
/// That section as text.
std::string state_text(const InfoReport& state);

}  // namespace stilb::cli
