#include "exact/furnace.h"

#include <numbers>

#include "exact/domain.h"

namespace stilb::exact {

double furnace_luminance_cd_m2(double emitted_cd_m2, double reflectance) {
    require_not_negative(emitted_cd_m2, "furnace: the emitted luminance is negative or not finite");
    require(reflectance >= 0 && reflectance < 1, "furnace: the reflectance is not from 0 to less than 1");
    return emitted_cd_m2 / (1 - reflectance);
}

double furnace_illuminance_lx(double emitted_cd_m2, double reflectance) {
    return std::numbers::pi * furnace_luminance_cd_m2(emitted_cd_m2, reflectance);
}

}  // namespace stilb::exact
