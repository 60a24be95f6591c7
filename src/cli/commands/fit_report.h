// The report of `stilb fit`: as text, as JSON and as a table.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fit/mesh_fit.h"
#include "io/text/table.h"
#include "math/spherical_harmonics.h"

namespace stilb::cli {

struct FitReport {
    std::string mesh, output;  ///< file names as typed
    std::size_t faces = 0, vertices = 0;
    std::uintmax_t mesh_bytes = 0, output_bytes = 0;
    double tolerated_share = 0;
    double elapsed_s = 0;  ///< from the mesh in memory to its series
    fit::MeshFit fit;

    int degree() const { return static_cast<int>(fit.errors.size()) - 1; }
    /// Size of the mesh with single-precision coordinates and 32-bit indices.
    std::uintmax_t bare_mesh_bytes() const { return 12 * vertices + 12 * faces; }
    /// Errors of the series truncated at a degree, as shares of the size.
    double rms_error(int of_degree) const { return error(of_degree).rms / fit.size; }
    double largest_error(int of_degree) const { return error(of_degree).maximum / fit.size; }
    /// Ratio of the bare mesh's bytes to the bytes of the coefficients up to a degree.
    double bare_ratio(int of_degree) const {
        return static_cast<double>(bare_mesh_bytes()) / static_cast<double>(bare_bytes(of_degree));
    }
    /// Size of the coefficients in single precision.
    static std::uintmax_t bare_bytes(int degree) { return 4 * math::harmonic_count(degree); }

  private:
    const geometry::DegreeError& error(int of_degree) const {
        return fit.errors[static_cast<std::size_t>(of_degree)];
    }
};

/// Warnings about the mesh and about lost detail, a sentence each.
std::vector<std::string> warnings_of(const FitReport& report);

std::string to_text(const FitReport& report);
/// The document that docs/fit.md describes.
std::string to_json(const FitReport& report);
/// The errors of all degrees up to the fit's, as shares of the size.
std::vector<io::Column> error_columns(const FitReport& report);

}  // namespace stilb::cli
