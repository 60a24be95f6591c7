// What `stilb fit` says of a fit: for people, as JSON, as a plot.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fit/mesh_fit.h"
#include "math/spherical_harmonics.h"
#include "plot/plot.h"

namespace stilb::cli {

struct FitReport {
    std::string mesh, output;  ///< files as typed
    std::size_t faces = 0, vertices = 0;
    std::uintmax_t mesh_bytes = 0, output_bytes = 0;
    double tolerated_share = 0;
    double elapsed_s = 0;  ///< from the mesh that is read to its series
    fit::MeshFit fit;

    int degree() const { return static_cast<int>(fit.errors.size()) - 1; }
    /// As single-precision coordinates and 32-bit corners.
    std::uintmax_t bare_mesh_bytes() const { return 12 * vertices + 12 * faces; }
    /// Of the series if it ends with a degree, as shares of the size.
    double rms_error(int of_degree) const { return error(of_degree).rms / fit.size; }
    double largest_error(int of_degree) const { return error(of_degree).maximum / fit.size; }
    /// Of the mesh's bare bytes to the coefficients' up to a degree.
    double bare_ratio(int of_degree) const {
        return static_cast<double>(bare_mesh_bytes()) / static_cast<double>(bare_bytes(of_degree));
    }
    /// In single precision.
    static std::uintmax_t bare_bytes(int degree) { return 4 * math::harmonic_count(degree); }

  private:
    const geometry::DegreeError& error(int of_degree) const {
        return fit.errors[static_cast<std::size_t>(of_degree)];
    }
};

/// What was found odd and what is lost, a sentence each.
std::vector<std::string> warnings_of(const FitReport& report);

std::string to_text(const FitReport& report);
/// docs/fit.md has the keys.
std::string to_json(const FitReport& report);
/// Errors over degrees 1 to the fit's, which is 1 or more.
plot::Plot error_plot(const FitReport& report);

}  // namespace stilb::cli
