// Measured grids as a false-colour picture.
#pragma once

#include <string>

#include "io/results/results_file.h"
#include "plot/false_colour.h"
#include "run/result.h"

namespace stilb::plot {

/// A panel for each grid, with mean, minimum and uniformity. Throws InputError where there is no grid or
/// their units differ: one scale cannot hold them.
FalseColour picture_of(const io::ResultsFile& results);
/// The same of the grids among the results of a run; `scene` is what its file is called.
FalseColour picture_of(const RunResult& result, const std::string& scene);

}  // namespace stilb::plot
