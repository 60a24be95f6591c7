// Fitting a star-shaped surface by spherical harmonics to a mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/star_center.h"
#include "fit/star_survey.h"
#include "geometry/harmonics/projection.h"

namespace stilb::fit {

/// The treatment of a mesh that is not star-shaped in more directions than tolerated.
enum class NotStarShaped { refuse, take_outermost };

struct MeshFitOptions {
    int degree = 32;
    std::optional<Vec3> center{};    ///< searched where absent
    double tolerated_share = 0.005;  ///< of directions
    NotStarShaped otherwise = NotStarShaped::refuse;
};

struct MeshFit {
    Vec3 center;
    std::optional<double> margin;                       ///< StarCenter's, where the centre was searched
    double size = 0;                                    ///< the longest edge of the bounding box
    std::size_t turned = 0, open_edges = 0, parts = 0;  ///< OutwardMesh's
    int parallels = 0;                                  ///< of the fit's gauss_grid()
    StarSurvey survey;
    std::vector<double> coefficients;  ///< rounded to single precision
    /// Distances along rays from the centre, for the series truncated at each degree, in the directions of
    /// the survey that meet the mesh.
    std::vector<geometry::DegreeError> errors;
};

/// The number of Gauss-Legendre parallels for a degree: four times the necessary number, so that of the
/// mesh's higher degrees only those beyond seven times the degree (and beyond 220) alias into lower ones.
int parallels_for(int degree);

/// Throws InputError with `name` where the mesh is not star-shaped enough, meets no ray from the centre, or
/// where the series' radius comes to 0.
MeshFit fit_mesh(const Mesh& mesh, const MeshFitOptions& options, const std::string& name);

}  // namespace stilb::fit
