// The results of a run as a JSON document (docs/json.md).
#pragma once

#include <string>

#include "run/result.h"

namespace stilb::io {

/// `scene` is the scene file as the user named it. Two runs that did the same give the same text but for
/// elapsed_s and first_shot_set_up_s.
std::string to_json(const RunResult& result, const std::string& scene);

}  // namespace stilb::io
