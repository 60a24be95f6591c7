// The furnace: a closed enclosure whose walls all emit and reflect alike.
#pragma once

namespace stilb::exact {

/// The luminance of every wall point in every direction where all walls emit `emitted_cd_m2` in all
/// directions and have a BRDF of albedo `reflectance` (0 to less than 1, the same for all directions of
/// incidence), whatever the enclosure's shape. Throws std::domain_error on arguments out of range.
double furnace_luminance_cd_m2(double emitted_cd_m2, double reflectance);

/// The illuminance in that enclosure, at any point and for any normal.
double furnace_illuminance_lx(double emitted_cd_m2, double reflectance);

}  // namespace stilb::exact
