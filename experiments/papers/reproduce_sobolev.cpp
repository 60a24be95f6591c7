// Figure 4 of [LocalEstimation]: illuminance over the radius in Sobolev's problem.
//
// The paper's curve of double local estimation has a bump that is none of the method's: each of its points
// has few light paths (the paper: chains) of its own, so the errors of neighbours are independent. Light
// paths common to all points give a smooth curve. Both are drawn, with as many light paths for each point.
#include <numbers>
#include <string>
#include <vector>

#include "cli/progress.h"
#include "papers/estimate_series.h"
#include "papers/plot.h"
#include "papers/reproduce.h"
#include "run/run.h"
#include "verification/verification.h"

namespace stilb::papers {
namespace {

constexpr exact::ParallelPlanes kPlanes{0.5, 0.5, 0.5, 0.5, 1};
constexpr double kLargestRadius = 5;
constexpr int kRadii = 101;
constexpr std::uint64_t kFewPaths = 2000, kManyPaths = 1000000;
/// The few light paths are 80 for each of them.
constexpr int kReplicates = 25;
/// From where the plane is looked at, below the source.
constexpr double kEyeHeight = 0.25;

struct Profile {
    std::string name, column;  ///< in the legend, in the table
    double axis_end_percent;   ///< of its deviations
    std::vector<statistics::Estimate> illuminance_lx;
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

/// All points from the same light paths: the errors of neighbours are correlated.
std::vector<statistics::Estimate> measure(const Sensor& sensor, const std::string& method,
                                          std::uint64_t light_paths, std::uint64_t seed) {
    RunOptions options;
    options.method = method;
    options.paths = light_paths;
    options.seed = seed;
    options.replicates = kReplicates;
    cli::TerminalProgress progress;
    return estimates_of(run::measure(verification::make_sobolev_scene(kPlanes, kLargestRadius), {&sensor, 1},
                                     options, &progress)
                            .sensors[0]);
}

std::vector<statistics::Estimate> local_lx(const std::vector<double>& radii, std::uint64_t light_paths) {
    IlluminancePoints points;
    for (const double r : radii)
        points.points.push_back(verification::sobolev_point(kPlanes, exact::Plane::first, r, 0));
    return measure({"radius", points}, "local", light_paths, 1);
}

/// By the luminance L of the diffuse plane, which is looked at from above: E = pi L / p1.
std::vector<statistics::Estimate> double_local_lx(const std::vector<double>& radii, std::uint64_t seed) {
    Luminance lines;
    for (const double r : radii) lines.sights.emplace_back(LineOfSight{{r, 0, kEyeHeight}, {0, 0, -1}});
    std::vector<statistics::Estimate> estimates = measure({"radius", lines}, "double-local", kFewPaths, seed);
    for (statistics::Estimate& estimate : estimates)
        estimate = scaled(estimate, std::numbers::pi / kPlanes.reflectance_1);
    return estimates;
}

/// A run of its own for each radius.
std::vector<statistics::Estimate> separate_double_local_lx(const std::vector<double>& radii) {
    constexpr std::uint64_t kFirstSeed = 1000;
    std::vector<statistics::Estimate> estimates;
    for (std::size_t i = 0; i < radii.size(); ++i)
        estimates.push_back(double_local_lx({radii[i]}, kFirstSeed + i)[0]);
    return estimates;
}

/// Not the seed of `local`: with the same light paths both give the same numbers.
constexpr std::uint64_t kCommonSeed = 2;

std::vector<Profile> profiles_of(const std::vector<double>& radii) {
    return {
        {"local estimation, 2,000 light paths for all radii", "local_2000", 50, local_lx(radii, kFewPaths)},
        {"double local estimation, 2,000 light paths for each radius", "double_local_each_2000", 50,
         separate_double_local_lx(radii)},
        {"double local estimation, 2,000 light paths for all radii", "double_local_2000", 50,
         double_local_lx(radii, kCommonSeed)},
        {"local estimation, 1,000,000 light paths for all radii", "local_1000000", 1.5,
         local_lx(radii, kManyPaths)}};
}

Series deviation_series(const Profile& profile, const std::vector<double>& radii,
                        const std::vector<double>& exact) {
    Series series = series_of("", radii, profile.illuminance_lx);
    for (auto* list : {&series.y, &series.y_low, &series.y_high}) {
        for (std::size_t i = 0; i < list->size(); ++i) (*list)[i] = 100 * ((*list)[i] / exact[i] - 1);
    }
    return series;
}

Plot make_plot(const std::vector<double>& radii, const std::vector<double>& exact,
               const std::vector<Profile>& profiles) {
    constexpr double kDeviationHeight = 150;
    const PlotAxis radius{"r / (h1 + h2), where p1 = p2 = 0.5 and h1 = h2", plot::ScaleType::linear, 0,
                          kLargestRadius};
    PlotPanel values{{"illuminance E (h1 + h2)² / I", plot::ScaleType::logarithmic}, {}};
    std::vector<PlotPanel> deviations;
    for (std::size_t p = 0; p < profiles.size(); ++p) {
        values.series.push_back(series_of(profiles[p].name, radii, profiles[p].illuminance_lx));
        const double end = profiles[p].axis_end_percent;
        const PlotAxis deviation{"deviation, %", plot::ScaleType::linear, -end, end};
        deviations.push_back({deviation, {deviation_series(profiles[p], radii, exact)}, kDeviationHeight});
        values.series.back().colour = deviations.back().series[0].colour = palette_colour(p + 1);
    }
    Series curve{"exact", radii, exact};
    curve.colour = palette_colour(0);
    curve.line = LineStyle::dashed;
    values.series.push_back(curve);
    Plot plot{"Sobolev's problem: local and double local estimation, exact solution", radius, {values}};
    plot.panels.insert(plot.panels.end(), deviations.begin(), deviations.end());
    return plot;
}

}  // namespace

void reproduce_sobolev(const std::filesystem::path& directory) {
    const std::vector<double> radii = radii_m();
    const std::vector<double> exact = exact_lx(radii);
    const std::vector<Profile> profiles = profiles_of(radii);
    std::vector<io::Column> columns{{"radius_m", radii}, {"exact_lx", exact}};
    for (const Profile& profile : profiles)
        add_columns(columns, profile.column, "lx", profile.illuminance_lx);
    write_csv(columns, directory / "sobolev.csv");
    const Plot plot = make_plot(radii, exact, profiles);
    for (const char* name : {"sobolev.svg", "sobolev.png"}) draw_plot(plot, directory / name);
}

}  // namespace stilb::papers
