// Luminance pictures in false colours.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "io/image/picture.h"
#include "io/results/results_file.h"
#include "plot/false_colour.h"
#include "run/result.h"

namespace stilb::plot {

/// Draws the luminances of the pixels, one in a PNG for each (small pictures magnified, very large ones
/// averaged), as .png or .svg. Pixels of NaN and outside of a fisheye's circle are hatched. Isolines are
/// those of averages over small squares, so that they do not follow the noise of single pixels; numbers stand
/// on a coarse grid, each the mean about its middle. Throws InputError for a scale that is empty or does not
/// fit, or a file that cannot be written.
void draw_false_colour(const io::Picture& picture, const std::string& title,
                       const FalseColourOptions& options, const std::filesystem::path& path);

// Measured grids as a false-colour picture.

/// Throws InputError where the results of these sensors will contain no grid to draw.
void require_grids(std::span<const Sensor> sensors);

/// A panel for each grid, with mean, minimum and uniformity, entitled with the scene's name, or its file
/// where it has none. Throws InputError where there is no grid, where their units differ, because they have
/// one common scale, and where errors are asked for that the results do not have.
FalseColour picture_of(const io::ResultsFile& results, const FalseColourOptions& options);
/// The same for the grids among the results of a run; `scene` is the name of its file.
FalseColour picture_of(const RunResult& result, const std::string& scene, const FalseColourOptions& options);

}  // namespace stilb::plot
