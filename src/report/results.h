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
/// What each light, group or number of reflections gives; nothing where the run has not kept them apart.
Html shares(const RunResult& result);
/// The power of the lamps, what is required, values and glare in a state of the lamps.
Html light_scene(const RunResult& lit);
/// Ratings of glare with their sources; nothing where there are none.
Html glare(const RunResult& result);
/// All readings of all sensors, one by one.
Html all_readings(const RunResult& result);

}  // namespace stilb::report
