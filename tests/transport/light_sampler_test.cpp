#include "transport/light_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "exact/configuration_factors.h"
#include "statistics/hypothesis.h"
#include "support/moments.h"
#include "support/scene_builder.h"

namespace stilb::transport {
namespace {

constexpr Rgb kWhiteLamp = Rgb::grey(1);

/// Light of one emitter on a receiver, as the sampler gives it, against the exact value.
void expect_illuminance(const Shape& shape, const exact::Receiver& receiver, double exact_lx) {
    Scene scene;
    add_area_light(scene, shape, 100 * kWhiteLamp);
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    std::vector<double> means;
    for (std::uint64_t replicate = 0; replicate < 32; ++replicate) {
        statistics::RunningMoments moments;
        for (std::uint64_t i = 0; i < 1024; ++i) {
            math::SampleStream stream(math::RandomKey{replicate}, i);
            const auto incident = lights.sample_incident(0, {receiver.position}, stream.next_two());
            double lx = 0;
            if (incident) {
                const double cosine = std::max(0.0, dot(incident->direction, receiver.normal));
                lx = cosine * incident->normal_illuminance_lx.luminance();
                EXPECT_FALSE(caster.occluded(receiver.position, incident->source_point));
            }
            moments.add(lx);
        }
        means.push_back(moments.mean());
    }
    const statistics::Estimate measured = statistics::estimate_from_replicates(means);
    EXPECT_LT(std::abs(statistics::equivalent_z(z_score(measured, exact_lx), 31)), 4)
        << measured.value << ' ' << exact_lx;
    EXPECT_LT(measured.standard_error, 0.01 * exact_lx);
}

/// A sampler that chooses some of 100 lamps has the same expectation as one that samples each of them.
TEST(ExtendedLights, OfManySomeStandForAll) {
    Scene scene;
    for (int i = 0; i < 100; ++i) {
        const Vec3 corner{0.4 * (i % 10), 0.4 * (i / 10), 2 + 0.01 * i};
        add_area_light(scene, Rectangle{corner, {0, 0.1, 0}, {0.1, 0, 0}}, Rgb::grey(1 + i % 7));
    }
    add_point_light(scene, {2, 2, 1.5}, kWhiteLamp);  // has no extent
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    const SurfacePoint oriented{{1.3, 0.8, 0.5}, Vec3{0.6, 0, 0.8}}, free{{1.3, 0.8, 0.5}};
    const auto mean_lx = [&](const SurfacePoint& at) {
        std::vector<double> means;
        for (std::uint64_t replicate = 0; replicate < 32; ++replicate) {
            statistics::RunningMoments moments;
            for (std::uint64_t i = 0; i < 256; ++i) {
                math::SampleStream stream(math::RandomKey{replicate}, i);
                double lx = 0;
                lights.sample_extended(at, stream, [&](const IncidentLight& light) {
                    lx += std::max(0.0, dot(light.direction, oriented.normal)) *
                          light.normal_illuminance_lx.luminance();
                });
                moments.add(lx);
            }
            means.push_back(moments.mean());
        }
        return statistics::estimate_from_replicates(means);
    };
    const statistics::Estimate some = mean_lx(oriented), all = mean_lx(free);  // without a normal: one by one
    EXPECT_LT(some.standard_error, 0.005 * some.value);
    EXPECT_LT(std::abs(statistics::equivalent_z(z_score(some, all), 31)), 4)
        << some.value << ' ' << all.value;
}

/// The density integrates to the expected number of samples that reach the point.
TEST(ExtendedLights, HaveTheDensityThatTheyAreSampledWith) {
    Scene scene;
    for (int i = 0; i < 40; ++i) {
        add_area_light(scene, Rectangle{{0.4 * (i % 8), 0.4 * (i / 8), 2}, {0, 0.2, 0}, {0.2, 0, 0}},
                       kWhiteLamp);
    }
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    const SurfacePoint at{{1.3, 0.8, 0.5}, Vec3{0, 0, 1}};
    for (std::uint64_t i = 0; i < 16; ++i) {
        math::SampleStream stream(math::RandomKey{2}, i);
        lights.sample_extended(at, stream, [&](const IncidentLight& light) {
            const auto hit = caster.closest(at.position, light.direction);
            ASSERT_TRUE(hit);
            EXPECT_NEAR(lights.extended_pdf_per_sr(index_of(hit->object), *hit, at), light.pdf_per_sr,
                        1e-3 * light.pdf_per_sr);
        });
    }
}

/// What is made elsewhere is never chosen, and counts nothing where a path runs into it.
TEST(IncidentLight, LeavesOutWhatIsMadeElsewhere) {
    Scene scene;
    add_area_light(scene, Rectangle{{0, 0, 3}, {0, 1, 0}, {1, 0, 0}}, kWhiteLamp);
    add_area_light(scene, Rectangle{{2, 0, 3}, {0, 1, 0}, {1, 0, 0}}, kWhiteLamp);
    const rays::RayCaster caster(scene);
    const LightSampler rest(scene, caster, {true, false}), none(scene, caster, {true, true});
    const Vec3 from{1, 0.5, 0}, up{0, 0, 1};
    for (std::uint64_t i = 0; i < 16; ++i) {
        math::SampleStream stream(math::RandomKey{1}, i);
        const auto light = rest.sample_one_light({from, up}, stream);
        ASSERT_TRUE(light);
        EXPECT_GT(light->source_point.x, 2);
        EXPECT_FALSE(none.sample_one_light({from, up}, stream));
    }
    const auto left_out = caster.closest(from, normalized(Vec3{-0.5, 0, 3}));
    const auto kept = caster.closest(from, normalized(Vec3{1.5, 0, 3}));
    ASSERT_TRUE(left_out && kept);
    EXPECT_TRUE(std::isinf(rest.pdf_per_sr(0, *left_out, {from, up})));
    const double kept_pdf = rest.pdf_per_sr(1, *kept, {from, up});
    EXPECT_GT(kept_pdf, 0);
    EXPECT_EQ(kept_pdf, rest.pdf_of_its_light_per_sr(1, *kept, {from}));
}

TEST(IncidentLight, OfShapesIsThatOfConfigurationFactors) {
    const exact::Receiver receiver{{0.3, 0.2, 0}, normalized(Vec3{0.2, 0.3, 1})};
    const Rectangle rectangle{{-0.5, -0.4, 1}, {0, 1, 0.2}, {1.2, 0, 0.1}};
    expect_illuminance(rectangle, receiver,
                       exact::illuminance_by_rectangle_lx(receiver, rectangle.corner, rectangle.edge_u,
                                                          rectangle.edge_v, 100));
    const Disk disk{{0.5, 0.5, 1.5}, normalized(Vec3{-0.2, 0.1, -1}), 0.6};
    expect_illuminance(disk, receiver,
                       exact::illuminance_by_disk_lx(receiver, {disk.center, disk.normal, disk.radius}, 100));
    for (const double height : {1.5, 0.3}) {  // the lower one reaches below the receiver's horizon
        const Sphere sphere{{1, 0.2, height}, 0.4};
        expect_illuminance(sphere, receiver,
                           exact::illuminance_by_sphere_lx(receiver, sphere.center, sphere.radius, 100));
    }
    const Mesh triangle{{{-0.3, 0.1, 1}, {0.4, 0.9, 1.2}, {0.8, -0.3, 0.9}}, {{0, 1, 2}}};
    expect_illuminance(triangle, receiver,
                       exact::illuminance_by_polygon_lx(receiver, triangle.vertices, 100));
}

TEST(IncidentLight, OfAPointIsExact) {
    Scene scene;
    add_point_light(scene, {1, 2, 3}, 50 * kWhiteLamp);
    const rays::RayCaster caster(scene);
    const auto incident = LightSampler(scene, caster).sample_incident(0, {}, {});
    ASSERT_TRUE(incident);
    EXPECT_NEAR(incident->normal_illuminance_lx.luminance(), 50.0 / 14, 1e-12);
}

/// A receiver lit by several lights, one chosen at random, against all of them added up.
TEST(IncidentLight, OfOneChosenLightIsThatOfAll) {
    Scene scene;
    add_point_light(scene, {1, 0, 2}, 30 * kWhiteLamp);
    add_point_light(scene, {-1, 1, 1}, 5 * kWhiteLamp);
    add_point_light(scene, {0, 0, -1}, 500 * kWhiteLamp);  // below the horizon
    add_area_light(scene, Sphere{{0.5, 1, 2}, 0.3}, 20 * kWhiteLamp);
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    const exact::Receiver receiver{{0, 0, 0}, {0, 0, 1}};
    const double exact_lx = exact::illuminance_by_point_lx(receiver, {1, 0, 2}, 30) +
                            exact::illuminance_by_point_lx(receiver, {-1, 1, 1}, 5) +
                            exact::illuminance_by_sphere_lx(receiver, {0.5, 1, 2}, 0.3, 20);
    std::vector<double> means;
    for (std::uint64_t replicate = 0; replicate < 32; ++replicate) {
        statistics::RunningMoments moments;
        for (std::uint64_t i = 0; i < 1024; ++i) {
            math::SampleStream stream(math::RandomKey{replicate}, i);
            const auto light = lights.sample_one_light({receiver.position, receiver.normal}, stream);
            moments.add(light ? std::max(0.0, light->direction.z) * light->normal_illuminance_lx.luminance()
                              : 0);
        }
        means.push_back(moments.mean());
    }
    EXPECT_LT(std::abs(statistics::equivalent_z(
                  statistics::z_score(statistics::estimate_from_replicates(means), exact_lx), 31)),
              4);
}

/// Few lights, which are chosen one by one, and many, by the tree: samples that are spread over them have the
/// expectation of all lights, and less noise than as many that are chosen one by one.
TEST(IncidentLight, OfSomeLightsIsThatOfAll) {
    const exact::Receiver receiver{{0, 0, 0}, {0.6, 0, 0.8}};
    constexpr std::uint32_t kSamples = 32;
    for (const int count : {9, 60}) {
        Scene scene;
        double exact_lx = 0;
        for (int i = 0; i < count; ++i) {
            const Vec3 place{i % 10 - 1.0, i / 10 - 2.0, 2.5 + 0.05 * i};
            add_area_light(scene, Sphere{place, 0.3}, Rgb::grey(10 + i));
            exact_lx += exact::illuminance_by_sphere_lx(receiver, place, 0.3, 10 + i);
        }
        const rays::RayCaster caster(scene);
        const LightSampler lights(scene, caster);
        statistics::RunningMoments spread, apart;
        for (std::uint64_t i = 0; i < 4096; ++i) {
            const auto received_lx = [&](const IncidentLight& light) {
                return std::max(0.0, dot(light.direction, receiver.normal)) *
                       light.normal_illuminance_lx.luminance();
            };
            math::SampleStream stream(math::RandomKey{i}, 0);
            double sum_lx = 0;
            lights.sample_some_lights({receiver.position, receiver.normal}, kSamples, stream,
                                      [&](const IncidentLight& light) { sum_lx += received_lx(light); });
            spread.add(sum_lx);
            sum_lx = 0;
            for (std::uint32_t k = 0; k < kSamples; ++k) {
                math::SampleStream single(math::RandomKey{i}.derived(1 + k), 0);  // independent
                const auto light = lights.sample_one_light({receiver.position, receiver.normal}, single);
                if (light) sum_lx += received_lx(*light) / kSamples;
            }
            apart.add(sum_lx);
        }
        EXPECT_LT(std::abs(spread.mean() - exact_lx), 4 * spread.standard_error()) << count;
        EXPECT_LT(spread.standard_error(), 1e-3 * exact_lx) << count;
        EXPECT_LT(spread.variance(), apart.variance() / 10) << count;
    }
}

TEST(IncidentLight, DensityIsAboutThatOfRaysThatMeetTheEmitter) {
    Scene scene;
    add_area_light(scene, Box{{1, 1, 1}, {1.5, 1.3, 1.2}}, 10 * kWhiteLamp);
    add_area_light(scene, inward(Box{{-9, -9, -9}, {9, 9, 9}}), kWhiteLamp);
    add_area_light(scene, Rectangle{{-1, -1, 2}, {0, 1, 0}, {1, 0.2, 0}}, 5 * kWhiteLamp);
    add_area_light(scene, Disk{{-1, 1, 1}, normalized(Vec3{1, -1, -1}), 0.4}, 20 * kWhiteLamp);
    add_area_light(scene, Sphere{{1, -1, 1}, 0.3}, 20 * kWhiteLamp);
    add_point_light(scene, {0, 0, 1.5}, kWhiteLamp);
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    const Vec3 from{0, 0, 0}, normal{0, 0, 1};
    std::vector<int> met(scene.objects.size());
    constexpr std::uint64_t kSamples = 4096;
    for (std::uint64_t i = 0; i < kSamples; ++i) {
        math::SampleStream stream(math::RandomKey{3}, i);
        const auto light = lights.sample_one_light({from, normal}, stream);
        if (!light || std::isinf(light->pdf_per_sr)) continue;
        const auto hit = caster.closest(from, light->direction);
        ASSERT_TRUE(hit);
        if (length(hit->lifted - light->source_point) > 1e-3) continue;  // something stands before it
        ++met[index_of(hit->object)];
        const double pdf = lights.pdf_per_sr(index_of(hit->object), *hit, {from, normal});
        EXPECT_NEAR(pdf, light->pdf_per_sr, 1e-6 * pdf) << index_of(hit->object);
        // Light times the true density is the luminance; this one is about the truth.
        const double ratio =
            light->normal_illuminance_lx[0] * pdf / lights.emitted_luminance(*hit, -light->direction)[0];
        EXPECT_GT(ratio, 0.7) << index_of(hit->object);
        EXPECT_LT(ratio, 1.4) << index_of(hit->object);
    }
    for (const int count : met) EXPECT_GT(count, 10);
}

TEST(Emission, SharesFluxAmongLightsAndLeavesTheirFronts) {
    Scene scene;
    add_point_light(scene, {0, 0, 5}, {{1, 2, 3}});
    add_area_light(scene, Rectangle{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {{4, 2, 1}});
    add_area_light(scene, Sphere{{5, 0, 0}, 0.5}, 3 * kWhiteLamp);
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    constexpr std::uint64_t kParticles = 1 << 16;
    std::vector<double> observed(3), expected;
    std::vector<double> cosines_squared;
    Rgb total;
    for (std::uint64_t i = 0; i < kParticles; ++i) {
        math::SampleStream stream(math::RandomKey{8}.derived(i), 0);  // independent, as chi2 asks for
        const EmittedParticle particle = lights.sample_emission(stream);
        total += particle.flux_lm * (1.0 / kParticles);
        const std::size_t light = particle.from_point ? 0 : particle.origin.x < 2 ? 1 : 2;
        ++observed[light];
        if (light == 1) {
            ASSERT_GT(particle.origin.z, 0);
            cosines_squared.push_back(particle.direction.z * particle.direction.z);  // uniform: Lambert
        }
        if (light == 2) {
            const Vec3 normal = particle.origin - Vec3{5, 0, 0};
            ASSERT_GT(length(normal), 0.5);
            ASSERT_GT(dot(normal, particle.direction), 0);
        }
        EXPECT_EQ(particle.from_point, light == 0);
    }
    Rgb exact_total;
    for (const Light& light : scene.lights) {
        exact_total += flux_lm(scene, light);
        expected.push_back(flux_lm(scene, light).luminance());
    }
    for (double& e : expected) e *= kParticles / exact_total.luminance();
    EXPECT_GT(statistics::chi2_test(observed, expected).p_value, 1e-4);
    EXPECT_GT(statistics::uniformity_p(cosines_squared), 1e-4);
    EXPECT_NEAR(total.luminance(), exact_total.luminance(), 1e-9 * exact_total.luminance());
    for (std::size_t b = 0; b < kBands; ++b) EXPECT_NEAR(total[b], exact_total[b], 0.02 * exact_total[b]);
}

}  // namespace
}  // namespace stilb::transport
