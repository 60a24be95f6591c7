// Results as `stilb measure --json` writes them, read back.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stilb::io {

/// Of all of a grid's values; NaN where the results have none.
struct MeasuredSummary {
    double mean = 0, minimum = 0, maximum = 0, uniformity = 0;
};

struct MeasuredGrid {
    std::string name;
    std::string quantity;  ///< "illuminance"
    std::string unit;      ///< "lx"
    std::array<int, 2> count{1, 1};
    /// From edge to edge along u and v; both 0 where one cell alone leaves it unknown.
    double width_m = 0, height_m = 0;
    std::vector<double> values;  ///< u fastest; NaN where there is none
    MeasuredSummary summary;
};

/// The grids of a results file; its other sensors are left out.
struct ResultsFile {
    std::string scene;
    std::vector<MeasuredGrid> grids;
};

/// Throws InputError where the file cannot be read or is no results file, naming the place.
ResultsFile read_results_file(const std::filesystem::path& path);

/// The reader itself; `name` is used in messages.
ResultsFile read_results(std::string_view content, const std::string& name);

}  // namespace stilb::io
