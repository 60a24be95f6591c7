// Measured grids as a false-colour picture.
#pragma once

#include "io/results/results_file.h"
#include "plot/false_colour.h"

namespace stilb::plot {

/// A panel for each grid, with mean, minimum and uniformity. Throws InputError where there is no grid or
/// their units differ: one scale cannot hold them.
FalseColour picture_of(const io::ResultsFile& results);

}  // namespace stilb::plot
