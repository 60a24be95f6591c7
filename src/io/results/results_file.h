// Reads result files, as `stilb measure --json` writes them.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stilb::io {

/// A value with half of its 95 % interval; NaN where the results have none.
struct MeasuredValue {
    double value = 0, half_width = 0;
};

/// Statistics over all values of a grid.
struct MeasuredSummary {
    MeasuredValue mean, minimum, maximum, uniformity;
};

/// A grid, or an area on its raster.
struct MeasuredGrid {
    std::string name;
    std::string quantity;  ///< "illuminance"
    std::string unit;      ///< "lx"
    std::array<int, 2> count{1, 1};
    /// The size from edge to edge along u and v; both 0 for a single cell, whose size is unknown.
    double width_m = 0, height_m = 0;
    std::vector<MeasuredValue> values;  ///< u fastest; NaN in cells without a reading
    MeasuredSummary summary;
};

/// The grids and areas of a results file; other sensors are left out.
struct ResultsFile {
    std::string scene;       ///< its file
    std::string scene_name;  ///< may be empty
    std::vector<MeasuredGrid> grids;
};

/// Throws InputError where the file cannot be read or is not a results file, with the position.
ResultsFile read_results_file(const std::filesystem::path& path);

/// The reader for content in memory; `name` is used in messages.
ResultsFile read_results(std::string_view content, const std::string& name);

}  // namespace stilb::io
