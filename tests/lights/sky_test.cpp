// Skies of the CIE: each formula against its own statements of the zenith and of the ground; the sun's place
// against almanacs. Numbers of Radiance's programs: tests/import/radiance_sky_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "lights/sky/sky_luminance.h"
#include "lights/sky/sun_position.h"

namespace stilb::lights {
namespace {

constexpr double kRadiansPerDegree = kPi / 180;

SkyLuminance sky_of(SkyType type, double sun_altitude) {
    return {type, 1, SunPosition{sun_altitude, 0.7}.direction(), zenith_value(type, sun_altitude), {}};
}

/// The horizontal illuminance over pi, by a sum over directions in proportion to the cosine.
double mean_of(const SkyLuminance& sky) {
    constexpr int steps = 200;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double square = (i + 0.5) / steps, horizontal = std::sqrt(1 - square);
        for (int j = 0; j < steps; ++j) {
            const double azimuth = 2 * kPi * (j + 0.5) / steps;
            sum += sky.towards(
                {horizontal * std::cos(azimuth), horizontal * std::sin(azimuth), std::sqrt(square)});
        }
    }
    return sum / (steps * steps);
}

TEST(Sky, HasTheLuminanceOfItsZenith) {
    for (const SkyType type : {SkyType::clear, SkyType::overcast, SkyType::uniform, SkyType::intermediate}) {
        for (double altitude = 5; altitude < 90; altitude += 10)
            EXPECT_NEAR(sky_of(type, altitude * kRadiansPerDegree).towards({0, 0, 1}), 1, 1e-3) << altitude;
    }
}

TEST(Sky, GivesTheGroundItsLight) {
    for (double altitude = 5; altitude < 80; altitude += 10) {
        const auto expect_mean = [&](SkyType type, double tolerance) {
            const double mean = mean_over_zenith(type, altitude * kRadiansPerDegree);
            EXPECT_NEAR(mean_of(sky_of(type, altitude * kRadiansPerDegree)), mean, tolerance * mean)
                << altitude;
        };
        expect_mean(SkyType::clear, 0.003);  // the means of both are polynomials
        expect_mean(SkyType::intermediate, 0.02);
        expect_mean(SkyType::overcast, 1e-4);
        expect_mean(SkyType::uniform, 1e-12);
    }
}

TEST(Sky, TheSunCulminatesInTheSouth) {
    const Site munich{48.1 * kRadiansPerDegree, -11.6 * kRadiansPerDegree, -15 * kRadiansPerDegree};
    const int solstice = day_of_year(6, 21);
    EXPECT_EQ(solstice, 172);
    const SunPosition noon = sun_position(solstice, 12, munich.latitude);
    EXPECT_NEAR(noon.altitude / kRadiansPerDegree, 90 - 48.1 + 23.44, 0.05);
    EXPECT_NEAR(noon.direction().x, 0, 1e-12);
    EXPECT_LT(noon.direction().y, 0);
    EXPECT_GT(sun_position(solstice, 9, munich.latitude).direction().x, 0.5);  // in the east
    // The culmination in Munich is 13.6 minutes after that at 15 degrees east; the equation of time is 2
    // minutes in June, and 16 of the other sign at the beginning of November.
    EXPECT_NEAR(solar_hour(solstice, 12, munich), 12 - (13.6 + 2) / 60, 0.02);
    EXPECT_NEAR(solar_hour(day_of_year(11, 3), 12, munich), 12 - (13.6 - 16.4) / 60, 0.02);
}

}  // namespace
}  // namespace stilb::lights
