// Solutions against exact values, and their pictures against those that the same method makes directly.
#include "run/solve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "run/run.h"
#include "statistics/hypothesis.h"
#include "stilb/error.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

constexpr double kPatch_m = 0.7;

Scene room(const Material& floor) {
    Scene scene;
    const Material wall = Diffuse{{{0.7, 0.6, 0.4}}};
    add_walls(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, {wall, wall, wall, wall, floor, wall});
    add_object(scene, Box{{2, 1, 0}, {2.8, 1.8, 1}}, floor);
    add_area_light(scene, Rectangle{{1, 0.6, 2.7}, {0, 1.6, 0}, {2, 0, 0}}, Rgb::grey(100));
    add_point_light(scene, {3.2, 2.4, 2}, Rgb::grey(100));
    return scene;
}

Scene diffuse_room() { return room(Diffuse{Rgb::grey(0.3)}); }
Scene glossy_room() { return room(Phong{Rgb::grey(0.2), Rgb::grey(0.4), 20}); }

Sensor camera() {
    return {"camera",
            Camera{{0.3, 0.3, 1.5}, {2.5, 1.6, 0.7}, {0, 0, 1}, 70, {12, 8}, Projection::perspective}};
}

RunOptions options_of(std::uint64_t steps, std::uint64_t seed = 1) {
    RunOptions options;
    options.method = "ray-bundle";
    options.paths = steps;
    options.seed = seed;
    options.patches.patch_m = kPatch_m;
    return options;
}

double luminance(const RenderResult& picture, std::size_t pixel) {
    const auto& [r, g, b] = picture.pixels.rgb_cd_m2[pixel];
    return Rgb{{r, g, b}}.luminance();
}

RenderResult picture_of_solution(const Scene& scene, std::uint64_t steps, std::uint64_t seed) {
    return render_solution(scene, camera(), solve(scene, options_of(steps, seed)).solution);
}

/// All walls shine and reflect: what arrives is alike from everywhere, pi Le / (1 - r).
TEST(Solve, AFurnaceIsExact) {
    Scene scene;
    constexpr double emitted_cd_m2 = 10, reflectance = 0.5;
    add_area_light(scene, inward({{0, 0, 0}, {2, 2, 2}}), Rgb::grey(emitted_cd_m2),
                   Diffuse{Rgb::grey(reflectance)});
    RunOptions options = options_of(4096);
    options.patches.first_shot.variant = estimators::FirstShotVariant::none;
    const estimators::PatchSolution solution = solve(scene, options).solution;
    EXPECT_EQ(solution.lit_sides.size(), solution.patches.count()) << "backs receive nothing";
    const double expected = std::sqrt(std::numbers::pi) * emitted_cd_m2 / (1 - reflectance);
    double mean = 0;
    for (const auto& terms : solution.replicates) {
        for (const estimators::FloatRgb& term : terms)
            mean += double{term[0]} / static_cast<double>(terms.size());
    }
    mean /= static_cast<double>(solution.replicates.size());
    EXPECT_NEAR(mean, expected, 0.005 * expected);
}

TEST(Solve, PicturesAreThoseOfRayBundle) {
    const Scene scene = diffuse_room();
    std::vector<double> solved, direct;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        solved.push_back(picture_of_solution(scene, 384, seed).mean_luminance_cd_m2);
        direct.push_back(render(scene, camera(), options_of(8, seed + 100)).mean_luminance_cd_m2);
    }
    const statistics::Estimate a = statistics::estimate_from_replicates(solved),
                               b = statistics::estimate_from_replicates(direct);
    EXPECT_LT(a.standard_error, 0.005 * a.value);
    EXPECT_LT(b.standard_error, 0.005 * b.value);
    EXPECT_LT(std::abs(statistics::equivalent_z(z_score(a, b), 11)), statistics::sidak_threshold_z(0.001, 1))
        << a.value << ' ' << b.value;
}

/// docs/solution.md states 1.3 % for this exponent in the light of a large light, at the default degree.
TEST(Solve, GlossySurfacesAreRightWithinTheStatedError) {
    const Scene scene = glossy_room();
    const RenderResult solved = picture_of_solution(scene, 1 << 12, 1);
    const RenderResult direct = render(scene, camera(), options_of(64, 2));
    double squares = 0, noise = 0;
    const auto pixels = static_cast<double>(solved.depth_m.size());
    for (std::size_t i = 0; i < solved.depth_m.size(); ++i) {
        squares += std::pow(luminance(solved, i) - luminance(direct, i), 2) / pixels;
        noise += (std::pow(solved.pixels.standard_error_cd_m2[i], 2) +
                  std::pow(direct.pixels.standard_error_cd_m2[i], 2)) /
                 pixels;
    }
    EXPECT_LT(std::sqrt(std::max(squares - noise, 0.0)), 0.015 * direct.mean_luminance_cd_m2);
    EXPECT_NEAR(solved.mean_luminance_cd_m2, direct.mean_luminance_cd_m2, 0.01 * direct.mean_luminance_cd_m2);
}

/// The differences of independent solutions are what their errors say.
TEST(Solve, ErrorsOfPixelsAreHonest) {
    const Scene scene = glossy_room();
    std::vector<RenderResult> pictures;
    for (std::uint64_t seed = 1; seed <= 16; ++seed)
        pictures.push_back(picture_of_solution(scene, 128, seed));
    double inside = 0, all = 0;
    for (std::size_t p = 0; p < pictures.size(); p += 2) {
        EXPECT_EQ(pictures[p].replicates, 8);
        for (std::size_t i = 0; i < pictures[p].depth_m.size(); ++i) {
            const double error = std::hypot(pictures[p].pixels.standard_error_cd_m2[i],
                                            pictures[p + 1].pixels.standard_error_cd_m2[i]);
            const double difference = luminance(pictures[p], i) - luminance(pictures[p + 1], i);
            inside += std::abs(difference) <= statistics::student_t_quantile(0.975, 14) * error;
            ++all;
        }
    }
    EXPECT_GT(inside / all, 0.91);
    EXPECT_LT(inside / all, 0.99);
}

TEST(Solve, DarknessIsSolved) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {2, 2, 2}}, Diffuse{Rgb::grey(0.5)});
    const SolveResult result = solve(scene, options_of(8));
    EXPECT_TRUE(result.solution.lit_sides.empty());
    EXPECT_EQ(result.attained_error, 0);
    EXPECT_EQ(render_solution(scene, camera(), result.solution).mean_luminance_cd_m2, 0);
}

TEST(Solve, StopsAtTheErrorAskedFor) {
    RunOptions options = options_of(1);
    options.paths.reset();
    options.error = 0.1;
    const SolveResult result = solve(diffuse_room(), options);
    EXPECT_EQ(result.stop_reason, StopReason::target_reached);
    EXPECT_LE(result.attained_error, 0.1);
    EXPECT_TRUE(result.converged);
}

TEST(Solve, ThreadsChangeNothing) {
    const Scene scene = glossy_room();
    RunOptions options = options_of(128);
    options.threads = 1;
    const SolveResult one = solve(scene, options);
    options.threads = 3;
    const SolveResult three = solve(scene, options);
    EXPECT_EQ(one.solution.replicates, three.solution.replicates);
    EXPECT_EQ(one.solution.lit_sides, three.solution.lit_sides);
    EXPECT_EQ(one.samples, 128u);
}

TEST(Solve, RefusesWhatItCannotStore) {
    const Scene scene = diffuse_room();
    RunOptions options = options_of(8);
    EXPECT_THROW(solve(scene, options, 13), InputError);
    options.bounces = 2;
    EXPECT_THROW(solve(scene, options), InputError);
    options.bounces.reset();
    for (const auto variant : {estimators::FirstShotVariant::classical, estimators::FirstShotVariant::diffuse,
                               estimators::FirstShotVariant::on_the_fly}) {
        options.patches.first_shot.variant = variant;
        EXPECT_THROW(solve(scene, options), InputError) << name_of(variant);
    }
}

/// Parts that do not belong together, as a forged file may have them.
TEST(Solve, PicturesOfForeignPartsAreRefused) {
    const Scene scene = glossy_room();
    const estimators::PatchSolution good = solve(scene, options_of(8)).solution;
    const auto refused = [&](auto change) {
        estimators::PatchSolution bad = good;
        change(bad);
        EXPECT_THROW(render_solution(scene, camera(), std::move(bad)), InputError);
    };
    refused([](estimators::PatchSolution& s) {
        s.patches.corners[3][1] = static_cast<std::uint32_t>(s.patches.vertices.size());
    });
    refused([](estimators::PatchSolution& s) { s.patches.materials[2] = MaterialId{99}; });
    refused([](estimators::PatchSolution& s) { s.patches.areas_m2.pop_back(); });
    refused([](estimators::PatchSolution& s) { s.patches.areas_m2[0] = NAN; });
    refused([](estimators::PatchSolution& s) { s.patches.first_of_object.pop_back(); });
    refused([](estimators::PatchSolution& s) { s.patches.vertices[0].x = INFINITY; });
    refused([](estimators::PatchSolution& s) { s.degree = 5; });
    refused([](estimators::PatchSolution& s) { s.degree = -1; });
    refused([](estimators::PatchSolution& s) { std::swap(s.lit_sides[0], s.lit_sides[1]); });
    refused([](estimators::PatchSolution& s) {
        s.lit_sides.back() = static_cast<std::uint32_t>(2 * s.patches.count());
    });
    refused([](estimators::PatchSolution& s) { s.replicates[1].pop_back(); });
    refused([](estimators::PatchSolution& s) { s.replicates[1][0][2] = NAN; });
    refused([](estimators::PatchSolution& s) { s.replicates.resize(1); });
    refused([](estimators::PatchSolution& s) {
        std::vector<estimators::FirstShotFactors::Factor> factors(s.factors->all().begin(),
                                                                  s.factors->all().end());
        factors[0].sample = 1000;
        s.factors.emplace(std::vector(s.factors->rows().begin(), s.factors->rows().end()), factors);
    });
    refused([](estimators::PatchSolution& s) {
        std::vector rows(s.factors->rows().begin(), s.factors->rows().end());
        rows[1] = rows.back() + 1;
        s.factors.emplace(rows, std::vector(s.factors->all().begin(), s.factors->all().end()));
    });
    EXPECT_NO_THROW(render_solution(scene, camera(), good));
}

}  // namespace
}  // namespace stilb::run
