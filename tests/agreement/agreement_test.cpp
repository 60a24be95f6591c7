// Every method against every other, and against itself with another seed, wherever both can make all light.
//
// Numbers of paths come from pilot runs with seeds of their own, so that a run's length does not depend on
// its own error. Every reading, and the mean of all of a scene's readings, which averages errors, is
// compared.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "agreement/scenes.h"
#include "estimators/estimator_list.h"
#include "run/run.h"
#include "statistics/hypothesis.h"
#include "support/coarser.h"
#include "support/scene_builder.h"

namespace stilb {
namespace {

constexpr int kReplicates = 32;
/// Relative standard error of a method's readings that is aimed at, by the pilot run, and that is required.
constexpr double kTargetError = 0.0016;
constexpr double kLargestError = 0.003;
/// A method that is wrong by this share does not pass.
constexpr double kNoticed = 0.01;
/// Chance that the whole file fails without a defect, when its seeds are first used.
constexpr double kFamilyError = 0.01;

bool can_measure(const estimators::EstimatorEntry& method, Demand demand) {
    if (demand == Demand::finite_variance) return !method.has_heavy_tails;
    if (demand == Demand::light_from_mirrors) return method.name != "path";
    return true;
}

std::vector<std::string> methods_for(const AgreementScene& scene) {
    std::vector<std::string> methods;
    // At points double-local is local.
    const std::string_view left_out = scene.sights.empty() ? "double-local" : "local";
    for (const estimators::EstimatorEntry& method : estimators::unbiased_estimators()) {
        if (method.name != left_out && can_measure(method, scene.demand)) methods.emplace_back(method.name);
    }
    return methods;
}

/// Of all methods in a scene: each pair, and each against itself, in every reading and for the means.
std::size_t comparisons_in(const AgreementScene& scene) {
    const std::size_t methods = methods_for(scene).size();
    const std::vector<Sensor> sensors = scene.sensors();
    std::size_t compared = sensors.size();  // their means
    for (const Sensor& sensor : sensors) compared += sensor.size();
    return methods * (methods + 1) / 2 * compared;
}

double threshold_z() {
    std::size_t comparisons = 0;
    for (const AgreementScene& scene : agreement_scenes()) comparisons += comparisons_in(scene);
    return statistics::sidak_threshold_z(kFamilyError, comparisons);
}

/// A scene's readings and their mean.
struct Measured {
    std::string what;
    std::vector<statistics::Estimate> estimates;
};

double largest_relative_error(std::span<const statistics::Estimate> estimates) {
    double largest = 0;
    for (const statistics::Estimate& e : estimates) {
        if (e.value > 0) largest = std::max(largest, e.standard_error / e.value);
    }
    return largest;
}

Measured measure(const Scene& scene, const AgreementScene& of, const std::string& method, std::uint64_t seed,
                 std::uint64_t paths) {
    RunOptions options;
    options.method = method;
    options.seed = seed;
    options.paths = paths;
    options.bounces = of.bounces;
    options.replicates = kReplicates;
    const RunResult result = run::measure(scene, of.sensors(), options);
    Measured measured{method + " with seed " + std::to_string(seed), {}};
    for (const SensorResult& sensor : result.sensors) {
        for (const Reading& reading : sensor.readings) measured.estimates.push_back(reading.estimate);
        measured.estimates.push_back(sensor.summary.mean);
    }
    return measured;
}

std::uint64_t paths_needed(const Scene& scene, const AgreementScene& of, const std::string& method,
                           std::uint64_t seed) {
    constexpr std::uint64_t pilot = kReplicates * 1024, least = kReplicates * 512, most = kReplicates << 16;
    const Measured measured = measure(scene, of, method, seed, pilot);
    const double ratio = largest_relative_error(measured.estimates) / (coarser(of.coarser) * kTargetError);
    return static_cast<std::uint64_t>(std::clamp<double>(ratio * ratio * pilot, least, most));
}

/// A method's readings: two independent runs, and both together.
struct TwoRuns {
    Measured first, second, both;
};

TwoRuns measure_twice(const Scene& scene, const AgreementScene& of, const std::string& method,
                      std::uint64_t seed) {
    const std::uint64_t paths = of.path_factor * paths_needed(scene, of, method, seed) / 2;
    TwoRuns runs{measure(scene, of, method, seed + 1, paths),
                 measure(scene, of, method, seed + 2, paths),
                 {method, {}}};
    for (std::size_t i = 0; i < runs.first.estimates.size(); ++i) {
        const statistics::Estimate &a = runs.first.estimates[i], &b = runs.second.estimates[i];
        runs.both.estimates.push_back(
            {(a.value + b.value) / 2, std::hypot(a.standard_error, b.standard_error) / 2, 0, 0});
    }
    return runs;
}

/// Every method with seeds of its own.
std::vector<TwoRuns> measure_all(const Scene& scene, const AgreementScene& of, std::uint64_t seed) {
    std::vector<TwoRuns> all;
    for (const std::string& method : methods_for(of)) {
        all.push_back(measure_twice(scene, of, method, seed += 10));
    }
    return all;
}

/// Student's t of a difference, with the degrees of freedom of [Welch 1947], as a normal deviate.
double apart_z(const statistics::Estimate& a, const statistics::Estimate& b) {
    const double va = a.standard_error * a.standard_error, vb = b.standard_error * b.standard_error;
    const double freedom = (kReplicates - 1) * (va + vb) * (va + vb) / (va * va + vb * vb);
    // Without any error the two are either equal, up to the rounding of their sums, or infinitely far apart,
    // whatever the degrees of freedom.
    if (std::abs(a.value - b.value) <= 1e-12 * std::abs(a.value)) return 0;
    return statistics::equivalent_z(z_score(a, b), va + vb > 0 ? static_cast<int>(freedom) : 1);
}

/// The largest |z| over all readings.
double worst_z(const Measured& a, const Measured& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.estimates.size(); ++i) {
        worst = std::max(worst, std::abs(apart_z(a.estimates[i], b.estimates[i])));
    }
    return worst;
}

/// As if the method's readings were all too high by the same share.
Measured biased(Measured measured, double share) {
    for (statistics::Estimate& e : measured.estimates) e.value *= 1 + share;
    return measured;
}

/// No share of nothing is wrong.
bool is_dark(const Measured& measured) {
    return std::ranges::all_of(measured.estimates, [](const auto& e) { return e.value == 0; });
}

/// Whether the suite fails where one of the methods is wrong by that much: by a comparison with some other.
bool notices_error_of(std::size_t wrong, const std::vector<TwoRuns>& all, double noticed_share) {
    for (const double share : {-noticed_share, noticed_share}) {
        const Measured planted = biased(all[wrong].both, share);
        const bool noticed = std::ranges::any_of(all, [&](const TwoRuns& other) {
            if (&other == &all[wrong]) return false;
            return worst_z(planted, other.both) > threshold_z();
        });
        if (!noticed) return false;
    }
    return true;
}

/// The parameter is a scene's place in the table.
class Agreement : public testing::TestWithParam<std::size_t> {};

TEST_P(Agreement, OfAllMethods) {
    const AgreementScene& of = agreement_scenes()[GetParam()];
    const std::vector<TwoRuns> all = measure_all(of.make(), of, 1000 * (GetParam() + 1));
    double worst = 0;
    const auto compare = [&](const Measured& a, const Measured& b) {
        const double z = worst_z(a, b);
        EXPECT_LT(z, threshold_z()) << a.what << " and " << b.what;
        worst = std::max(worst, z);
    };
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_LT(largest_relative_error(all[i].both.estimates), coarser(of.coarser) * kLargestError)
            << all[i].both.what;
        compare(all[i].first, all[i].second);
        for (std::size_t j = 0; j < i; ++j) compare(all[i].both, all[j].both);
    }
    // The comparison itself: a wrong method does not pass.
    for (std::size_t i = 0; i < all.size() && all.size() > 1; ++i) {
        if (is_dark(all[i].both)) continue;
        EXPECT_TRUE(notices_error_of(i, all, coarser(of.coarser) * kNoticed)) << all[i].both.what;
    }
    RecordProperty("worst_z", std::to_string(worst));
}

std::string name_of(const testing::TestParamInfo<std::size_t>& place) {
    return std::string(agreement_scenes()[place.param].name);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement, testing::Range<std::size_t>(0, agreement_scenes().size()),
                         name_of);

/// By path tracing: the surface is the question, not the method. Where a mesh is looked at, facets show, each
/// in one luminance: means over many sights are compared, of meshes so fine that this averages out.
TEST(HarmonicBodies, AreAsFineMeshes) {
    for (const MeshTwin& twin : mesh_twins()) {
        AgreementScene points = *std::ranges::find(agreement_scenes(), twin.of, &AgreementScene::name);
        points.sights.clear();
        AgreementScene sights = points;
        sights.points.clear();
        sights.sights = twin.many_sights;
        constexpr double factor = 3;
        const auto measure_means = [&](const Scene& scene, std::uint64_t seed) {
            Measured measured = measure(scene, points, "path", seed, fewer(kReplicates << 11, factor));
            measured.estimates.push_back(
                measure(scene, sights, "path", seed + 1, fewer(kReplicates << 7, factor)).estimates.back());
            EXPECT_LT(largest_relative_error(measured.estimates), 2 * coarser(factor) * kLargestError)
                << twin.of;
            return measured;
        };
        const double z = worst_z(measure_means(points.make(), 7000), measure_means(twin.make(), 7100));
        EXPECT_LT(z, threshold_z()) << twin.of;
        RecordProperty(std::string(twin.of), std::to_string(z));
    }
}

TEST(AgreementItself, NoticesABrighterLamp) {
    // The same comparison, of a room with the same room so much brighter as has to be noticed.
    const AgreementScene& of = agreement_scenes()[0];
    Scene brighter = of.make();
    std::get<PointLight>(brighter.lights[0].source).intensity_cd *= 1 + coarser(of.coarser) * kNoticed;
    const std::vector<TwoRuns> right = measure_all(of.make(), of, 5);
    const std::vector<TwoRuns> wrong = measure_all(brighter, of, 500);
    for (const TwoRuns& a : right) {
        for (const TwoRuns& b : wrong) {
            EXPECT_GT(worst_z(a.both, b.both), threshold_z()) << a.both.what << " and " << b.both.what;
        }
    }
}

}  // namespace
}  // namespace stilb
