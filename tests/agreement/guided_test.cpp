// Local estimation by a guess of the light against local estimation without one, in all scenes of the
// agreement suite: also where method auto would leave the guess out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "agreement/scenes.h"
#include "base/parallel.h"
#include "estimators/estimator_list.h"
#include "statistics/hypothesis.h"
#include "support/coarser.h"
#include "support/scene_builder.h"
#include "transport/receiver.h"

namespace stilb {
namespace {

constexpr std::size_t kReplicates = 32;
/// Relative standard error that is aimed at.
constexpr double kTargetError = 0.003;
/// Chance that the whole file fails without a defect, when its seeds are first used.
constexpr double kFamilyError = 0.01;

std::vector<Measurand> measurands_of(const AgreementScene& scene) {
    std::vector<Measurand> all;
    for (const Sensor& sensor : scene.sensors())
        std::ranges::copy(sensor.measurands(), std::back_inserter(all));
    return all;
}

/// By readings, then by replicates.
std::vector<std::vector<double>> replicates_of(const estimators::Estimator& method, std::size_t readings,
                                               math::RandomKey key, std::uint64_t samples) {
    std::vector<std::vector<double>> means(readings, std::vector<double>(kReplicates));
    parallel_for(kReplicates, [&](std::size_t r) {
        estimators::Tally sums(readings);
        method.run_batch({key.derived(r), 0, samples}, sums);
        for (std::size_t j = 0; j < readings; ++j) {
            const Rgb mean = sums.sum[j] * (1 / static_cast<double>(samples));
            means[j][r] = (method.known_part()[j] + mean).luminance();
        }
    });
    return means;
}

std::vector<statistics::Estimate> measure(const estimators::Estimator& method, std::size_t readings,
                                          math::RandomKey key, std::uint64_t samples) {
    std::vector<statistics::Estimate> estimates;
    for (const auto& of_reading : replicates_of(method, readings, key, samples))
        estimates.push_back(statistics::estimate_from_replicates(of_reading));
    return estimates;
}

statistics::Estimate mean_of_readings(const estimators::Estimator& method, std::size_t readings,
                                      math::RandomKey key, std::uint64_t samples) {
    std::vector<double> means(kReplicates);
    for (const auto& of_reading : replicates_of(method, readings, key, samples)) {
        for (std::size_t r = 0; r < kReplicates; ++r)
            means[r] += of_reading[r] / static_cast<double>(readings);
    }
    return statistics::estimate_from_replicates(means);
}

/// So many samples that most readings reach the error that is aimed at, by a pilot with a key of its own.
std::vector<statistics::Estimate> measure_exactly(const estimators::Estimator& method, std::size_t readings,
                                                  math::RandomKey key, double target_error) {
    const std::uint64_t granularity = method.batch_granularity();
    const std::uint64_t pilot = std::max<std::uint64_t>(granularity, 64 / granularity * granularity);
    double squared = 0;
    for (const statistics::Estimate& e : measure(method, readings, key.derived(0), pilot)) {
        const double error = e.value > 0 ? e.standard_error / e.value : 0;
        squared += error * error / static_cast<double>(readings);
    }
    const double granules =
        squared / (target_error * target_error) * static_cast<double>(pilot / granularity);
    const auto most = static_cast<double>((1u << 13) / granularity);
    return measure(
        method, readings, key.derived(1),
        granularity * static_cast<std::uint64_t>(std::clamp(std::ceil(granules), 4., std::max(4., most))));
}

std::vector<std::size_t> scenes_without_limit() {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < agreement_scenes().size(); ++i) {
        if (!agreement_scenes()[i].bounces) numbers.push_back(i);
    }
    return numbers;
}

std::size_t comparisons() {
    std::size_t sum = 0;
    for (const std::size_t i : scenes_without_limit()) sum += measurands_of(agreement_scenes()[i]).size();
    return sum;
}

class Guided : public testing::TestWithParam<std::size_t> {};

TEST_P(Guided, IsLocalEstimation) {
    const AgreementScene& of = agreement_scenes()[GetParam()];
    const Scene scene = of.make();
    const rays::RayCaster caster(scene);
    const std::vector<Measurand> measurands = measurands_of(of);
    const math::RandomKey key = math::RandomKey{20}.derived(GetParam());
    const estimators::Problem problem{.scene = scene,
                                      .caster = caster,
                                      .max_reflections = transport::kUnlimited,
                                      .preparation_key = {key.derived(2)},
                                      .measurands = measurands};
    const auto guided = measure_exactly(*estimators::make_guided(problem), measurands.size(), key.derived(0),
                                        coarser(of.coarser) * kTargetError);
    const auto balanced = measure_exactly(*estimators::make_balanced(problem), measurands.size(),
                                          key.derived(1), coarser(of.coarser) * kTargetError);
    const double threshold = statistics::sidak_threshold_z(kFamilyError, comparisons());
    for (std::size_t j = 0; j < measurands.size(); ++j) {
        const double t = statistics::z_score(guided[j], balanced[j]);
        EXPECT_LT(std::abs(statistics::equivalent_z(t, kReplicates - 1)), threshold)
            << "reading " << j << ": " << guided[j].value << " +- " << guided[j].standard_error << ", "
            << balanced[j].value << " +- " << balanced[j].standard_error;
    }
}

/// A pale ball hangs close to the lamp, and hides part of it from the points.
class PaleBall : public testing::Test {
  protected:
    static Scene room() {
        Scene scene;
        add_object(scene, Box{{0, 0, 0}, {4.2, 3.1, 2.6}}, diffuse(0.75));
        add_object(scene, Sphere{{2.1, 1.5, 2.2}, 0.15}, diffuse(0.75));
        add_area_light(scene, Rectangle{{1.8, 1.2, 2.5}, {0, 0.6, 0}, {0.6, 0, 0}}, Rgb::grey(2000),
                       diffuse(0.75));
        return scene;
    }
    static std::vector<Measurand> many_points() {
        std::vector<Measurand> points;
        for (int i = 0; i < 40; ++i)
            points.push_back(MeasuringPoint{{0.3 + 0.09 * i, 0.3 + 0.25 * (i % 10), 0.91}, {0, 0, 1}});
        return points;
    }

    static constexpr double kFactor = 1.6;  ///< of coarser()
    const std::uint64_t samples_ = fewer(512, kFactor);
    const Scene scene_ = room();
    const rays::RayCaster caster_{scene_};
    const std::vector<Measurand> points_ = many_points();
    const math::RandomKey key_{21};
    const estimators::Problem problem_{.scene = scene_,
                                       .caster = caster_,
                                       .max_reflections = transport::kUnlimited,
                                       .preparation_key = {key_.derived(2)},
                                       .measurands = points_};
};

/// Where the numbers of paths by the ball were used again, the mean was 0.55 % dark.
TEST_F(PaleBall, TheMeanIsThatOfLocalEstimation) {
    const auto guided =
        mean_of_readings(*estimators::make_guided(problem_), points_.size(), key_.derived(0), samples_);
    const auto balanced = mean_of_readings(*estimators::make_balanced(problem_), points_.size(),
                                           key_.derived(1), 16 * samples_);
    EXPECT_LT(guided.standard_error, 0.001 * coarser(kFactor) * guided.value);
    EXPECT_LT(balanced.standard_error, 0.001 * coarser(kFactor) * balanced.value);
    EXPECT_LT(std::abs(statistics::z_score(guided, balanced)), 3.5)
        << guided.value << " +- " << guided.standard_error << ", " << balanced.value << " +- "
        << balanced.standard_error;
}

TEST_F(PaleBall, PacesKeepTheExpectation) {
    const auto method = estimators::make_guided(problem_);
    const std::vector<std::uint32_t> packets = method->packets();
    ASSERT_EQ(packets.size(), points_.size());
    const std::array<estimators::Pace, 3> paces{{{4, 1}, {4, 4}, {4, 16}}};
    std::vector<std::vector<double>> means(points_.size(), std::vector<double>(kReplicates));
    parallel_for(kReplicates, [&](std::size_t r) {
        estimators::Tally sums(points_.size());
        constexpr std::uint64_t at_once = 8;
        for (std::uint64_t first = 0; first < samples_; first += at_once)
            method->run_batch({key_.derived(3).derived(r), first, std::min(at_once, samples_ - first), paces},
                              sums);
        for (std::size_t j = 0; j < points_.size(); ++j) {
            const auto taken = static_cast<double>(paces[packets[j]].taken(samples_));
            means[j][r] = (method->known_part()[j] + sums.sum[j] * (1 / taken)).luminance();
        }
    });
    const auto all = measure(*method, points_.size(), key_.derived(4), samples_);
    const double threshold = statistics::sidak_threshold_z(kFamilyError, points_.size());
    for (std::size_t j = 0; j < points_.size(); ++j) {
        const auto paced = statistics::estimate_from_replicates(means[j]);
        const double t = statistics::z_score(paced, all[j]);
        EXPECT_LT(std::abs(statistics::equivalent_z(t, kReplicates - 1)), threshold)
            << "reading " << j << ": " << paced.value << " +- " << paced.standard_error << ", "
            << all[j].value << " +- " << all[j].standard_error;
    }
}

/// An eye that looks along a desk is no receiver like the points of the desk beside it. Where points of light
/// were chosen for four receivers of its packet, the light that is near to the eye alone was rare.
TEST(GuidedReadings, AnEyeAmongPointsOfADeskIsAsExactAsAlone) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {3, 3, 3}}, diffuse(0.5));
    add_area_light(scene, Rectangle{{1.1, 1.1, 2.99}, {0, 0.8, 0}, {0.8, 0, 0}}, Rgb::grey(2500));
    const rays::RayCaster caster(scene);
    std::vector<Measurand> measurands{MeasuringPoint{{1.2, 2.2, 0.8}, {0, -1, 0}}};
    for (int i = 0; i < 144; ++i) {
        const Vec3 point{0.3 + 0.2 * (i % 12), 0.3 + 0.2 * (i / 12), 0.8};
        measurands.push_back(MeasuringPoint{point, {0, 0, 1}});
    }
    const auto eye = [&](std::span<const Measurand> all, const math::RandomKey& key) {
        const estimators::Problem problem{.scene = scene,
                                          .caster = caster,
                                          .max_reflections = transport::kUnlimited,
                                          .preparation_key = {key.derived(2)},
                                          .measurands = all};
        return measure(*estimators::make_guided(problem), all.size(), key.derived(all.size()),
                       fewer(256, 2))[0];
    };
    // The error of one run is itself known to a fifth only.
    double alone_squares = 0, among_squares = 0;
    for (std::uint64_t seed = 22; seed < 28; ++seed) {
        const math::RandomKey key{seed};
        const auto alone = eye(std::span(measurands).first(1), key), among_points = eye(measurands, key);
        alone_squares += alone.standard_error * alone.standard_error;
        among_squares += among_points.standard_error * among_points.standard_error;
        EXPECT_LT(std::abs(statistics::z_score(among_points, alone)), 3.5);
    }
    EXPECT_LT(std::sqrt(among_squares), 1.8 * std::sqrt(alone_squares));
}

std::string name_of(const testing::TestParamInfo<std::size_t>& place) {
    return std::string(agreement_scenes()[place.param].name);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Guided, testing::ValuesIn(scenes_without_limit()), name_of);

}  // namespace
}  // namespace stilb
