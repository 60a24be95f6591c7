// stilb fit: fits a surface by spherical harmonics to a star-shaped mesh.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cli/command_line.h"
#include "cli/commands/fit_report.h"
#include "cli/progress.h"
#include "io/mesh/harmonics_file.h"
#include "io/mesh/mesh_file.h"
#include "io/text/file_kind.h"
#include "io/text/text.h"
#include "run/options.h"
#include "run/schedule.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

struct FitRequest {
    std::string mesh, output, csv;
    std::string center = "auto", tolerance = "0.5%";
    int degree = 0;
    bool force = false, json = false, quiet = false;
};

std::optional<Vec3> center_of(const FitRequest& request) {
    if (request.center == "auto") return std::nullopt;
    const std::string& text = request.center;
    const std::size_t first = text.find(','), second = text.find(',', first + 1);
    if (second != std::string::npos) {
        const auto x = io::parse_number(text.substr(0, first));
        const auto y = io::parse_number(text.substr(first + 1, second - first - 1));
        const auto z = io::parse_number(text.substr(second + 1));
        if (x && y && z) return Vec3{*x, *y, *z};
    }
    throw InputError(
        fmt::format("--center {}: expected x,y,z (such as 0.1,0,2.5) or auto", io::in_quotes(text)));
}

double tolerance_of(const FitRequest& request) {
    if (request.tolerance == "0") return 0;
    if (const auto share = run::parse_relative_error(request.tolerance)) return *share;
    throw InputError(
        fmt::format("--tolerance {}: expected a share of the directions below 1, such as 0.5% or 0.005",
                    io::in_quotes(request.tolerance)));
}

fit::MeshFitOptions options_of(const FitRequest& request) {
    return {request.degree, center_of(request), tolerance_of(request),
            request.force ? fit::NotStarShaped::take_outermost : fit::NotStarShaped::refuse};
}

void check_outputs(const FitRequest& request) {
    const std::array<std::filesystem::path, 1> inputs{request.mesh};
    io::require_output(request.output, io::FileKind::series, inputs);
    if (request.csv.empty()) return;
    if (!request.csv.ends_with(".csv")) {
        throw InputError(
            fmt::format("--csv {}: expected a name that ends with .csv", io::in_quotes(request.csv)));
    }
    io::require_output(request.csv, io::FileKind::other, inputs);
}

int run_fit(const FitRequest& request) {
    const fit::MeshFitOptions options = options_of(request);
    check_outputs(request);
    const io::MeshFile file = [&] {
        const LoadingProgress loading(request.quiet ? ShowProgress::never : ShowProgress::on_terminal);
        return io::read_mesh_file(request.mesh, loading.monitor());
    }();
    const run::Clock clock;
    FitReport report;
    report.mesh = request.mesh;
    report.output = request.output;
    report.fit = fit_mesh(file.mesh, options, request.mesh);
    report.elapsed_s = clock.elapsed_s();
    report.faces = file.mesh.triangles.size();
    report.vertices = file.mesh.vertices.size();
    report.tolerated_share = options.tolerated_share;
    const fit::MeshFit& fit = report.fit;
    report.output_bytes = io::write_harmonics(
        {fit.coefficients, fit.center, std::filesystem::path(request.mesh).filename().string(),
         fit.errors.back().rms / fit.size},
        request.output);
    report.mesh_bytes = std::filesystem::file_size(request.mesh);
    if (!request.csv.empty()) io::write_csv(error_columns(report), request.csv);
    if (!request.quiet) {
        for (const std::string& warning : warnings_of(report)) print_warning(warning);
    }
    fmt::print(messages_beside(request.output), "{}", request.json ? to_json(report) : to_text(report));
    return kExitDone;
}

}  // namespace

void add_fit(CommandLine& line) {
    Command command = line.add_command("fit", "Fit a surface by spherical harmonics to a star-shaped mesh");
    command.set_examples(
        "  stilb fit head.ply -o head.json --degree 32\n"
        "  stilb fit head.ply -o head.json --degree 64 --csv errors.csv\n"
        "  stilb fit vase.obj -o vase.json --degree 16 --center 0,0,0.4 --tolerance 2%\n"
        "  stilb fit monkey.obj -o monkey.json --degree 32 --force\n");
    auto request = std::make_shared<FitRequest>();
    command.add("MESH", request->mesh, "Mesh (.obj, .ply)").required();
    command.add("-o,--output", request->output, "Surface to write (JSON)").required().value_name("FILE");
    command.add("--degree", request->degree, "Degree of the series, which has (degree + 1)^2 coefficients")
        .required()
        .from_to(0, math::kMostHarmonicDegree)
        .value_name("N");
    command
        .add("--center", request->center,
             "Origin of the radius: x,y,z; auto (default) searches for a point from which all of the "
             "surface is seen")
        .value_name("X,Y,Z");
    command
        .add("--tolerance", request->tolerance,
             "Refuse the mesh if rays do not meet it exactly once in more than this share of the directions "
             "from the centre: 0.5% (default) or 0.005")
        .value_name("SHARE");
    command.add("--force", request->force,
                "Accept a mesh that is not star-shaped: take its outermost surface, and close holes by "
                "interpolation");
    command.add("--csv", request->csv, "Write also the errors of all degrees as CSV").value_name("FILE");
    command.add("--json", request->json, "One JSON document instead of the table (docs/fit.md)");
    command.add("--quiet", request->quiet, "No warnings on stderr");
    command.run([request] { return run_fit(*request); });
}

}  // namespace stilb::cli
