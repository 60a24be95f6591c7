#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "exact/closed_rooms.h"
#include "exact/configuration_factors.h"
#include "exact/quadrature.h"

namespace stilb::exact {
namespace {

using std::numbers::pi;
using test::integrate;

TEST(CoaxialDisks, FormFactorIsTheMeanOfTheConfigurationFactor) {
    std::mt19937_64 generator(7);
    std::uniform_real_distribution<double> length(0.3, 3);
    for (int i = 0; i < 100; ++i) {
        const double radius_1 = length(generator), radius_2 = length(generator), distance = length(generator);
        const auto factor = [&](double r) {
            return illuminance_by_disk_lx({{r, 0, 0}, {0, 0, 1}}, {{0, 0, distance}, {0, 0, -1}, radius_2},
                                          1 / pi);
        };
        const double mean =
            integrate([&](double r) { return 2 * r * factor(r); }, 0, radius_1) / (radius_1 * radius_1);
        const FormFactors factors = coaxial_disk_form_factors(radius_1, radius_2, distance);
        EXPECT_NEAR(factors.from_to[0][1], mean, 1e-13);
        EXPECT_NEAR(factors.from_to[1][0] * radius_2 * radius_2, mean * radius_1 * radius_1, 1e-12);
    }
}

TEST(CoaxialDisks, FarApartSeeEachOtherAsPoints) {
    const FormFactors factors = coaxial_disk_form_factors(1, 2, 1e6);
    EXPECT_NEAR(factors.from_to[0][1] / 4e-12, 1, 1e-11);
}

TEST(TwoSurfaces, EqualTheirNeumannSeries) {
    const std::array<DiffuseSurface, 2> surfaces{DiffuseSurface{10, 0.7}, DiffuseSurface{3, 0.4}};
    for (const FormFactors& factors :
         {coaxial_disk_form_factors(1, 2, 0.5), concentric_sphere_form_factors(1, 1.5)}) {
        std::array<double, 2> sum{}, order{surfaces[0].emitted_lm_m2, surfaces[1].emitted_lm_m2};
        for (int reflections = 0; reflections < 500; ++reflections) {
            const auto& [from_1, from_2] = factors.from_to;
            const std::array arriving{from_1[0] * order[0] + from_1[1] * order[1],
                                      from_2[0] * order[0] + from_2[1] * order[1]};
            for (std::size_t i = 0; i < 2; ++i) {
                sum[i] += arriving[i];
                order[i] = surfaces[i].reflectance * arriving[i];
            }
        }
        const std::array<double, 2> solved = two_surface_illuminance_lx(surfaces, factors);
        EXPECT_NEAR(solved[0], sum[0], 1e-12);
        EXPECT_NEAR(solved[1], sum[1], 1e-12);
    }
}

TEST(ConcentricSpheres, AbsorbWhatTheyEmit) {
    const double inner = 0.8, outer = 1.9;
    const std::array<DiffuseSurface, 2> surfaces{DiffuseSurface{10, 0.7}, DiffuseSurface{3, 0.95}};
    const auto illuminance =
        two_surface_illuminance_lx(surfaces, concentric_sphere_form_factors(inner, outer));
    const double emitted = 10 * inner * inner + 3 * outer * outer;
    const double absorbed = 0.3 * illuminance[0] * inner * inner + 0.05 * illuminance[1] * outer * outer;
    EXPECT_NEAR(absorbed / emitted, 1, 1e-13);
}

TEST(TwoSurfaces, RefuseArgumentsOutsideTheirDomain) {
    const std::array<DiffuseSurface, 2> white{DiffuseSurface{1, 1}, DiffuseSurface{1, 1}};
    EXPECT_THROW(two_surface_illuminance_lx(white, concentric_sphere_form_factors(1, 2)), std::domain_error);
    const FormFactors too_much{{{{0.5, 0.6}, {0, 0}}}};
    EXPECT_THROW(two_surface_illuminance_lx({}, too_much), std::domain_error);
    EXPECT_THROW(coaxial_disk_form_factors(0, 1, 1), std::domain_error);
    EXPECT_THROW(coaxial_disk_form_factors(1, 1, 0), std::domain_error);
    EXPECT_THROW(concentric_sphere_form_factors(2, 1), std::domain_error);
}

}  // namespace
}  // namespace stilb::exact
