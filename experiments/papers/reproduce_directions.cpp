// Error of ray-bundle iteration over the rays that it takes, for each way to draw directions (theory 8).
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "estimators/patch_light/ray_bundle/bundle_iteration.h"
#include "io/text/table.h"
#include "materials/diffuse.h"
#include "papers/plot.h"
#include "papers/reproduce.h"

namespace stilb::papers {
namespace {

constexpr std::array kReflectances{0.3, 0.5, 0.7, 0.8, 0.9, 0.95};
constexpr std::array kWays{estimators::BundleDirections::single, estimators::BundleDirections::pair,
                           estimators::BundleDirections::frame};
constexpr std::uint64_t kWalks = 32, kDirectionReferenceWalks = 32;
constexpr int kMostSteps = 1024;
constexpr double kEdge_m = 4, kPatch_m = 1.2;

/// A cube with a lamp at its centre.
Scene lamp_in_cube(double reflectance) {
    Scene scene;
    scene.materials.push_back({"walls", Diffuse{Rgb::grey(reflectance)}});
    scene.objects.push_back({"cube", Box{{0, 0, 0}, {kEdge_m, kEdge_m, kEdge_m}}, {MaterialId{0}}});
    const Vec3 center{kEdge_m / 2, kEdge_m / 2, kEdge_m / 2};
    scene.lights.push_back({"lamp", PointLight{center, Rgb::grey(1000 / (4 * std::numbers::pi))}});
    return scene;
}

/// What every side reflects of the light that was reflected before, its sum over some steps.
struct WalkSums {
    std::vector<double> sums_cd_m2;
    double rays = 0;
};

/// One walk's sums after 1, 2, 4 ... steps that count.
std::vector<WalkSums> walk(const estimators::PatchTransport& transport, math::RandomKey key) {
    estimators::BundleIteration iteration(transport, {key});
    for (std::uint64_t i = 0; i < first_steps(transport); ++i) iteration.step();
    const auto first_rays = static_cast<double>(iteration.rays());
    WalkSums now{std::vector<double>(transport.patches.count()), 0};
    std::vector<WalkSums> looks;
    for (int step = 1; step <= kMostSteps; ++step) {
        iteration.step();
        for (std::uint32_t patch = 0; patch < now.sums_cd_m2.size(); ++patch) {
            const std::uint32_t back = transport.patches.other_side(patch);
            now.sums_cd_m2[patch] += iteration.reflected(patch, transport.patches.normal_of(patch))[0] +
                                     iteration.reflected(back, transport.patches.normal_of(back))[0];
        }
        now.rays = static_cast<double>(iteration.rays()) - first_rays;
        if ((step & (step - 1)) == 0) looks.push_back(now);
    }
    return looks;
}

std::vector<std::vector<WalkSums>> walks(const estimators::PatchTransport& transport, math::RandomKey key,
                                         std::uint64_t count) {
    std::vector<std::vector<WalkSums>> all(count);
    parallel_for(count, [&](std::uint64_t i) { all[i] = walk(transport, key.derived(i)); });
    return all;
}

estimators::PatchTransport make_transport(const Scene& scene, const rays::RayCaster& caster,
                                          estimators::BundleDirections directions) {
    estimators::PatchOptions options;
    options.patch_m = kPatch_m;
    options.directions = directions;
    return {scene, caster, options};
}

/// Of the patches [cd/m2], by frames.
std::vector<double> reference(const Scene& scene, const rays::RayCaster& caster) {
    const estimators::PatchTransport transport =
        make_transport(scene, caster, estimators::BundleDirections::frame);
    std::vector<double> mean(transport.patches.count());
    for (const auto& looks : walks(transport, math::RandomKey{1}, kDirectionReferenceWalks)) {
        for (std::size_t patch = 0; patch < mean.size(); ++patch) {
            mean[patch] += looks.back().sums_cd_m2[patch] / (double{kDirectionReferenceWalks} * kMostSteps);
        }
    }
    return mean;
}

struct Curve {
    std::vector<double> rays, errors;
};

/// Root mean square over patches and walks, as a share of the patches' mean.
Curve error_curve(const std::vector<std::vector<WalkSums>>& walks, const std::vector<double>& expected) {
    double mean = 0;
    for (const double value : expected) mean += value / static_cast<double>(expected.size());
    Curve curve;
    for (std::size_t look = 0; look < walks[0].size(); ++look) {
        const double steps = std::ldexp(1, static_cast<int>(look));
        double squares = 0, rays = 0;
        for (const auto& looks : walks) {
            for (std::size_t patch = 0; patch < expected.size(); ++patch) {
                const double error = looks[look].sums_cd_m2[patch] / steps - expected[patch];
                squares += error * error;
            }
            rays += looks[look].rays;
        }
        const auto count = static_cast<double>(walks.size());
        curve.rays.push_back(rays / count);
        curve.errors.push_back(std::sqrt(squares / (count * static_cast<double>(expected.size()))) / mean);
    }
    return curve;
}

}  // namespace

void reproduce_directions(const std::filesystem::path& directory) {
    std::vector<double> reflectances, rays, errors;
    std::vector<std::string> ways;
    Plot plot{"Error of a cube's patches over rays, by the directions of a step",
              {"rays", plot::ScaleType::logarithmic},
              {}};
    for (const double reflectance : kReflectances) {
        const Scene scene = lamp_in_cube(reflectance);
        const rays::RayCaster caster(scene);
        const std::vector<double> expected = reference(scene, caster);
        PlotPanel panel{
            {fmt::format("error, reflectance {}", reflectance), plot::ScaleType::logarithmic}, {}, 180};
        for (const estimators::BundleDirections way : kWays) {
            const estimators::PatchTransport transport = make_transport(scene, caster, way);
            const Curve curve = error_curve(walks(transport, math::RandomKey{2}, kWalks), expected);
            panel.series.push_back({std::string(name_of(way)), curve.rays, curve.errors});
            for (std::size_t i = 0; i < curve.rays.size(); ++i) {
                reflectances.push_back(reflectance), ways.emplace_back(name_of(way));
                rays.push_back(curve.rays[i]), errors.push_back(curve.errors[i]);
            }
        }
        plot.panels.push_back(std::move(panel));
    }
    write_csv(
        std::vector<io::Column>{
            {"reflectance", reflectances}, {"directions", ways}, {"rays", rays}, {"relative_error", errors}},
        directory / "directions.csv");
    for (const char* extension : {"svg", "png"}) {
        draw_plot(plot, directory / fmt::format("directions.{}", extension));
    }
}

}  // namespace stilb::papers
