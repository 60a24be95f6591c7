#include "estimators/local/gather.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimators/receivers.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "support/scene_builder.h"

namespace stilb::estimators {
namespace {

constexpr int kGatherReplicates = 32;
constexpr std::uint64_t kRounds = 512;
constexpr double kLargestZOfMany = 4.5;  // some 64 comparisons: by chance once in 2000 times

/// A room with a box whose side stands close to the points, one face of it a glossy one, and a mirror.
Scene furnished_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, diffuse(0.6));
    add_object(scene, Box{{2, 1, 0}, {2.6, 1.6, 1.2}}, Phong{Rgb::grey(0.3), Rgb::grey(0.3), 20});
    add_object(scene, Rectangle{{0.5, 2.5, 0.5}, {1, 0, 0}, {0, 0, 1}}, Mirror{Rgb::grey(0.9)});
    add_point_light(scene, {1, 1, 2.2}, Rgb::grey(100));
    add_point_light(scene, {3, 2, 2.2}, Rgb::grey(50));
    return scene;
}

/// `count` points within a hand's breadth, some of them tilted, the nearest 2 cm from the box.
std::vector<MeasuringPoint> points_beside_the_box(int count) {
    std::vector<MeasuringPoint> points;
    for (int i = 0; i < count; ++i) {
        const Vec3 position{1.98 - 0.03 * (i % 4), 1.2 + 0.03 * (i / 4), 0.8};
        points.push_back({position, i % 5 == 0 ? normalized(Vec3{0.5, 0.2, 1}) : Vec3{0, 0, 1}});
    }
    return points;
}

struct MeanAndError {
    double mean = 0, standard_error = 0;
};

/// What Gather adds to each reading in a round, from kGatherReplicates independent runs.
class Rounds {
  public:
    explicit Rounds(const Scene& scene)
        : scene_(scene), caster_(scene), lights_(scene, caster_), tracer_(scene, caster_, lights_) {}

    std::vector<MeanAndError> gather(const std::vector<MeasuringPoint>& points, double k_per_m2,
                                     math::RandomKey key) const {
        const std::vector<transport::Receiver> receivers = receivers_of(points, caster_);
        const std::vector<double> k(points.size(), k_per_m2);
        const std::vector<PointTile> tiles = tiles_of(receivers, k, caster_, transport::kUnlimited);
        const std::vector<SplitPlan> plans(points.size(), SplitPlan{k_per_m2, 1});
        const Gather gather(caster_, tracer_, tiles, plans);
        std::vector<double> sum(points.size()), squares(points.size());
        for (std::uint64_t r = 0; r < kGatherReplicates; ++r) {
            Tally sums(points.size());
            gather.collect({key.derived(r), 0, kRounds}, sums);
            EXPECT_EQ(sums.invalid, 0u);
            for (std::size_t j = 0; j < points.size(); ++j) {
                const double value = sums.sum[j].luminance() / kRounds;
                sum[j] += value;
                squares[j] += value * value;
            }
        }
        std::vector<MeanAndError> result;
        for (std::size_t j = 0; j < points.size(); ++j) {
            const double mean = sum[j] / kGatherReplicates;
            const double variance = (squares[j] / kGatherReplicates - mean * mean) / (kGatherReplicates - 1);
            result.push_back({mean, std::sqrt(std::max(variance, 0.0))});
        }
        return result;
    }

  private:
    const Scene& scene_;
    rays::RayCaster caster_;
    transport::LightSampler lights_;
    transport::PathTracer tracer_;
};

double z(const MeanAndError& a, const MeanAndError& b) {
    return std::abs(a.mean - b.mean) / std::hypot(a.standard_error, b.standard_error);
}

TEST(Gather, PacketsOfAnySizeGiveWhatEachPointGathersAlone) {
    const Scene scene = furnished_room();
    const Rounds rounds(scene);
    const std::vector<MeasuringPoint> points = points_beside_the_box(17);
    for (const double k : {1e-3, 2.0}) {
        std::vector<MeanAndError> alone;
        for (std::size_t j = 0; j < points.size(); ++j) {
            alone.push_back(rounds.gather({points[j]}, k, math::RandomKey{j}).front());
            EXPECT_GT(alone.back().mean, 1);
            EXPECT_LT(alone.back().standard_error, 0.02 * alone.back().mean);
        }
        for (const std::ptrdiff_t count : {2, 3, 8, 16, 17}) {
            const std::vector<MeasuringPoint> some(points.begin(), points.begin() + count);
            const std::vector<MeanAndError> together = rounds.gather(some, k, math::RandomKey{1000});
            for (std::size_t j = 0; j < some.size(); ++j) {
                EXPECT_LT(z(together[j], alone[j]), kLargestZOfMany)
                    << "k " << k << ", point " << j << " of " << count << ": " << together[j].mean << " and "
                    << alone[j].mean;
            }
        }
    }
}

TEST(Gather, SharingPaysForNeighbours) {
    const Scene scene = furnished_room();
    const Rounds rounds(scene);
    const std::vector<MeasuringPoint> points = points_beside_the_box(16);
    const std::vector<MeanAndError> together = rounds.gather(points, 1e-3, math::RandomKey{1});
    double variance = 0, variance_alone = 0;
    for (std::size_t j = 0; j < points.size(); ++j) {
        variance += std::pow(together[j].standard_error, 2);
        variance_alone += std::pow(rounds.gather({points[j]}, 1e-3, math::RandomKey{j})[0].standard_error, 2);
    }
    EXPECT_LT(variance, variance_alone / 3);
}

TEST(Gather, WithoutReflectionsThereIsNothing) {
    const Scene scene = furnished_room();
    const rays::RayCaster caster(scene);
    const transport::LightSampler lights(scene, caster);
    const transport::PathTracer tracer(scene, caster, lights);
    const std::vector<transport::Receiver> receivers = receivers_of(points_beside_the_box(4), caster);
    const std::vector<PointTile> tiles = tiles_of(receivers, std::vector<double>(4, 1.0), caster, 0);
    const std::vector<SplitPlan> plans(4, SplitPlan{1, 1});
    Tally sums(4);
    Gather(caster, tracer, tiles, plans).collect({math::RandomKey{1}, 0, 64}, sums);
    for (const Rgb& sum : sums.sum) EXPECT_EQ(sum, Rgb{});
}

}  // namespace
}  // namespace stilb::estimators
