// Light from infinity as the sampler gives it: particles and incident light against exact values.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "materials/black.h"
#include "statistics/hypothesis.h"
#include "statistics/interval.h"
#include "stilb/error.h"
#include "support/scene_builder.h"
#include "transport/light_sampler.h"

namespace stilb::transport {
namespace {

constexpr int kSkyReplicates = 32;

/// A ball in a corner of the scene's box, which a speck in the opposite corner spans.
constexpr Sphere kBall{{0, 0, 0}, 0.5};
Scene ball_and_speck() {
    Scene scene;
    add_object(scene, kBall, Black{});
    add_object(scene, Sphere{{3, 2, 1}, 0.01}, Black{});
    return scene;
}

/// Of `sample(stream)`, from replicates of low-discrepancy points.
template <typename Sample>
statistics::Estimate mean_of(const Sample& sample, std::uint64_t samples = 1 << 12) {
    std::vector<double> means;
    for (std::uint64_t replicate = 0; replicate < kSkyReplicates; ++replicate) {
        double sum = 0;
        for (std::uint64_t i = 0; i < samples; ++i) {
            math::SampleStream stream(math::RandomKey{replicate}, i);
            sum += sample(stream);
        }
        means.push_back(sum / static_cast<double>(samples));
    }
    return statistics::estimate_from_replicates(means);
}

void expect_agrees(const statistics::Estimate& measured, double exact, double largest_error) {
    EXPECT_LT(std::abs(statistics::equivalent_z(z_score(measured, exact), kSkyReplicates - 1)), 4)
        << measured.value << ' ' << exact;
    EXPECT_LT(measured.standard_error, largest_error * exact);
}

/// A ball that nothing shades receives from each direction over its cross-section.
void expect_flux_into_ball(const Scene& scene, const Rgb& total_lx) {
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    for (std::size_t band = 0; band < kBands; ++band) {
        const auto into_ball = [&](math::SampleStream& stream) {
            const EmittedParticle particle = lights.sample_emission(stream);
            EXPECT_FALSE(particle.from_point);
            const auto hit = caster.closest(particle.origin, particle.direction);
            return hit && hit->object == ObjectId{0} ? particle.flux_lm[band] : 0;
        };
        expect_agrees(mean_of(into_ball), kPi * kBall.radius * kBall.radius * total_lx[band], 0.02);
    }
}

TEST(EnvironmentEmission, BringsABallItsFlux) {
    Scene scene = ball_and_speck();
    const Rgb luminance{{30, 20, 5}};
    add_environment(scene, luminance);
    expect_flux_into_ball(scene, 4 * kPi * luminance);
}

TEST(EnvironmentEmission, BringsABallItsFluxOfAPanorama) {
    Scene scene = ball_and_speck();
    add_sky(scene, {0.4, 0.2, 0.7}, 50);
    const auto& light = std::get<EnvironmentLight>(scene.lights[0].source);
    expect_flux_into_ball(scene, light.panorama->total_lx());
}

/// Beside a weaker lamp each gets half of the particles, and the flux stays what it is.
TEST(EnvironmentEmission, LeavesOtherLightsTheirParticles) {
    Scene scene = ball_and_speck();
    add_environment(scene, Rgb::grey(30));
    add_point_light(scene, {1, 1, 0.5}, Rgb::grey(1));
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    int from_point = 0;
    double point_lm = 0;
    for (std::uint64_t i = 0; i < 1024; ++i) {
        math::SampleStream stream(math::RandomKey{1}, i);
        const EmittedParticle particle = lights.sample_emission(stream);
        from_point += particle.from_point;
        if (particle.from_point) point_lm += particle.flux_lm.luminance() / 1024;
    }
    EXPECT_NEAR(from_point, 512, 1);
    EXPECT_NEAR(point_lm, 4 * kPi, 1e-2 * 4 * kPi);
}

TEST(EnvironmentIncident, OfConstantLuminanceIsExactOnAnyPlane) {
    Scene scene = ball_and_speck();
    add_environment(scene, Rgb::grey(30));
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    const SurfacePoint at{{1, 1, 1}, normalized(Vec3{1, -2, 0.5})};
    for (std::uint64_t i = 0; i < 64; ++i) {
        math::SampleStream stream(math::RandomKey{1}, i);
        const auto light = lights.sample_incident(0, at, stream.next_two());
        ASSERT_TRUE(light);
        const double cosine = dot(light->direction, at.normal);
        EXPECT_NEAR(cosine * light->normal_illuminance_lx.luminance(), kPi * 30, 1e-9);
        EXPECT_NEAR(light->pdf_per_sr, lights.pdf_of_outside_light_per_sr(light->direction, at), 1e-12);
    }
    // Received from all around, without a normal: 4 pi L.
    const auto around = [&](math::SampleStream& stream) {
        return lights.sample_incident(0, {at.position}, stream.next_two())->normal_illuminance_lx.luminance();
    };
    EXPECT_NEAR(mean_of(around).value, 4 * kPi * 30, 1e-9);
}

TEST(EnvironmentIncident, OfAPanoramaIsItsIlluminance) {
    Scene scene = ball_and_speck();
    add_sky(scene, {0.1, -0.3, 1}, -20);
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    const auto& light = std::get<EnvironmentLight>(scene.lights[0].source);
    for (const Vec3& normal : {Vec3{0, 0, 1}, normalized(Vec3{1, 1, 0.2}), Vec3{0, 0, -1}}) {
        // By midpoints of small parts of the sphere.
        constexpr int kSteps = 1000;
        double exact_lx = 0;
        for (int i = 0; i < kSteps; ++i) {
            for (int j = 0; j < 2 * kSteps; ++j) {
                const double z = 1 - (2 * i + 1.0) / kSteps, azimuth = kPi * (j + 0.5) / kSteps;
                const double r = std::sqrt(1 - z * z);
                const Vec3 w{r * std::cos(azimuth), r * std::sin(azimuth), z};
                exact_lx += std::max(dot(w, normal), 0.0) * lights.outside_luminance(w).luminance();
            }
        }
        exact_lx *= 4 * kPi / (2.0 * kSteps * kSteps);
        const auto received = [&](math::SampleStream& stream) {
            const auto incident = lights.sample_incident(0, {{1, 1, 1}, normal}, stream.next_two());
            return std::max(dot(incident->direction, normal), 0.0) *
                   incident->normal_illuminance_lx.luminance();
        };
        const statistics::Estimate measured = mean_of(received);
        EXPECT_NEAR(measured.value, exact_lx, 2e-3 * exact_lx);
        const Rgb by_pixels = light.panorama->illuminance_lx(light.axes.to_local(normal));
        EXPECT_NEAR(by_pixels.luminance(), exact_lx, 0.05 * exact_lx) << "16 x 8 pixels by their middles";
    }
}

/// Segments towards it end beyond everything, and meet what is between.
TEST(EnvironmentIncident, EndsBeyondTheScene) {
    Scene scene = ball_and_speck();
    add_environment(scene, Rgb::grey(1));
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    for (const Vec3& from : {Vec3{1, 0.5, 0}, Vec3{-40, 3, 7}}) {
        const Vec3 to_ball = normalized(kBall.center - from);
        for (std::uint64_t i = 0; i < 512; ++i) {
            math::SampleStream stream(math::RandomKey{2}, i);
            const auto light = lights.sample_incident(0, {from, to_ball}, stream.next_two());
            ASSERT_TRUE(light);
            EXPECT_EQ(caster.occluded(from, light->source_point),
                      caster.closest(from, light->direction).has_value());
        }
    }
}

TEST(EnvironmentIncident, OneOfAllLightsHasTheDensityThatIsSaid) {
    Scene scene = ball_and_speck();
    add_sky(scene);
    add_area_light(scene, Sphere{{1, 1, 2}, 0.2}, Rgb::grey(500));
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    const Vec3 from{1, 1, 0.6}, normal{0, 0.6, 0.8};
    int outside = 0;
    const auto received = [&](math::SampleStream& stream) {
        const auto light = lights.sample_one_light({from, normal}, stream);
        if (!light) return 0.0;
        if (length(light->source_point - from) > 2.5) {
            ++outside;
            EXPECT_NEAR(light->pdf_per_sr, lights.outside_pdf_per_sr(light->direction, {from, normal}),
                        1e-9 * light->pdf_per_sr);
        }
        return std::max(dot(light->direction, normal), 0.0) * light->normal_illuminance_lx.luminance();
    };
    const statistics::Estimate one = mean_of(received);
    EXPECT_GT(outside, 1000);
    const auto all = [&](math::SampleStream& stream) {
        double sum = 0;
        for (std::size_t i = 0; i < 2; ++i) {
            const auto light = lights.sample_incident(i, {from, normal}, stream.next_two());
            if (light)
                sum +=
                    std::max(dot(light->direction, normal), 0.0) * light->normal_illuminance_lx.luminance();
        }
        return sum;
    };
    const statistics::Estimate sum = mean_of(all);
    EXPECT_LT(std::abs(statistics::equivalent_z(z_score(one, sum), kSkyReplicates - 1)), 4);
    EXPECT_LT(one.standard_error, 0.01 * one.value);
}

TEST(Environment, IsTheOnlyOne) {
    Scene scene = ball_and_speck();
    add_environment(scene, Rgb::grey(1));
    add_sky(scene);
    const rays::RayCaster caster(scene);
    EXPECT_THROW((LightSampler{scene, caster}), InputError);
}

TEST(Environment, LightsASceneWithoutObjects) {
    Scene scene;
    add_environment(scene, Rgb::grey(7));
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    math::SampleStream stream(math::RandomKey{1}, 0);
    EXPECT_TRUE(lights.sample_emission(stream).flux_lm.is_finite());
    EXPECT_EQ(lights.outside_luminance({0, 1, 0}), Rgb::grey(7));
}

}  // namespace
}  // namespace stilb::transport
