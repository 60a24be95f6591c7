#include "transport/light_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "materials/black.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "statistics/hypothesis.h"
#include "statistics/interval.h"
#include "support/scene_builder.h"

namespace stilb::transport {
namespace {

constexpr Box kRoom{{0, 0, 0}, {4, 3, 2.8}};
constexpr int kUnlimited = std::numeric_limits<int>::max();
constexpr std::uint64_t kLightPaths = 1 << 13;
constexpr int kPathReplicates = 32;

/// Flux [lm] that all reflections together send out: nodes' flux times albedo, from replicates.
statistics::Estimate reflected_flux(const Scene& scene, int max_nodes, const Rgb& reflectance) {
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    std::vector<double> means;
    for (int r = 0; r < kPathReplicates; ++r) {
        const math::RandomKey key = math::RandomKey{3}.derived(static_cast<std::uint64_t>(r));
        std::vector<LightVertex> nodes;
        for (std::uint64_t i = 0; i < kLightPaths; ++i) {
            trace_light_path(scene, caster, lights, max_nodes, math::SampleStream(key, i), nodes);
        }
        Rgb sum;
        for (const LightVertex& node : nodes) sum += node.flux_lm * reflectance;
        means.push_back(sum.luminance() / static_cast<double>(kLightPaths));
    }
    return statistics::estimate_from_replicates(means);
}

TEST(LightPath, NodesOfAClosedBoxReflectTheGeometricSeries) {
    const Rgb rho{{0.8, 0.5, 0.3}}, intensity{{100, 60, 30}};
    Scene scene;
    add_object(scene, kRoom, Diffuse{rho});
    add_point_light(scene, {1, 1, 1}, intensity);
    const Rgb flux = flux_lm(scene, scene.lights[0]);
    Rgb sum, power = Rgb::grey(1);
    for (const int max_nodes : {1, 2, 3}) {
        power *= rho;
        sum += flux * power;
        EXPECT_LT(std::abs(z_score(reflected_flux(scene, max_nodes, rho), sum.luminance())), 4) << max_nodes;
    }
    const Rgb all{{rho[0] / (1 - rho[0]), rho[1] / (1 - rho[1]), rho[2] / (1 - rho[2])}};
    const statistics::Estimate measured = reflected_flux(scene, kUnlimited, rho);
    EXPECT_LT(std::abs(z_score(measured, (flux * all).luminance())), 4);
    EXPECT_LT(measured.standard_error / measured.value, 0.003);
}

TEST(LightPath, NothingIsReflectedByBlackOrWithoutReflections) {
    Scene scene;
    add_object(scene, kRoom, Black{});
    add_point_light(scene, {1, 1, 1}, Rgb::grey(100));
    EXPECT_EQ(reflected_flux(scene, kUnlimited, Rgb::grey(1)).value, 0);
    scene.materials[0].material = diffuse(0.9);
    EXPECT_EQ(reflected_flux(scene, 0, Rgb::grey(1)).value, 0);
}

TEST(LightPath, MirrorsHaveNoNodes) {
    Scene scene;
    add_walls(scene, kRoom,
              {Mirror{Rgb::grey(0.9)}, diffuse(0.7), diffuse(0.7), diffuse(0.7), diffuse(0.7), diffuse(0.7)});
    add_point_light(scene, {1, 1, 1}, Rgb::grey(100));
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    std::vector<LightVertex> nodes;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        trace_light_path(scene, caster, lights, kUnlimited, math::SampleStream(math::RandomKey{4}, i), nodes);
    }
    ASSERT_GT(nodes.size(), 2000u);
    for (const LightVertex& node : nodes) {
        ASSERT_FALSE(is_specular(*node.material));
        ASSERT_LT(node.normal.x, 0.5);  // that of the mirror is 1
        ASSERT_GT(dot(node.incoming, node.normal), 0);
    }
}

}  // namespace
}  // namespace stilb::transport
