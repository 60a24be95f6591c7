// The light that a thin sheet of glass lets through.
#pragma once

namespace stilb::exact {

/// A thin plane sheet with parallel faces in air.
struct PaneOptics {
    double ior = 1.5;                   ///< of the sheet, above 1
    double internal_transmittance = 1;  ///< of one passage along the normal, without the faces; 0 to 1
};

/// Of unpolarised light at `angle_rad` to the normal, with all reflections between the faces: by Fresnel's
/// formulas in sines and tangents [Born, Wolf 1999, 1.5.2 (21a)] and the series of the passages. Relative
/// error below 1e-12. Throws std::domain_error on arguments out of range and on angles of 90 degrees or more.
double pane_transmittance(const PaneOptics& pane, double angle_rad);

}  // namespace stilb::exact
