// Estimates as curves with bands and as columns of tables.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/text/table.h"
#include "plot/plot.h"
#include "run/result.h"

namespace stilb::papers {

std::vector<statistics::Estimate> estimates_of(const SensorResult& result);
statistics::Estimate scaled(const statistics::Estimate& estimate, double factor);

/// A curve with the intervals as its band.
plot::Series series_of(const std::string& name, const std::vector<double>& x,
                       std::span<const statistics::Estimate> estimates);

/// Four columns: NAME_UNIT, NAME_standard_error_UNIT, NAME_lower_UNIT and NAME_upper_UNIT.
void add_columns(std::vector<io::Column>& columns, const std::string& name, const std::string& unit,
                 std::span<const statistics::Estimate> estimates);

}  // namespace stilb::papers
