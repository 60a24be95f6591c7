// Pictures of a glossy room by light paths, and by a guess of the light, against path tracing: vertices are
// chosen by their lobes, and connections and gathering rays must share the light of each pixel by the same
// weights.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "base/parallel.h"
#include "estimators/estimator_list.h"
#include "materials/phong.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "statistics/hypothesis.h"
#include "support/coarser.h"
#include "support/scene_builder.h"
#include "transport/receiver.h"

namespace stilb {
namespace {

constexpr std::size_t kReplicates = 16;
constexpr int kCell = 8;

/// A polished floor, a ball of plastic on it and a block of rough metal, under a lamp.
Scene glossy_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.5}}, diffuse(0.6));
    add_object(scene, Rectangle{{0, 0, 0.002}, {4, 0, 0}, {0, 3, 0}},
               Phong{Rgb::grey(0.25), Rgb::grey(0.25), 80});
    add_object(scene, Sphere{{2.2, 1.5, 0.41}, 0.4}, materials::Plastic({Rgb::grey(0.3), 1.5, 0.1}));
    add_object(scene, Box{{3, 2, 0.01}, {3.5, 2.5, 1.2}}, materials::RoughConductor({Rgb::grey(0.75), 0.25}));
    add_area_light(scene, Rectangle{{1.2, 0.8, 2.48}, {0, 0.8, 0}, {0.6, 0, 0}}, Rgb::grey(2000));
    return scene;
}

Camera camera() {
    Camera camera;
    camera.position = {0.3, 0.3, 1.5};
    camera.target = {2.6, 1.8, 0.7};
    camera.fov_deg = 75;
    camera.resolution = {32, 24};
    return camera;
}

/// Means over cells of the picture, by cells, then by replicates.
std::vector<std::vector<double>> means_of(const estimators::Estimator& method, math::RandomKey key,
                                          std::uint64_t passes) {
    const std::vector<estimators::PixelBlock> cells =
        estimators::blocks_of(camera().resolution, {kCell, kCell}, kCell);
    std::vector<std::vector<double>> means(cells.size(), std::vector<double>(kReplicates));
    parallel_for(kReplicates, [&](std::size_t r) {
        for (std::uint64_t pass = 0; pass < passes; ++pass) {
            const auto started = method.start({key.derived(r), pass, r});
            for (std::size_t c = 0; c < cells.size(); ++c) {
                estimators::Tally pixels(cells[c].pixels());
                started->sample(cells[c], pixels);
                for (const Rgb& pixel : pixels.sum)
                    means[c][r] += pixel.luminance() / static_cast<double>(passes * pixels.sum.size());
            }
        }
    });
    return means;
}

void expect_equal(std::span<const double> a, std::span<const double> b, double threshold,
                  double least_error) {
    const auto x = statistics::estimate_from_replicates(a);
    const auto y = statistics::estimate_from_replicates(b);
    EXPECT_LT(std::max(x.standard_error, y.standard_error), least_error * x.value);
    EXPECT_LT(std::abs(statistics::equivalent_z(statistics::z_score(x, y), kReplicates - 1)), threshold)
        << x.value << " +- " << x.standard_error << ", " << y.value << " +- " << y.standard_error;
}

std::vector<double> sum_of_cells(const std::vector<std::vector<double>>& means) {
    std::vector<double> sum(kReplicates);
    for (const auto& of_cell : means) {
        for (std::size_t r = 0; r < kReplicates; ++r) sum[r] += of_cell[r];
    }
    return sum;
}

TEST(GlossyPicture, IsThatOfPathTracing) {
    const Scene scene = glossy_room();
    const rays::RayCaster caster(scene);
    const math::RandomKey key{22};
    const estimators::Problem problem{.scene = scene,
                                      .caster = caster,
                                      .max_reflections = transport::kUnlimited,
                                      .preparation_key = {key.derived(0)},
                                      .camera = camera()};
    const double factor = coarser(2.3);
    const std::uint64_t passes = fewer(128, 2.3);
    const auto path = means_of(*estimators::make_path(problem), key.derived(1), passes);
    const auto by_light_paths = means_of(*estimators::make_balanced(problem), key.derived(2), passes);
    const auto by_guess = means_of(*estimators::make_guided(problem), key.derived(3), passes);
    const double threshold = statistics::sidak_threshold_z(0.01, 2 * (path.size() + 1));
    for (const auto& other : {by_light_paths, by_guess}) {
        for (std::size_t c = 0; c < path.size(); ++c)
            expect_equal(path[c], other[c], threshold, 0.03 * factor);
        expect_equal(sum_of_cells(path), sum_of_cells(other), threshold, 0.002 * factor);
    }
}

}  // namespace
}  // namespace stilb
