// Solutions against exact values, and their pictures against those that the same method makes directly.
#include "run/solve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "estimators/patch_light/solution/light_vertices.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "materials/plastic.h"
#include "run/run.h"
#include "run/solution_errors.h"
#include "scene/light_groups.h"
#include "statistics/hypothesis.h"
#include "stilb/error.h"
#include "support/coarser.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

constexpr double kPatch_m = 1;
constexpr std::uint64_t kLeastSteps = 24;  ///< of a solution that is compared
/// Solutions of a mean that is compared by its standard error. Sanitizers take half a minute for each.
const std::uint64_t kSolutions = coarser() > 1 ? 3 : 5;

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
Scene room_with_glossy_floor() { return room(Phong{Rgb::grey(0.2), Rgb::grey(0.4), 20}); }

/// The comparison of a picture with path tracing takes most of its time, as long for few pixels as for a
/// thousand: a few pictures of long solutions are as sure as many of short ones.
Sensor camera() {
    return {"camera",
            Camera{{0.3, 0.3, 1.5}, {2.5, 1.6, 0.7}, {0, 0, 1}, 70, {12, 8}, Projection::perspective}};
}

RunOptions options_of(std::uint64_t steps, std::uint64_t seed = 1) {
    RunOptions options;
    options.method = "ray-bundle";
    options.paths = steps;
    options.seed = seed;
    options.patch_m = kPatch_m;
    return options;
}

double luminance(const RenderResult& picture, std::size_t pixel) {
    const auto& [r, g, b] = picture.pixels.rgb_cd_m2[pixel];
    return Rgb{{r, g, b}}.luminance();
}

/// Of the lit vertices, by all groups, without direct light.
std::vector<double> illuminances_lx(const Scene& scene, const estimators::PatchSolution& solution) {
    const estimators::LightVertices vertices(scene, solution.patches, solution.degree, solution.lit_vertices);
    std::vector<double> illuminances;
    for (std::uint32_t i = 0; i < vertices.count(); ++i) {
        Rgb sum;
        for (const auto& group : solution.terms) sum += to_rgb(group[vertices.first_term(i)]);
        illuminances.push_back(std::sqrt(std::numbers::pi) * sum.luminance());
    }
    return illuminances;
}

RenderResult picture_of_solution(const Scene& scene, std::uint64_t steps, std::uint64_t seed) {
    return render_solution(scene, camera(), solve(scene, options_of(steps, seed)).solution);
}

/// All walls shine and reflect: what arrives after reflections is alike from everywhere, pi Le r / (1 - r).
TEST(Solve, AFurnaceIsExact) {
    Scene scene;
    constexpr double emitted_cd_m2 = 10, reflectance = 0.5;
    add_area_light(scene, inward({{0, 0, 0}, {2, 2, 2}}), Rgb::grey(emitted_cd_m2),
                   Diffuse{Rgb::grey(reflectance)});
    RunOptions options = options_of(4096);
    options.patches.first_shot.variant = estimators::FirstShotVariant::none;
    const estimators::PatchSolution solution = solve(scene, options).solution;
    EXPECT_EQ(solution.lit_vertices.size(), solution.patches.vertices.size()) << "backs receive nothing";
    const double expected = std::sqrt(std::numbers::pi) * emitted_cd_m2 * reflectance / (1 - reflectance);
    double mean = 0;
    for (const HalfRgb& term : solution.terms[0]) mean += to_rgb(term)[0];
    mean /= static_cast<double>(solution.terms[0].size());
    EXPECT_NEAR(mean, expected, 0.005 * expected);
    for (const Half bias : solution.bias) EXPECT_LT(to_float(bias), 0.05);
}

/// Mean luminances of pictures, by solutions and by path tracing.
struct Means {
    statistics::Estimate solved, traced;
};
Means means_of(const Scene& scene, std::uint64_t steps, std::uint64_t passes, std::uint64_t solutions = 3) {
    RunOptions paths;
    paths.method = "path";
    paths.paths = passes;
    std::vector<double> solved, traced;
    for (std::uint64_t seed = 1; seed <= solutions; ++seed) {
        solved.push_back(picture_of_solution(scene, steps, seed).mean_luminance_cd_m2);
        paths.seed = seed + 100;
        traced.push_back(render(scene, camera(), paths).mean_luminance_cd_m2);
    }
    return {statistics::estimate_from_replicates(solved), statistics::estimate_from_replicates(traced)};
}

void expect_equal(const statistics::Estimate& a, const statistics::Estimate& b, double factor) {
    EXPECT_LT(a.standard_error, 0.003 * coarser(factor) * a.value);
    EXPECT_LT(b.standard_error, 0.003 * coarser(factor) * b.value);
    EXPECT_LT(std::abs(statistics::equivalent_z(z_score(a, b), static_cast<int>(kSolutions - 1))),
              statistics::sidak_threshold_z(0.001, 1))
        << a.value << ' ' << b.value;
}

void expect_the_light_of_paths(const Scene& scene) {
    constexpr double factor = 1.7;
    const Means means =
        means_of(scene, std::max(fewer(384, factor), kLeastSteps), fewer(819, factor), kSolutions);
    expect_equal(means.solved, means.traced, factor);
}

TEST(Solve, PicturesAreThoseOfPathTracing) { expect_the_light_of_paths(diffuse_room()); }
TEST(Solve, PicturesOfGlossySurfacesAreThoseOfPathTracing) {
    expect_the_light_of_paths(room_with_glossy_floor());
}

/// Up to 16 lamps a picture takes all of them, of more it chooses some (solution_picture.cpp, kMostLights).
/// One lamp that is cut into several in one place gives the light of one.
TEST(Solve, PicturesOfManyLampsLoseNoLight) {
    const auto mean_of = [](int lamps) {
        Scene scene = diffuse_room();
        scene.lights.pop_back();
        for (int i = 0; i < lamps; ++i) add_point_light(scene, {3.2, 2.4, 2}, Rgb::grey(400. / lamps));
        return picture_of_solution(scene, 192, 1).mean_luminance_cd_m2;
    };
    // A lamp of 17 would be 4 % of the light; the noise is 0.3 %.
    const double one = mean_of(1);
    for (const int lamps : {14, 15, 16}) EXPECT_NEAR(mean_of(lamps) / one, 1, 0.015);  // and one with an area
}

/// Boxes on the floor cover parts of patches; ray-bundle spreads the light of the free part over all of
/// them, and is 1.4 % dark in such a room.
TEST(Solve, ThingsOnTheFloorTakeNoLight) {
    Scene scene = diffuse_room();
    for (double x = 0.3; x < 3.5; x += 0.9)
        add_object(scene, Box{{x, 0.3, 0}, {x + 0.4, 0.7, 0.3}}, Diffuse{Rgb::grey(0.6)});
    // Patches of 1 m leave the solution 0.55 % dark (12.383 and 12.452 cd/m2 with 384 steps and 2048 passes).
    const Means means = means_of(scene, 256, 512);
    EXPECT_NEAR(means.solved.value, means.traced.value, 0.01 * means.traced.value);
}

/// A ray may meet the leg where the patch in the same plane is the top's, whose light has more terms.
TEST(Solve, AGlossyTopMayStandOnItsLeg) {
    Scene scene = diffuse_room();
    add_object(scene, Box{{1.6, 0.6, 1}, {3.2, 2.2, 1.05}}, Plastic({Rgb::grey(0.4), 1.5, 0.15}));
    // As above, patches leave an error.
    const Means means = means_of(scene, 256, 512);
    EXPECT_NEAR(means.solved.value, means.traced.value, 0.015 * means.traced.value);
    for (Light& light : scene.lights) light.source = lights::scaled(light.source, Rgb::grey(1e-3));
    EXPECT_NEAR(picture_of_solution(scene, 256, 1).mean_luminance_cd_m2, 1e-3 * means.solved.value,
                0.02e-3 * means.solved.value);
}

/// The areas of fine patches below a box that stands a millimetre above the floor [m2].
struct AreasInGap {
    double at_rim_m2 = 1, in_middle_m2 = 1;  ///< the smallest
};
AreasInGap areas_in_gap(const patches::Patches& patches) {
    AreasInGap areas;
    for (std::uint32_t p = 0; p < patches.count(); ++p) {
        const Vec3 middle = patches.middle(p);
        if (std::abs(middle.z - 0.001) > 1e-6) continue;
        const double to_rim_m = std::min({middle.x - 1, 3 - middle.x, middle.y - 0.5, 2.5 - middle.y});
        double& least_m2 = to_rim_m > 0.6 ? areas.in_middle_m2 : areas.at_rim_m2;
        least_m2 = std::min(least_m2, double{patches.areas_m2[p]});
    }
    return areas;
}

/// Half of the vertices of a furnished room would lie where nobody looks.
TEST(Solve, NarrowGapsAreDividedAtTheirRimsOnly) {
    Scene scene = diffuse_room();
    add_object(scene, Box{{1, 0.5, 0.001}, {3, 2.5, 0.2}}, Diffuse{Rgb::grey(0.6)});
    const AreasInGap areas = areas_in_gap(solve(scene, options_of(16)).solution.patches);
    EXPECT_LT(areas.at_rim_m2, 0.02);
    EXPECT_GT(areas.in_middle_m2, 0.05);
}

/// Walks over patches have no light by mirrors; gathering adds it, one reflection after the other. The bias
/// that a solution states is that of the walks.
TEST(Solve, MirrorsCastLight) {
    Scene scene = diffuse_room();
    add_object(scene, Rectangle{{0.02, 0.2, 0.2}, {0, 2.6, 0}, {0, 0, 2.4}}, Mirror{Rgb::grey(0.9)});
    scene.lights.erase(scene.lights.begin() + 1);  // light of points by mirrors is found by no path
    const Means means = means_of(scene, 320, 1024);
    EXPECT_NEAR(means.solved.value, means.traced.value, 0.03 * means.traced.value);
    const double by_walks = render(scene, camera(), options_of(16)).mean_luminance_cd_m2;
    EXPECT_LT(by_walks, 0.93 * means.traced.value);
    const std::vector<Half> biases = solve(scene, options_of(128)).solution.bias;
    double mean = 0;
    for (const Half bias : biases) mean += double{to_float(bias)} / static_cast<double>(biases.size());
    EXPECT_GT(mean, 0.03);
}

/// Light by mirrors is part of a solution; of points it is found by no ray from a vertex.
TEST(Solve, WarnsOfLightThatMirrorsBringFromPointsOnly) {
    Scene scene = diffuse_room();
    add_object(scene, Rectangle{{0.02, 0.2, 0.2}, {0, 2.6, 0}, {0, 0, 2.4}}, Mirror{Rgb::grey(0.9)});
    const auto warns_of_mirrors = [&] {
        const SolveResult solved = solve(scene, options_of(16));
        const RenderResult picture = render_solution(scene, camera(), solved.solution);
        const auto names_mirrors = [](const std::string& warning) {
            return warning.find("mirror") != warning.npos;
        };
        const bool solution_warns = std::ranges::any_of(texts_of(solved.warnings), names_mirrors);
        EXPECT_EQ(std::ranges::any_of(texts_of(picture.warnings), names_mirrors), solution_warns);
        return solution_warns;
    };
    EXPECT_TRUE(warns_of_mirrors());
    scene.lights.erase(scene.lights.begin() + 1);
    EXPECT_FALSE(warns_of_mirrors());
}

/// Groups are apart: dimmed, the light is that of a scene with dimmed lamps.
TEST(Solve, DimmedLampsAreThoseOfADimmedScene) {
    const Scene scene = room_with_glossy_floor();
    const std::vector<LightFactor> factors{{scene.lights[0].name, Rgb::grey(0.25)},
                                           {scene.lights[1].name, {{2, 0.5, 0.1}}}};
    const LightGroups groups = scene::light_groups(scene);
    const Scene dimmed = scene::relit(scene, groups, scene::factors_of_groups(factors, groups.names));
    constexpr double factor = 2;
    const std::uint64_t steps = std::max(fewer(512, factor), kLeastSteps);
    std::array<std::vector<double>, 2> means;
    for (std::uint64_t seed = 1; seed <= kSolutions; ++seed) {
        means[0].push_back(
            render_solution(scene, camera(), solve(scene, options_of(steps, seed)).solution, factors)
                .mean_luminance_cd_m2);
        means[1].push_back(picture_of_solution(dimmed, steps, seed + 100).mean_luminance_cd_m2);
    }
    expect_equal(statistics::estimate_from_replicates(means[0]),
                 statistics::estimate_from_replicates(means[1]), factor);
    EXPECT_THROW(render_solution(scene, camera(), solve(scene, options_of(16)).solution,
                                 std::vector<LightFactor>{{"sun", Rgb::grey(1)}}),
                 InputError);
}

/// Illuminances of vertices without direct light, with their relative errors; by positions and normals in
/// millimetres, since two solutions may divide a surface in two ways.
struct ReadingAtVertex {
    double lx = 0, relative_error = 0;
};
using ReadingsOfPlaces = std::map<std::array<long, 6>, ReadingAtVertex>;

ReadingsOfPlaces readings_of(const Scene& scene, const estimators::PatchSolution& solution) {
    const estimators::LightVertices vertices(scene, solution.patches, solution.degree, solution.lit_vertices);
    const std::vector<double> found_lx = illuminances_lx(scene, solution);
    const std::vector<float> errors = relative_errors(solution);
    const auto rounded = [](double x) { return std::lround(1000 * x); };
    ReadingsOfPlaces readings;
    for (std::uint32_t i = 0; i < vertices.count(); ++i) {
        const Vec3 place = vertices.position(i), normal = vertices.frame(i).to_world({0, 0, 1});
        readings[{rounded(place.x), rounded(place.y), rounded(place.z), rounded(normal.x), rounded(normal.y),
                  rounded(normal.z)}] = {found_lx[i], errors[i]};
    }
    return readings;
}

/// The share of the places of both whose difference the errors explain.
double share_explained(const ReadingsOfPlaces& one, const ReadingsOfPlaces& other) {
    double explained = 0, all = 0;
    for (const auto& [place, reading] : one) {
        const auto same = other.find(place);
        if (same == other.end()) continue;
        const double error_lx =
            std::hypot(reading.lx * reading.relative_error, same->second.lx * same->second.relative_error);
        explained += std::abs(reading.lx - same->second.lx) <= error_lx;
        ++all;
    }
    return explained / all;
}

/// The stated error of a vertex contains what another, long solution finds there.
TEST(Solve, ErrorsOfVerticesAreHonest) {
    const Scene scene = room_with_glossy_floor();
    const ReadingsOfPlaces expected = readings_of(scene, solve(scene, options_of(1 << 12, 1)).solution);
    double explained = 0;
    for (std::uint64_t seed = 2; seed < 6; ++seed) {
        const estimators::PatchSolution solution = solve(scene, options_of(128, seed)).solution;
        explained += share_explained(readings_of(scene, solution), expected) / 4;
    }
    EXPECT_GT(explained, 0.95);
}

/// Their noise, without the bias of patches, is what independent solutions differ by.
TEST(Solve, NoiseOfVerticesIsStatedExactly) {
    const Scene scene = room_with_glossy_floor();
    double explained = 0;
    constexpr int pairs = 8;
    for (std::uint64_t pair = 0; pair < pairs; ++pair) {
        std::array<ReadingsOfPlaces, 2> readings;
        for (std::uint64_t i = 0; i < 2; ++i) {
            estimators::PatchSolution solution = solve(scene, options_of(256, 1 + 2 * pair + i)).solution;
            std::ranges::fill(solution.bias, Half{});
            readings[i] = readings_of(scene, solution);
        }
        explained += share_explained(readings[0], readings[1]) / pairs;
    }
    EXPECT_GT(explained, 0.94);
    EXPECT_LT(explained, 0.97);
}

/// What is rounded away stays small against the error, and leaves numbers with many zero bits.
TEST(Solve, RoundingIsSmallAgainstTheError) {
    const Scene scene = room_with_glossy_floor();
    estimators::PatchSolution solution = solve(scene, options_of(64)).solution;
    std::ranges::fill(solution.bias, to_half(0.5F));
    const std::vector<float> errors = relative_errors(solution);
    const estimators::PatchSolution rounded = rounded_to_errors(solution, scene);
    const std::vector<double> before = illuminances_lx(scene, solution),
                              after = illuminances_lx(scene, rounded);
    double changed = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_LE(std::abs(after[i] - before[i]), 0.25 * double{errors[i]} * before[i] + 1e-6);
        changed += after[i] != before[i];
    }
    EXPECT_GT(changed, 0.5 * static_cast<double>(before.size()));
}

/// The differences of independent solutions are what their errors say; all pairs of a few.
TEST(Solve, ErrorsOfPixelsAreHonest) {
    const Scene scene = room_with_glossy_floor();
    std::vector<RenderResult> pictures;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) pictures.push_back(picture_of_solution(scene, 96, seed));
    double inside = 0, all = 0;
    for (std::size_t p = 0; p < pictures.size(); ++p) {
        EXPECT_EQ(pictures[p].replicates, 8);
        for (std::size_t q = 0; q < p; ++q) {
            for (std::size_t i = 0; i < pictures[p].depth_m.size(); ++i) {
                const double error = std::hypot(pictures[p].pixels.standard_error_cd_m2[i],
                                                pictures[q].pixels.standard_error_cd_m2[i]);
                const double difference = luminance(pictures[p], i) - luminance(pictures[q], i);
                inside += std::abs(difference) <= statistics::student_t_quantile(0.975, 14) * error;
                ++all;
            }
        }
    }
    EXPECT_GT(inside / all, 0.91);
    EXPECT_LT(inside / all, 0.99);
}

TEST(Solve, DarknessIsSolved) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {2, 2, 2}}, Diffuse{Rgb::grey(0.5)});
    const SolveResult result = solve(scene, options_of(8));
    EXPECT_TRUE(result.solution.lit_vertices.empty());
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
    const Scene scene = room_with_glossy_floor();
    RunOptions options = options_of(128);
    options.threads = 1;
    const SolveResult one = solve(scene, options);
    options.threads = 3;
    const SolveResult three = solve(scene, options);
    EXPECT_EQ(one.solution.terms, three.solution.terms);
    EXPECT_EQ(one.solution.replicates, three.solution.replicates);
    EXPECT_EQ(one.solution.bias, three.solution.bias);
    EXPECT_EQ(one.solution.lit_vertices, three.solution.lit_vertices);
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
    const Scene scene = room_with_glossy_floor();
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
    refused([](estimators::PatchSolution& s) { std::swap(s.lit_vertices[0], s.lit_vertices[1]); });
    refused([](estimators::PatchSolution& s) {
        s.lit_vertices.back() = static_cast<std::uint32_t>(2 * s.patches.vertices.size());
    });
    refused([](estimators::PatchSolution& s) { s.patches.vertices.push_back({}); });
    refused([](estimators::PatchSolution& s) { s.groups[0] = "sun"; });
    refused([](estimators::PatchSolution& s) { s.terms.pop_back(); });
    refused([](estimators::PatchSolution& s) { s.terms[1].pop_back(); });
    refused([](estimators::PatchSolution& s) { s.terms[1][0][2] = to_half(NAN); });
    refused([](estimators::PatchSolution& s) { s.replicates[1].pop_back(); });
    refused([](estimators::PatchSolution& s) { s.replicates[1][0] = to_half(-1); });
    refused([](estimators::PatchSolution& s) { s.replicates.resize(1); });
    refused([](estimators::PatchSolution& s) { s.bias.pop_back(); });
    EXPECT_NO_THROW(render_solution(scene, camera(), good));
}

}  // namespace
}  // namespace stilb::run
