#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "exact/closed_rooms.h"
#include "exact/quadrature.h"

namespace stilb::exact {
namespace {

using std::numbers::pi;
using test::integrate;

Vec3 direction(double cosine, double angle) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

TEST(PhotometricSphere, WallReceivesTheSourcesWholeFluxAndItsReflections) {
    const PhotometricSphere sphere{2, 0.6};
    const double flux_lm = integrate(
        [&](double cosine) {
            return integrate(
                [&](double angle) {
                    return 4 * illuminance_lx(sphere, 100, {0.5, 0.3, -0.4}, direction(cosine, angle));
                },
                0, 2 * pi);
        },
        -1, 1);
    EXPECT_NEAR(flux_lm, 100 / (1 - 0.6), 1e-9);
}

TEST(PhotometricSphere, FirstReflectionIsTheSameEverywhere) {
    // At a small reflectance the indirect light is the first reflection plus terms of the order of its
    // square: compare the difference quotient at 0 with the transport integral over the wall.
    const double radius = 2, flux_lm = 100;
    const Vec3 source{0.5, 0.3, -0.4};
    for (const Vec3& to_wall : {Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}}) {
        const Vec3 here = radius * to_wall;
        const double first = integrate(
            [&](double cosine) {
                return integrate(
                    [&](double angle) {
                        const Vec3 outward = direction(cosine, angle);
                        const Vec3 way = radius * outward - here;
                        const double transport =
                            -dot(way, to_wall) * dot(way, outward) / (pi * std::pow(squared_length(way), 2));
                        return radius * radius * transport *
                               illuminance_lx({radius, 0}, flux_lm, source, outward);
                    },
                    0, 2 * pi);
            },
            -1, 1);
        const double tiny = 1e-10;
        EXPECT_NEAR(indirect_illuminance_lx({radius, tiny}, flux_lm) / tiny, first, 1e-8);
    }
}

TEST(PhotometricSphere, RefusesArgumentsOutsideItsDomain) {
    EXPECT_THROW(indirect_illuminance_lx({1, 1}, 1), std::domain_error);
    EXPECT_THROW(indirect_illuminance_lx({0, 0.5}, 1), std::domain_error);
    EXPECT_THROW(indirect_illuminance_lx({1, 0.5}, -1), std::domain_error);
    EXPECT_THROW(illuminance_lx({1, 0.5}, 1, {1, 0, 0}, {0, 0, 1}), std::domain_error);
    EXPECT_THROW(illuminance_lx({1, 0.5}, 1, {0, 0, 0}, {0, 0, 0}), std::domain_error);
}

}  // namespace
}  // namespace stilb::exact
