// Figure 6 of [LocalEstimation]: the angular distribution of multiply reflected light in Sobolev's problem,
// with a spherical source and Phong's reflection.
#include <fmt/format.h>

#include <numbers>
#include <string>
#include <vector>

#include "cli/progress.h"
#include "io/text/table.h"
#include "materials/black.h"
#include "materials/diffuse.h"
#include "materials/phong.h"
#include "papers/estimate_series.h"
#include "papers/plot.h"
#include "papers/reproduce.h"
#include "sensors/goniometer.h"
#include "verification/verification.h"

namespace stilb::papers {
namespace {

// What the paper leaves open: everything but the kinds of surface and source.
constexpr exact::ParallelPlanes kPolarPlanes{0.5, 0.5, 0.5, 0.5, 1};
constexpr double kSpecular = 0.3;  // of the reflectances
constexpr double kSourceRadius_m = 0.1;
constexpr double kRadius_m = 1;
constexpr double kStep_deg = 3;

constexpr std::uint64_t kLightPaths = 16384;  // of each run
constexpr int kRuns = 16;

Material phong(double reflectance, double exponent) {
    return Phong{Rgb::grey(reflectance - kSpecular), Rgb::grey(kSpecular), exponent};
}

/// The surfaces are `first` and `second`, the source is a sphere of the same intensity.
Scene scene_with(const Material& first, const Material& second) {
    Scene scene = verification::make_sobolev_scene(kPolarPlanes, kRadius_m);
    scene.materials[0].material = first;
    scene.materials[1].material = second;
    scene.materials.push_back({"source", Black{}});
    scene.objects.push_back(
        {"source", Sphere{{0, 0, kPolarPlanes.distance_1_m}, kSourceRadius_m}, {MaterialId{2}}});
    const double disk_m2 = std::numbers::pi * kSourceRadius_m * kSourceRadius_m;
    scene.lights = {{"source", AreaLight{ObjectId{2}, Rgb::grey(kPolarPlanes.intensity_cd / disk_m2)}}};
    return scene;
}

struct Distribution {
    std::string name, column;  ///< in the legend, in the table
    std::vector<statistics::Estimate> luminance_cd_m2;
};

std::vector<statistics::Estimate> measure(const Scene& scene, const Sensor& sensor) {
    RunOptions options;
    options.method = "double-local";
    options.paths = kLightPaths;
    options.replicates = 4;
    cli::TerminalProgress progress;
    return multiply_reflected_cd_m2(scene, sensor, options, kRuns, &progress);
}

std::vector<Distribution> distributions(const Sensor& sensor) {
    const Material diffuse_1 = Diffuse{Rgb::grey(kPolarPlanes.reflectance_1)};
    const Material diffuse_2 = Diffuse{Rgb::grey(kPolarPlanes.reflectance_2)};
    std::vector<Distribution> all{
        {"diffuse 0.5", "diffuse", measure(scene_with(diffuse_1, diffuse_2), sensor)}};
    for (const int exponent : {5, 15, 40}) {
        const Scene scene = scene_with(phong(kPolarPlanes.reflectance_1, exponent),
                                       phong(kPolarPlanes.reflectance_2, exponent));
        all.push_back({fmt::format("diffuse 0.2 and Phong 0.3, exponent {}", exponent),
                       fmt::format("phong_{}", exponent), measure(scene, sensor)});
    }
    return all;
}

}  // namespace

void reproduce_polar(const std::filesystem::path& directory) {
    const Goniometer goniometer{{kRadius_m, 0, 0}, {0, 0, 1}, 0.0, kStep_deg};
    const Sensor sensor{"polar", goniometer};
    std::vector<double> theta_deg;
    for (std::size_t j = 0; j < goniometer.size(); ++j) theta_deg.push_back(goniometer.angles(j).theta_deg);
    std::vector<io::Column> columns{{"theta_deg", theta_deg}};
    PolarPlot plot{"Sobolev's problem with Phong surfaces: light reflected more than once",
                   "luminance, cd/m²; r = h1 + h2 = 1 m, h1 = h2, source of 1 cd; θ > 0: away from it",
                   {}};
    for (const Distribution& distribution : distributions(sensor)) {
        plot.series.push_back(series_of(distribution.name, theta_deg, distribution.luminance_cd_m2));
        add_columns(columns, distribution.column, "cd_m2", distribution.luminance_cd_m2);
    }
    write_csv(columns, directory / "polar.csv");
    for (const char* name : {"polar.svg", "polar.png"}) draw_polar_plot(plot, directory / name);
}

}  // namespace stilb::papers
