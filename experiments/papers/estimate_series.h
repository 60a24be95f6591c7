// Estimates as curves with bands and as columns of tables.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/text/table.h"
#include "plot/series.h"
#include "run/run.h"

namespace stilb {

std::vector<Estimate> estimates_of(const SensorResult& result);
Estimate scaled(const Estimate& estimate, double factor);

/// A curve with the intervals as its band.
Series series_of(const std::string& name, const std::vector<double>& x, std::span<const Estimate> estimates);

/// Four columns: NAME_UNIT, NAME_standard_error_UNIT, NAME_lower_UNIT and NAME_upper_UNIT.
void add_columns(std::vector<Column>& columns, const std::string& name, const std::string& unit,
                 std::span<const Estimate> estimates);

}  // namespace stilb
