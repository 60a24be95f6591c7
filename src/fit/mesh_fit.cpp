#include "fit/mesh_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/outward.h"
#include "geometry/harmonics/surface.h"
#include "stilb/error.h"

namespace stilb::fit {
namespace {

constexpr int kFewestParallels = 128;

std::string worst_text(const StarSurvey& survey, double size) {
    std::string text;
    for (const Fold& fold : survey.worst_folds) {
        text += fmt::format("\n    {}: {:.2g} % of the size between the outermost surface and the innermost",
                            named_direction(fold.direction), 100 * fold.depth / size);
    }
    for (const Vec3& miss : survey.misses) {
        text += fmt::format("\n    {}: no surface", named_direction(miss));
    }
    return text;
}

void require_star_shape(const MeshFit& fit, const MeshFitOptions& options, const std::string& name) {
    const StarSurvey& survey = fit.survey;
    const Vec3& c = fit.center;
    if (survey.missed_share > 0.999) {
        throw InputError(fmt::format("rays from ({:.4g}, {:.4g}, {:.4g}) do not meet the mesh. Give a "
                                     "center inside the mesh.",
                                     c.x, c.y, c.z),
                         {name});
    }
    if (survey.share() <= options.tolerated_share || options.otherwise == NotStarShaped::take_outermost)
        return;
    const char* advice = options.center ? "Leave the center out to have one searched for"
                                        : "Give another center from which all of the surface is seen";
    // The tolerance is a share below 1.
    const double enough_percent = std::ceil(1000 * survey.share()) / 10;
    const std::string tolerance =
        enough_percent < 100 ? fmt::format(" or tolerance {:.1f}%", enough_percent) : "";
    throw InputError(
        fmt::format("not star-shaped about ({:.4g}, {:.4g}, {:.4g}): {:.2f} % of the directions meet the "
                    "surface more than once and {:.2f} % do not meet it, where {:.2g} % are tolerated. A "
                    "series has one radius for each direction. The worst directions:{}\n  {}; cut the mesh "
                    "into star-shaped parts; or accept the outermost surface by "
                    "the option force{}, which loses all surfaces below it.",
                    c.x, c.y, c.z, 100 * survey.folded_share, 100 * survey.missed_share,
                    100 * options.tolerated_share, worst_text(survey, fit.size), advice, tolerance),
        {name});
}

void require_positive_radius(const MeshFit& fit, const std::string& name) {
    try {
        const geometry::HarmonicSurface surface{math::HarmonicSeries<double>(fit.coefficients)};
    } catch (const InputError& error) {
        throw InputError(
            fmt::format("the series of degree {} about ({:.4g}, {:.4g}, {:.4g}) is not a surface: {}. Give "
                        "a center farther from the mesh, or a lower degree, which oscillates less.",
                        math::HarmonicSeries<double>(fit.coefficients).degree(), fit.center.x, fit.center.y,
                        fit.center.z, error.what()),
            {name});
    }
}

void set_center(const Mesh& mesh, const RadialCaster& caster, const MeshFitOptions& options, MeshFit& fit) {
    if (options.center) {
        fit.center = *options.center;
        return;
    }
    const StarCenter found = find_star_center(mesh, caster);
    fit.center = found.center;
    fit.margin = found.margin;
}

}  // namespace

int parallels_for(int degree) { return std::max(kFewestParallels, 4 * (degree + 1)); }

MeshFit fit_mesh(const Mesh& mesh, const MeshFitOptions& options, const std::string& name) {
    MeshFit fit;
    const OutwardMesh outside = outward(mesh);
    fit.turned = outside.turned;
    fit.open_edges = outside.open_edges;
    fit.parts = outside.parts;
    fit.size = 2 * bounds_of_faces(mesh).half_extent();
    const RadialCaster caster(mesh);
    set_center(outside.mesh, caster, options, fit);
    fit.survey = survey(caster, fit.center, fit.size);
    require_star_shape(fit, options, name);

    fit.parallels = parallels_for(options.degree);
    const geometry::ParallelGrid grid = geometry::gauss_grid(fit.parallels);
    std::vector<double> radii = caster.outermost(fit.center, grid.directions());
    fill_holes(grid, radii);
    fit.coefficients = project(grid, radii, options.degree);
    for (double& coefficient : fit.coefficients) coefficient = static_cast<float>(coefficient);
    require_positive_radius(fit, name);
    fit.errors = errors_by_degree(fit.survey.grid, fit.survey.outermost, fit.coefficients);
    return fit;
}

}  // namespace stilb::fit
