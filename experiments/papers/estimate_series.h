// Estimates: as curves with bands, as columns of tables, and of multiply reflected light alone.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/text/table.h"
#include "papers/plot.h"
#include "run/result.h"
#include "run/run.h"

namespace stilb::papers {

std::vector<statistics::Estimate> estimates_of(const SensorResult& result);
statistics::Estimate scaled(const statistics::Estimate& estimate, double factor);

/// A curve with the intervals as its band.
Series series_of(const std::string& name, const std::vector<double>& x,
                 std::span<const statistics::Estimate> estimates);

/// Four columns: NAME_UNIT, NAME_standard_error_UNIT, NAME_lower_UNIT and NAME_upper_UNIT.
void add_columns(std::vector<io::Column>& columns, const std::string& name, const std::string& unit,
                 std::span<const statistics::Estimate> estimates);

/// The luminance [cd/m2] of at least two reflections at each of the readings of a luminance sensor. Of
/// `options`, paths are those of each of `runs` pairs of runs, whose seeds follow on the given one; bounces
/// does not count.
std::vector<statistics::Estimate> multiply_reflected_cd_m2(const Scene& scene, const Sensor& sensor,
                                                           const RunOptions& options, int runs,
                                                           ProgressSink* progress = nullptr);

}  // namespace stilb::papers
