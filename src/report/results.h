// The results of a run in a report.
#pragma once

#include "report/html.h"
#include "run/options.h"
#include "run/result.h"

namespace stilb::report {

/// How sure the results are, in plain words.
Html certainty(const RunResult& result, const RunOptions& options);
/// Whether requirements are met; nothing where there are none.
Html requirements(const RunResult& result);
/// The statistics of the sensors, and single values.
Html measured_values(const RunResult& result);
/// Ratings of glare with their sources; nothing where there are none.
Html glare(const RunResult& result);
/// All readings of all sensors, one by one.
Html all_readings(const RunResult& result);

}  // namespace stilb::report
