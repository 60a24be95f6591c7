// The declination and the equation of time are those of Radiance's gensky, in the simple forms of its manual.
#include "lights/sky/sun_position.h"

#include <array>
#include <cmath>

namespace stilb::lights {

Vec3 SunPosition::direction() const {
    const double horizontal = std::cos(altitude);
    return {-std::sin(azimuth) * horizontal, -std::cos(azimuth) * horizontal, std::sin(altitude)};
}

int day_of_year(int month, int day) {
    constexpr std::array<int, 12> days_before{0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
    return days_before[static_cast<std::size_t>(month - 1)] + day;
}

double solar_hour(int day, double clock_hour, const Site& site) {
    return clock_hour + 0.170 * std::sin(4 * kPi / 373 * (day - 80)) -
           0.129 * std::sin(2 * kPi / 355 * (day - 8)) + 12 * (site.meridian - site.longitude) / kPi;
}

SunPosition sun_position(int day, double solar_hour, double latitude) {
    const double declination = 0.4093 * std::sin(2 * kPi / 365 * (day - 81));
    const double turn = solar_hour * kPi / 12;
    return {std::asin(std::sin(latitude) * std::sin(declination) -
                      std::cos(latitude) * std::cos(declination) * std::cos(turn)),
            -std::atan2(std::cos(declination) * std::sin(turn),
                        -std::cos(latitude) * std::sin(declination) -
                            std::sin(latitude) * std::cos(declination) * std::cos(turn))};
}

}  // namespace stilb::lights
