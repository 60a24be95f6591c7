// Paths side by side against single paths, and the lights of packets against those of single points.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "materials/thin_dielectric.h"
#include "statistics/hypothesis.h"
#include "support/moments.h"
#include "support/scene_builder.h"
#include "transport/path_tracer.h"

namespace stilb::transport {
namespace {

constexpr Rgb kWhite = Rgb::grey(1);
constexpr int kReflections = 100;

Rectangle panel(const Vec3& corner, double width, double depth) {
    return {corner, {0, depth, 0}, {width, 0, 0}};  // its front is below
}

/// A room with surfaces of all treatments: plain, glossy, a mirror, a pane, a ball.
Scene mixed_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {3, 3, 3}}, diffuse(0.6));
    add_object(scene, Box{{0.5, 1.7, 0}, {1.2, 2.4, 1.6}}, Phong{Rgb::grey(0.3), Rgb::grey(0.3), 10});
    add_object(scene, Rectangle{{2.99, 0.5, 0.5}, {0, 1, 0}, {0, 0, 1}}, Mirror{Rgb::grey(0.8)});
    add_object(scene, Rectangle{{0.1, 0.1, 1.2}, {1.5, 0, 0}, {0, 1.5, 0}},
               ThinDielectric{1.5, Rgb::grey(0.9)});
    add_object(scene, Sphere{{2, 1, 0.4}, 0.4}, Diffuse{{{0.7, 0.4, 0.2}}});
    return scene;
}

struct Traced {
    explicit Traced(const Scene& s)
        : scene(s), caster(scene), lights(scene, caster), tracer(scene, caster, lights) {}
    const Scene& scene;
    rays::RayCaster caster;
    LightSampler lights;
    PathTracer tracer;

    /// Paths along rays from the room's middle.
    std::vector<Path> paths(math::RandomKey key, std::uint64_t first, std::size_t count) const {
        std::vector<Path> paths;
        for (std::size_t i = 0; i < count; ++i) {
            math::SampleStream stream(key, first + i, 8);
            const auto [u1, u2] = stream.next_two();
            const Vec3 direction = math::sample_sphere(u1, u2).direction;
            const auto hit = caster.closest({1.4, 1.1, 1.9}, direction);
            paths.push_back({hit.value(), -direction, stream, kReflections});
        }
        return paths;
    }
};

/// The mean luminance over all directions: of paths side by side, and of single ones.
void expect_agreement(const Scene& scene) {
    const Traced traced(scene);
    std::vector<double> differences;
    statistics::RunningMoments level;
    constexpr std::size_t count = 1024;
    for (std::uint64_t replicate = 0; replicate < 32; ++replicate) {
        std::vector<Path> together = traced.paths({replicate}, 0, count);
        traced.tracer.trace(together, rays::Coherence::scattered);
        double difference = 0;
        for (const Path& path : together) difference += path.luminance_cd_m2.luminance() / count;
        level.add(difference);
        for (Path& path : traced.paths({replicate + 1000}, 0, count)) {
            difference -=
                traced.tracer.luminance_behind(path.hit, -path.outgoing, {}, kReflections, path.stream)
                    .luminance() /
                count;
        }
        differences.push_back(difference);
    }
    const statistics::Estimate estimate = statistics::estimate_from_replicates(differences);
    EXPECT_LT(std::abs(statistics::equivalent_z(z_score(estimate, 0), 31)), 4) << estimate.value;
    EXPECT_LT(estimate.standard_error, 0.02 * level.mean());
}

/// What panes absorb is a factor, not the end of paths by chance: the sky is seen through windows.
TEST(PathTracer, PanesWeakenPathsInPlaceOfEndingThem) {
    Scene scene;
    for (const double x : {1.0, 1.1})
        add_object(scene, Rectangle{{x, -1, -1}, {0, 2, 0}, {0, 0, 2}}, ThinDielectric{1, Rgb::grey(0.88)});
    add_environment(scene, Rgb::grey(1));
    const Traced traced(scene);
    const auto pane = traced.caster.closest({0, 0, 0}, {1, 0, 0});
    statistics::RunningMoments seen;
    for (std::uint64_t i = 0; i < 4096; ++i) {
        math::SampleStream stream(math::RandomKey{7}, i, 8);
        seen.add(
            traced.tracer.luminance_behind(pane.value(), {1, 0, 0}, {}, kReflections, stream).luminance());
    }
    // One of a thousand paths ends at each.
    const double expected = 0.88 * 0.88, deviation = expected * std::sqrt(2e-3);
    EXPECT_NEAR(seen.mean(), expected, 4 * deviation / std::sqrt(4096));
    EXPECT_LT(std::sqrt(seen.variance()), 2 * deviation);
}

TEST(PathWave, AgreesWithSinglePathsUnderAPanel) {
    Scene scene = mixed_room();
    add_area_light(scene, panel({1.2, 1.2, 2.99}, 0.6, 0.5), 100 * kWhite, diffuse(0.5));
    expect_agreement(scene);
}

TEST(PathWave, AgreesWithSinglePathsUnderSeveralLights) {
    Scene scene = mixed_room();
    add_area_light(scene, panel({1.2, 1.2, 2.99}, 0.6, 0.5), 100 * kWhite, diffuse(0.5));
    add_area_light(scene, panel({0.1, 0.1, 2.9}, 2.5, 0.1), {{20, 40, 60}});
    add_point_light(scene, {2.5, 2.5, 2}, 5 * kWhite);
    expect_agreement(scene);
}

TEST(PathWave, AgreesWithSinglePathsUnderLightsOfOtherKinds) {
    Scene scene = mixed_room();
    add_area_light(scene, Sphere{{1.5, 1.5, 2.5}, 0.1}, 100 * kWhite);
    add_area_light(scene, panel({0.1, 0.1, 2.9}, 2.5, 0.1), 50 * kWhite);
    expect_agreement(scene);
}

TEST(PathWave, AgreesWithSinglePathsUnderTheSky) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {3, 3, 0.5}}, diffuse(0.6));
    add_object(scene, Rectangle{{-5, -5, -3}, {20, 0, 0}, {0, 20, 0}}, diffuse(0.4));
    add_object(scene, Rectangle{{-5, -5, 6}, {20, 0, 0}, {0, 20, 0}}, diffuse(0.4));
    add_object(scene, Rectangle{{-5, -5, -3}, {0, 20, 0}, {0, 0, 9}}, diffuse(0.4));
    add_object(scene, Sphere{{1.4, 1.1, 1.9}, 30}, ThinDielectric{1.5, Rgb::grey(0.9)});
    add_sky(scene);
    expect_agreement(scene);
}

/// The light of a path does not depend on the paths beside it.
TEST(PathWave, PathsAreIndependentOfTheirNeighbours) {
    Scene scene = mixed_room();
    add_area_light(scene, panel({1.2, 1.2, 2.99}, 0.6, 0.5), 100 * kWhite, diffuse(0.5));
    const Traced traced(scene);
    std::vector<Path> together = traced.paths({3}, 0, 200);
    traced.tracer.trace(together, rays::Coherence::scattered);
    for (std::size_t i = 0; i < together.size(); ++i) {
        std::vector<Path> alone = traced.paths({3}, i, 1);
        traced.tracer.trace(alone, rays::Coherence::scattered);
        const double luminance = together[i].luminance_cd_m2.luminance();
        EXPECT_NEAR(alone[0].luminance_cd_m2.luminance(), luminance, 1e-6 * luminance) << i;
    }
}

/// The illuminance of points near, below and beside a lamp, and the density of its samples.
TEST(LaneLights, AgreeWithLightSampler) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {3, 3, 3}}, diffuse(0.6));
    add_area_light(scene, panel({1.2, 1.1, 2.9}, 0.6, 0.5), 100 * kWhite);
    add_area_light(scene, Rectangle{{0.1, 1, 1}, {0, 1, 0}, {0, 0, 0.4}}, 40 * kWhite);
    add_point_light(scene, {2.5, 2.5, 2}, 5 * kWhite);
    const Traced traced(scene);
    const auto lanes = LaneLights::of(scene, traced.caster.lift(), traced.lights);
    ASSERT_TRUE(lanes);
    rays::SurfacePacket at{};
    std::vector<rays::Hit> points;
    for (const Path& path : traced.paths({5}, 0, kPacketWidth)) {
        at.set(points.size(), path.hit, traced.caster.center());
        points.push_back(path.hit);
    }
    math::StreamPacket streams;
    for (std::size_t i = 0; i < kPacketWidth; ++i) streams.set(i, math::SampleStream({9 + i}, 0, 0));
    std::array<statistics::RunningMoments, kPacketWidth> of_lanes, of_points;
    for (std::uint64_t n = 0; n < 20'000; ++n) {
        LightPacket light;
        lanes->sample(at, next_four(streams, 0), light);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            const double cosine = std::max(0.0, dot(light.direction.at(i), points[i].normal));
            of_lanes[i].add(cosine * light.normal_illuminance_lx[0][i]);
            math::SampleStream stream({100 + i}, n, 0);
            const auto incident = traced.lights.sample_one_light(points[i], stream);
            of_points[i].add(incident ? std::max(0.0, dot(incident->direction, points[i].normal)) *
                                            incident->normal_illuminance_lx[0]
                                      : 0);
            const Vec3 sampled = at.position.at(i) + light.direction.at(i);
            EXPECT_TRUE(std::isfinite(sampled.x));
        }
    }
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        const double error = std::hypot(of_lanes[i].standard_error(), of_points[i].standard_error());
        EXPECT_LT(std::abs(of_lanes[i].mean() - of_points[i].mean()), 4 * error) << i;
    }
}

/// The density of a sampled direction is the one that MIS weights get for it: where all lanes are sampled at
/// once, and where a lamp is a ball.
TEST(PacketLights, HaveOneDensity) {
    for (const bool has_ball : {false, true}) {
        Scene scene;
        add_object(scene, Box{{0, 0, 0}, {3, 3, 3}}, diffuse(0.6));
        add_area_light(scene, panel({1.2, 1.1, 2.9}, 0.6, 0.5), 100 * kWhite);
        if (has_ball)
            add_area_light(scene, Sphere{{0.5, 0.8, 2.6}, 0.2}, 100 * kWhite);
        else
            add_area_light(scene, panel({0.2, 0.1, 2.8}, 0.3, 1.5), 100 * kWhite);
        const Traced traced(scene);
        const PacketLights lights(scene, traced.caster, traced.lights);
        rays::SurfacePacket at{};
        std::vector<rays::Hit> points;
        for (const Path& path : traced.paths({5}, 0, kPacketWidth)) {
            at.set(points.size(), path.hit, traced.caster.center());
            points.push_back(path.hit);
        }
        math::StreamPacket streams;
        for (std::size_t i = 0; i < kPacketWidth; ++i) streams.set(i, math::SampleStream({9 + i}, 0, 0));
        LaneMask all;
        all.fill(-1);
        int compared = 0;
        for (int n = 0; n < 100; ++n) {
            LightPacket light{};
            lights.sample(at, all, streams, 0, light);
            for (std::size_t i = 0; i < kPacketWidth; ++i) {
                if (!(light.normal_illuminance_lx[0][i] > 0)) continue;
                const auto hit = traced.caster.closest(points[i].lifted, normalized(light.direction.at(i)));
                if (!hit || hit->object != *lights::emitting_object(scene.lights[light.light[i]])) continue;
                const double pdf_per_sr = lights.pdf_per_sr(light.light[i], *hit, points[i]);
                EXPECT_NEAR(pdf_per_sr * light.inverse_pdf_sr[i], 1, 2e-3) << has_ball;
                ++compared;
            }
        }
        EXPECT_GT(compared, 500) << has_ball;
    }
}

TEST(LaneLights, LeaveOtherLightsToLightSampler) {
    const auto has_lanes = [](const Scene& scene) {
        const rays::RayCaster caster(scene);
        return LaneLights::of(scene, caster.lift(), LightSampler(scene, caster)).has_value();
    };
    Scene scene;
    EXPECT_FALSE(has_lanes(scene));
    add_area_light(scene, panel({1.2, 1.1, 2.9}, 0.6, 0.5), 100 * kWhite);
    EXPECT_TRUE(has_lanes(scene));
    add_area_light(scene, Rectangle{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}}, kWhite);  // not right-angled
    EXPECT_FALSE(has_lanes(scene));
}

}  // namespace
}  // namespace stilb::transport
