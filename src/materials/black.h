// The surface that absorbs all light.
#pragma once

#include "materials/model.h"

namespace stilb::materials {

/// Reflects nothing.
struct Black {
    static constexpr std::string_view kType = "black";
    static constexpr auto fields() { return std::tuple{}; }

    Rgb brdf_per_sr(const Vec3&, const Vec3&) const { return {}; }
    double pdf_per_sr(const Vec3&, const Vec3&) const { return 0; }
    ScatterValue evaluate(const Vec3&, const Vec3&) const { return {}; }
    std::optional<ScatterSample> sample(const Vec3&, double, double) const { return std::nullopt; }
    double concentration() const { return 0; }
    Rgb reflectance_bound() const { return {}; }
};

}  // namespace stilb::materials

namespace stilb {
using materials::Black;
}  // namespace stilb
