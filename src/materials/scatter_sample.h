// What sampling a material gives.
#pragma once

#include "base/rgb.h"
#include "base/vec.h"

namespace stilb::materials {

/// A scattered direction and what the light is multiplied by: weight = f cos(theta_out) / pdf.
struct ScatterSample {
    Vec3 direction;
    Rgb weight;
    double pdf_per_sr = 0;
};

}  // namespace stilb::materials
