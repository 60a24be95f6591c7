// Results as text for people.
#pragma once

#include <string>

#include "run/result.h"

namespace stilb::cli {

/// A table with every sensor's summary, small grids' values, and how the run ended.
std::string to_table(const RunResult& result);

/// A value with its interval's half-width, both with the digits that the interval leaves: "498.2 +- 1.1".
std::string with_error(const statistics::Estimate& estimate);

}  // namespace stilb::cli
