#include "cli/commands/fit_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/version.h"
#include "math/spherical_harmonics.h"

namespace stilb::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The degrees in the table: 4, 8, 16 ... and the fit's own.
std::vector<int> degrees_of(const FitReport& report) {
    std::vector<int> degrees;
    for (int degree = 4; degree < report.degree(); degree *= 2) degrees.push_back(degree);
    degrees.push_back(report.degree());
    return degrees;
}

double ratio(std::uintmax_t a, std::uintmax_t b) { return static_cast<double>(a) / static_cast<double>(b); }

std::string center_text(const fit::MeshFit& fit) {
    std::string text =
        fmt::format("centre ({:.6g}, {:.6g}, {:.6g}): ", fit.center.x, fit.center.y, fit.center.z);
    if (!fit.margin) return text + "as given";
    if (*fit.margin > 0) {
        return text + fmt::format("all faces are seen from their front, with {:.2g} % of the size to spare",
                                  100 * *fit.margin / fit.size);
    }
    return text +
           "found by search for the fewest surplus crossings, because no point sees all faces from their "
           "front";
}

std::string star_text(const fit::MeshFit& fit) {
    const fit::StarSurvey& survey = fit.survey;
    std::string text =
        fmt::format("directions that meet the surface more than once: {:.3f} %; not at all: {:.3f} %\n",
                    100 * survey.folded_share, 100 * survey.missed_share);
    for (const fit::Fold& fold : survey.worst_folds) {
        text += fmt::format("  {}: {:.2g} % of the size deep\n", fit::named_direction(fold.direction),
                            100 * fold.depth / fit.size);
    }
    for (const Vec3& miss : survey.misses)
        text += fmt::format("  {}: no surface\n", fit::named_direction(miss));
    return text;
}

Json direction_json(const Vec3& direction) {
    const fit::Angles angles = fit::angles_of(direction);
    return {{"direction", {direction.x, direction.y, direction.z}},
            {"theta_deg", angles.theta_deg},
            {"phi_deg", angles.phi_deg}};
}

Json star_json(const FitReport& report) {
    const fit::StarSurvey& survey = report.fit.survey;
    Json folds = Json::array(), misses = Json::array();
    for (const fit::Fold& fold : survey.worst_folds) {
        folds.push_back(direction_json(fold.direction));
        folds.back()["depth"] = fold.depth / report.fit.size;
    }
    for (const Vec3& miss : survey.misses) misses.push_back(direction_json(miss));
    return {{"directions", survey.grid.size()},    {"tolerated_share", report.tolerated_share},
            {"folded_share", survey.folded_share}, {"missed_share", survey.missed_share},
            {"worst_folds", std::move(folds)},     {"misses", std::move(misses)}};
}

Json errors_json(const FitReport& report) {
    Json errors = Json::array();
    for (int degree = 0; degree <= report.degree(); ++degree) {
        errors.push_back({{"degree", degree},
                          {"coefficients", math::harmonic_count(degree)},
                          {"rms", report.rms_error(degree)},
                          {"maximum", report.largest_error(degree)}});
    }
    return errors;
}

}  // namespace

std::vector<std::string> warnings_of(const FitReport& report) {
    const fit::MeshFit& fit = report.fit;
    const fit::StarSurvey& survey = fit.survey;
    std::vector<std::string> warnings;
    if (fit.turned > 0) {
        warnings.push_back(fmt::format(
            "{} of {} faces were reversed so that their front is outside, for the search of the centre.",
            fit.turned, report.faces));
    }
    if (fit.open_edges > 0) {
        warnings.push_back(fmt::format(
            "the mesh is not closed: {} edges belong to one face or to more than two.", fit.open_edges));
    }
    if (survey.folded_share > 0) {
        const double deepest = survey.worst_folds.front().depth / fit.size;
        warnings.push_back(fmt::format(
            "in {:.3f} % of the directions the outermost of several surfaces is taken; the surfaces "
            "below it, down to {:.2g} % of the size, are lost.",
            100 * survey.folded_share, 100 * deepest));
    }
    if (survey.missed_share > 0) {
        warnings.push_back(fmt::format(
            "in {:.3f} % of the directions there is no surface: the holes are closed by interpolation, "
            "and the stated errors leave them out.",
            100 * survey.missed_share));
    }
    return warnings;
}

std::string to_text(const FitReport& report) {
    const fit::MeshFit& fit = report.fit;
    std::string text = fmt::format(
        "{}: {} vertices, {} faces, {} part{}; size {:.6g} (longest edge of its box)\n", report.mesh,
        report.vertices, report.faces, fit.parts, fit.parts == 1 ? "" : "s", fit.size);
    text += center_text(fit) + "\n" + star_text(fit);
    text += "\ndegree  coefficients     bytes    mesh / series    rms error   largest error\n";
    for (const int degree : degrees_of(report)) {
        text += fmt::format("{:6} {:13} {:9} {:16.4g} {:10.3g} % {:13.3g} %\n", degree,
                            math::harmonic_count(degree), FitReport::bare_bytes(degree),
                            report.bare_ratio(degree), 100 * report.rms_error(degree),
                            100 * report.largest_error(degree));
    }
    text += fmt::format(
        "errors along rays from the centre, in {} directions, as shares of the size\n"
        "bytes of single-precision coefficients; the mesh has {} as bare vertices and faces\n\n",
        fit.survey.grid.size(), report.bare_mesh_bytes());
    text +=
        fmt::format("{}: {} bytes; {}: {} bytes, {:.4g} times as many\n", report.output, report.output_bytes,
                    report.mesh, report.mesh_bytes, ratio(report.mesh_bytes, report.output_bytes));
    text += fmt::format("fitted to {} x {} directions in {:.1f} s\n", fit.parallels, 2 * fit.parallels,
                        report.elapsed_s);
    return text;
}

std::string to_json(const FitReport& report) {
    const fit::MeshFit& fit = report.fit;
    Json json;
    json["stilb"] = program_version();
    json["mesh"] = {
        {"file", report.mesh}, {"faces", report.faces},        {"vertices", report.vertices},
        {"parts", fit.parts},  {"open_edges", fit.open_edges}, {"turned_faces", fit.turned},
        {"size", fit.size},    {"bytes", report.mesh_bytes},   {"bare_bytes", report.bare_mesh_bytes()}};
    json["center"] = {{"position", {fit.center.x, fit.center.y, fit.center.z}},
                      {"margin", fit.margin ? Json(*fit.margin / fit.size) : Json()}};
    json["star_shape"] = star_json(report);
    json["series"] = {{"file", report.output},
                      {"degree", report.degree()},
                      {"coefficients", fit.coefficients.size()},
                      {"bytes", report.output_bytes},
                      {"bare_bytes", FitReport::bare_bytes(report.degree())},
                      {"ratio", ratio(report.mesh_bytes, report.output_bytes)},
                      {"bare_ratio", report.bare_ratio(report.degree())}};
    json["errors"] = errors_json(report);
    json["grid"] = {fit.parallels, 2 * fit.parallels};
    json["elapsed_s"] = report.elapsed_s;
    json["warnings"] = warnings_of(report);
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<io::Column> error_columns(const FitReport& report) {
    std::vector<double> degrees, coefficients, rms, maximum;
    for (int degree = 0; degree <= report.degree(); ++degree) {
        degrees.push_back(degree);
        coefficients.push_back(static_cast<double>(math::harmonic_count(degree)));
        rms.push_back(report.rms_error(degree));
        maximum.push_back(report.largest_error(degree));
    }
    return {{"degree", degrees}, {"coefficients", coefficients}, {"rms", rms}, {"maximum", maximum}};
}

}  // namespace stilb::cli
