// Boxes through which particles of the sky come in: where they lie, and the flux of the particles.
#include "transport/entries.h"

#include <gtest/gtest.h>

#include <cmath>

#include "materials/black.h"
#include "statistics/hypothesis.h"
#include "statistics/interval.h"
#include "support/scene_builder.h"
#include "transport/light_sampler.h"

namespace stilb::transport {
namespace {

/// White, so that every walk within it has all of its places.
void add_room(Scene& scene, const Vec3& low) { add_object(scene, Box{low, low + Vec3{4, 4, 4}}, diffuse(1)); }
Vec3 middle_of_room(const Vec3& low) { return low + Vec3{2, 2, 2}; }

void add_speck(Scene& scene, const Vec3& at) { add_object(scene, Sphere{at, 0.01}, Black{}); }

std::vector<lights::Entry> entries_of(const Scene& scene, const std::vector<Vec3>& measured) {
    return entries_to(rays::RayCaster(scene, Monitor::none(), measured));
}

double surface_m2(const Bounds& box) {
    const Vec3 e = box.max - box.min;
    return 2 * (e.x * e.y + e.y * e.z + e.z * e.x);
}

bool holds(const Bounds& box, const Vec3& at) {
    return at.x >= box.min.x && at.y >= box.min.y && at.z >= box.min.z && at.x <= box.max.x &&
           at.y <= box.max.y && at.z <= box.max.z;
}

TEST(Entries, AreNoneWhereTheSceneIsWhatIsMeasured) {
    Scene scene;
    add_room(scene, {});
    EXPECT_TRUE(entries_of(scene, {middle_of_room({})}).empty());
    add_speck(scene, {3000, 3000, 3000});
    EXPECT_TRUE(entries_of(scene, {}).empty()) << "nothing is measured";
}

TEST(Entries, AreWholeRoomsHoweverFarThingsAre) {
    for (const double far_m : {30.0, 1e3, 1e5, 1e7}) {
        Scene scene;
        add_room(scene, {});
        add_speck(scene, {far_m, far_m, far_m});
        const auto entries = entries_of(scene, {{1, 1, 1}});
        ASSERT_EQ(entries.size(), 1) << far_m;
        EXPECT_TRUE(holds(entries[0].box, {0, 0, 0}) && holds(entries[0].box, {4, 4, 4})) << far_m;
        EXPECT_GT(entries[0].share, 0.7) << far_m;
        EXPECT_LT(surface_m2(entries[0].box), 8 * 6 * 16 + 1e-12 * far_m * far_m) << far_m;
    }
}

/// Each room gets its third of the particles, but for those of the boxes around it.
TEST(Entries, AreTheRoomsOfAllReadings) {
    Scene scene;
    const std::vector<Vec3> rooms{{0, 0, 0}, {300, 20, 0}, {-100, 5e4, 0}};
    std::vector<Vec3> measured;
    for (const Vec3& room : rooms) {
        add_room(scene, room);
        measured.push_back(middle_of_room(room));
    }
    const auto entries = entries_of(scene, measured);
    double shares = 0;
    for (const lights::Entry& entry : entries) shares += entry.share;
    EXPECT_LT(shares, 0.76);
    for (const Vec3& room : rooms) {
        double smallest_m2 = 1e12, share = 0;
        for (const lights::Entry& entry : entries) {
            if (!holds(entry.box, middle_of_room(room)) || surface_m2(entry.box) > smallest_m2) continue;
            smallest_m2 = surface_m2(entry.box), share = entry.share;
        }
        EXPECT_LT(smallest_m2, 4 * 6 * 16);
        EXPECT_GT(share, 0.75 * 0.75 / 3 - 0.01);
    }
}

// Thresholds: below, at and above.

/// The scene's box, as a speck moves away, has as much surface as the room's box times 8.
TEST(Entries, HaveAnEighthOfTheSurface) {
    const auto of_speck_at = [](double x) {
        Scene scene;
        add_room(scene, {});
        add_speck(scene, {x, 2, 2});
        return std::pair{entries_of(scene, {{2, 2, 2}}), bounds_of(scene)};
    };
    double without_m = 5, with_m = 500;
    while (with_m - without_m > 1e-6) {
        const double middle_m = (without_m + with_m) / 2;
        (of_speck_at(middle_m).first.empty() ? without_m : with_m) = middle_m;
    }
    const auto [entries, scene] = of_speck_at(with_m);
    ASSERT_EQ(entries.size(), 1);
    EXPECT_NEAR(surface_m2(scene) / surface_m2(entries[0].box), 8, 1e-5);
    EXPECT_TRUE(of_speck_at(without_m).first.empty());
}

/// Two rooms are two groups where an eighth of their extent is between them, parts of their own where they
/// have much less surface than both together.
TEST(Entries, AreApartByAnEighthOfTheExtent) {
    const auto count = [](double gap_m) {
        Scene scene;
        add_room(scene, {});
        add_room(scene, {4 + gap_m, 0, 0});
        add_speck(scene, {0, 0, 1600});
        return entries_of(scene, {middle_of_room({}), middle_of_room({4 + gap_m, 0, 0})}).size();
    };
    for (const double gap_m : {1.1, 8.0 / 7, 1.2}) EXPECT_EQ(count(gap_m), 1) << "both together";
    EXPECT_EQ(count(200), 3) << "both, and each of them";
    // Their places are a group although the extent of all, with a third room, is 25 times as large.
    Scene scene;
    std::vector<Vec3> measured;
    for (const double x : {0.0, 12.0, 400.0}) {
        add_room(scene, {x, 0, 0});
        measured.push_back(middle_of_room({x, 0, 0}));
    }
    add_speck(scene, {0, 0, 1e5});
    EXPECT_EQ(entries_of(scene, measured).size(), 3) << "all, the first two, the third";
}

/// A walk has three places within a white room, and none outside. Where one of 1024, 1365 or 2048 readings is
/// inside, four, three or two of the 4096 walks begin there.
TEST(Entries, HaveEightPlaces) {
    const auto are_found = [](std::size_t readings) {
        Scene scene;
        add_room(scene, {});
        add_speck(scene, {1000, 1000, 1000});
        std::vector<Vec3> measured(readings, {-500, -500, -500});
        measured[20] = middle_of_room({});
        return !entries_of(scene, measured).empty();
    };
    EXPECT_TRUE(are_found(1024));
    EXPECT_TRUE(are_found(1365));
    EXPECT_FALSE(are_found(2048));
}

// Particles.

constexpr int kEntryReplicates = 32;

/// Balls that measured points see from all sides, in all sizes of scenes: they receive from each direction
/// over their cross-sections.
TEST(Entries, BringBallsTheirFlux) {
    const std::vector<Sphere> balls{{{0, 0, 0}, 8}, {{1500, 40, 10}, 20}, {{-3000, 100, 0}, 5}};
    for (const bool is_panorama : {false, true}) {
        for (const double far_m : {0.0, 1e4, 1e6}) {
            Scene scene;
            std::vector<Vec3> measured;
            for (const Sphere& ball : balls) {
                add_object(scene, ball, diffuse(0.9));
                for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
                    measured.push_back(ball.center + 2 * ball.radius * axis);
                    measured.push_back(ball.center - 2 * ball.radius * axis);
                }
            }
            if (far_m > 0) add_speck(scene, {far_m, 0.7 * far_m, 0.4 * far_m});
            is_panorama ? add_sky(scene, {0.4, 0.2, 0.7}, 50) : add_environment(scene, Rgb::grey(30));
            const rays::RayCaster caster(scene, Monitor::none(), measured);
            const LightSampler lights(scene, caster);
            const auto& light = std::get<EnvironmentLight>(scene.lights[0].source);
            const double total_lx = is_panorama ? light.panorama->total_lx().luminance() : 4 * kPi * 30;
            std::vector<std::vector<double>> means(balls.size());
            for (std::uint64_t replicate = 0; replicate < kEntryReplicates; ++replicate) {
                constexpr std::uint64_t particles = 1 << 12;
                std::vector<double> sums(balls.size() + 1);
                for (std::uint64_t i = 0; i < particles; ++i) {
                    math::SampleStream stream(math::RandomKey{replicate}, i);
                    const EmittedParticle particle = lights.sample_emission(stream);
                    const auto hit = caster.closest(particle.origin, particle.direction);
                    if (hit) sums[index_of(hit->object)] += particle.flux_lm.luminance();
                }
                for (std::size_t ball = 0; ball < balls.size(); ++ball)
                    means[ball].push_back(sums[ball] / particles);
            }
            for (std::size_t ball = 0; ball < balls.size(); ++ball) {
                const auto found = statistics::estimate_from_replicates(means[ball]);
                // They shade each other by some hundred thousandths.
                const double exact_lm = kPi * balls[ball].radius * balls[ball].radius * total_lx;
                const double z = z_score(found, exact_lm);
                EXPECT_LT(std::abs(statistics::equivalent_z(z, kEntryReplicates - 1)), 4)
                    << ball << ' ' << far_m << ": " << found.value << ' ' << exact_lm;
                EXPECT_LT(found.standard_error, 0.04 * exact_lm) << ball << ' ' << far_m;
            }
        }
    }
}

}  // namespace
}  // namespace stilb::transport
