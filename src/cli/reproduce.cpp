// stilb reproduce: figures of the papers, computed anew.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/sobolev_scene.h"
#include "files/plot.h"
#include "files/table.h"
#include "run/run.h"

namespace stilb {
namespace {

namespace fs = std::filesystem;

// Figure 4 of [LocalEstimation]: Sobolev's problem, p1 = p2 = h1 = h2 = 0.5

constexpr exact::ParallelPlanes kPlanes{0.5, 0.5, 0.5, 0.5, 1};
constexpr double kLargestRadius = 5;
constexpr int kRadii = 101;
/// 2,000 chains are 80 for each of them.
constexpr int kReplicates = 25;

struct Profile {
    std::string name, column;  ///< in the legend, in the table
    std::vector<Estimate> illuminance_lx;
};

std::vector<double> radii_m() {
    std::vector<double> radii;
    for (int i = 0; i < kRadii; ++i) radii.push_back(kLargestRadius * i / (kRadii - 1));
    return radii;
}

std::vector<double> exact_lx(const std::vector<double>& radii) {
    const exact::SobolevProblem problem(kPlanes);
    std::vector<double> values;
    for (const double r : radii) values.push_back(problem.illuminance_lx(exact::Plane::first, r));
    return values;
}

/// All radii from the same chains, as in the paper: the errors of neighbours go together.
Profile measure_profile(const std::vector<double>& radii, std::uint64_t chains, const std::string& name) {
    Sensor sensor{"radius", SensorType::illuminance, {}};
    for (const double r : radii)
        sensor.measurands.push_back(sobolev_point(kPlanes, exact::Plane::first, r, 0));
    RunOptions options;
    options.method = "local";
    options.paths = chains;
    options.replicates = kReplicates;
    TerminalProgress progress;
    const RunResult result =
        run(make_sobolev_scene(kPlanes, kLargestRadius), {&sensor, 1}, options, &progress);
    Profile profile{name + " chains", fmt::format("local_{}", result.paths), {}};
    for (const Reading& reading : result.sensors[0].readings) {
        profile.illuminance_lx.push_back(reading.estimate);
    }
    return profile;
}

template <typename Part>
std::vector<double> collect(const Profile& profile, Part part) {
    std::vector<double> values;
    for (std::size_t i = 0; i < profile.illuminance_lx.size(); ++i) {
        values.push_back(part(profile.illuminance_lx[i], i));
    }
    return values;
}

Series value_series(const Profile& profile, const std::vector<double>& radii) {
    Series series{profile.name, radii,
                  collect(profile, [](const Estimate& e, std::size_t) { return e.value; })};
    series.y_low = collect(profile, [](const Estimate& e, std::size_t) { return e.lower; });
    series.y_high = collect(profile, [](const Estimate& e, std::size_t) { return e.upper; });
    return series;
}

Series deviation_series(const Profile& profile, const std::vector<double>& radii,
                        const std::vector<double>& exact) {
    const auto percent = [&](double value, std::size_t i) { return 100 * (value / exact[i] - 1); };
    Series series{"", radii,
                  collect(profile, [&](const Estimate& e, std::size_t i) { return percent(e.value, i); })};
    series.y_low = collect(profile, [&](const Estimate& e, std::size_t i) { return percent(e.lower, i); });
    series.y_high = collect(profile, [&](const Estimate& e, std::size_t i) { return percent(e.upper, i); });
    return series;
}

std::vector<Column> sobolev_table(const std::vector<double>& radii, const std::vector<double>& exact,
                                  const std::array<Profile, 2>& profiles) {
    std::vector<Column> columns{{"radius_m", radii}, {"exact_lx", exact}};
    for (const Profile& p : profiles) {
        columns.push_back(
            {p.column + "_lx", collect(p, [](const Estimate& e, std::size_t) { return e.value; })});
        columns.push_back({p.column + "_standard_error_lx",
                           collect(p, [](const Estimate& e, std::size_t) { return e.standard_error; })});
        columns.push_back(
            {p.column + "_lower_lx", collect(p, [](const Estimate& e, std::size_t) { return e.lower; })});
        columns.push_back(
            {p.column + "_upper_lx", collect(p, [](const Estimate& e, std::size_t) { return e.upper; })});
    }
    return columns;
}

void reproduce_sobolev(const fs::path& directory) {
    const std::vector<double> radii = radii_m();
    const std::vector<double> exact = exact_lx(radii);
    const std::array<Profile, 2> profiles{measure_profile(radii, 2000, "2,000"),
                                          measure_profile(radii, 1000000, "1,000,000")};
    const PlotAxis radius{"r / (h1 + h2), where p1 = p2 = 0.5 and h1 = h2", ScaleType::linear, 0,
                          kLargestRadius};
    const PlotAxis illuminance{"illuminance E (h1 + h2)² / I", ScaleType::logarithmic};
    const PlotAxis deviation{"deviation, %"};
    PlotPanel values{illuminance, {}};
    std::vector<PlotPanel> deviations;
    for (std::size_t p = 0; p < profiles.size(); ++p) {
        values.series.push_back(value_series(profiles[p], radii));
        deviations.push_back({deviation, {deviation_series(profiles[p], radii, exact)}, 200});
        values.series.back().colour = deviations.back().series[0].colour = palette_colour(p + 1);
    }
    Series curve{"exact", radii, exact};
    curve.colour = palette_colour(0);
    curve.line = LineStyle::dashed;
    values.series.push_back(curve);
    Plot plot{"Sobolev's problem: local estimation and exact solution", radius, {values}};
    plot.panels.insert(plot.panels.end(), deviations.begin(), deviations.end());
    write_csv(sobolev_table(radii, exact, profiles), directory / "sobolev.csv");
    draw_plot(plot, directory / "sobolev.svg");
    draw_plot(plot, directory / "sobolev.png");
}

struct Figure {
    std::string_view name, summary;
    void (*reproduce)(const fs::path& directory);
};

constexpr std::array kFigures{Figure{
    "sobolev", "local estimation against the exact solution of Sobolev's problem (second paper, figure 4)",
    reproduce_sobolev}};

std::vector<Figure> chosen_figures(const std::string& name) {
    std::vector<std::string_view> known;
    for (const Figure& figure : kFigures) {
        if (figure.name == name) return {figure};
        known.push_back(figure.name);
    }
    if (name.empty()) return {kFigures.begin(), kFigures.end()};
    const std::string nearest = nearest_name(name, known);
    throw InputError(fmt::format("there is no figure \"{}\".{} Figures: {}.", name,
                                 nearest.empty() ? "" : fmt::format(" Did you mean \"{}\"?", nearest),
                                 fmt::join(known, ", ")));
}

int run_reproduce(const std::string& name, const fs::path& directory) {
    const std::vector<Figure> figures = chosen_figures(name);
    std::error_code error;
    fs::create_directories(directory, error);
    if (error) throw InputError("the folder cannot be made: " + error.message(), {directory.string()});
    for (const Figure& figure : figures) {
        figure.reproduce(directory);
        fmt::print("{}: {}.csv, .svg and .png are in {}\n", figure.name, figure.name, directory.string());
    }
    return kExitDone;
}

}  // namespace

void add_reproduce(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand("reproduce", "Figures of the papers, computed anew");
    set_examples(*command,
                 "  stilb reproduce sobolev -o figures\n"
                 "  stilb reproduce -o figures\n");
    std::string description = "Figure (default: all)";
    for (const Figure& figure : kFigures)
        description += fmt::format("\n  {}: {}", figure.name, figure.summary);
    auto name = std::make_shared<std::string>();
    auto directory = std::make_shared<std::string>();
    command->add_option("FIGURE", *name, description);
    command->add_option("-o,--output", *directory, "Folder for the files; made where it is missing")
        ->type_name("DIR")
        ->required();
    command->callback([name, directory, &exit_code] { exit_code = run_reproduce(*name, *directory); });
}

}  // namespace stilb
