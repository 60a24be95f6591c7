// What became of surfaces and lights where patches stand for them, as text for people.
#pragma once

#include <string>

#include "estimators/patch_light/patch_report.h"

namespace stilb::cli {

/// A line on patches and first shot, and one on the lights that are not replaced, if there are any.
std::string patch_text(const estimators::PatchReport& report);

}  // namespace stilb::cli
