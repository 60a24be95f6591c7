// Where the sun stands, by place and time.
#pragma once

#include "base/vec.h"

namespace stilb::lights {

/// Angles in radians.
struct SunPosition {
    double altitude = 0;
    double azimuth = 0;  ///< from the south towards the west

    /// Unit, towards the sun: x leads to the east, y to the north, z upwards.
    Vec3 direction() const;
};

/// A place on the earth, in radians; north and west are positive.
struct Site {
    double latitude = 0, longitude = 0;
    double meridian = 0;  ///< the longitude of the time zone
};

/// From 1 to 365. `month`: from 1.
int day_of_year(int month, int day);
/// The hour of solar time, whose noon is the culmination, by the equation of time.
double solar_hour(int day, double clock_hour, const Site& site);
SunPosition sun_position(int day, double solar_hour, double latitude);

}  // namespace stilb::lights
