// Light that goes on as if there were nothing: through the holes of a fabric, or a thin sheet.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/model.h"

namespace stilb::materials {

/// A lobe of composed materials. The rest of the light is that of other lobes.
///
/// Holes of a fabric narrow towards grazing angles and close at a cut-off angle. By measurements on fabrics
/// of an openness A [Kotey, Wright, Collins 2009, Determining off-normal solar optical properties of roller
/// blinds, ASHRAE Transactions 115(1)]: cos^b(90 deg theta / cut-off), cut-off = 90 deg - 25 deg c, b = 0.6
/// c^0.3, c = cos(90 deg A). An openness of 1 is the same share at all angles.
struct Straight {
    Rgb transmittance;    ///< along the normal
    double openness = 1;  ///< of the fabric

    static constexpr std::string_view kType = "straight";
    static constexpr auto fields() {
        return std::tuple{
            Field{"transmittance", &Straight::transmittance, kReflectance, "share of the light that goes on"},
            Field{"openness", &Straight::openness, kReflectance, "share of the area that is holes"}};
    }

    SpecularBranches branches(LightSide, const Vec3& in) const {
        SpecularBranches branches;
        branches.add({-in, straight_transmittance(in.z)});
        return branches;
    }
    Rgb straight_transmittance(double cosine) const {
        if (openness >= 1) return transmittance;
        // Angles are shares of a right angle.
        constexpr double kRightAngle = std::numbers::pi / 2;
        const double c = std::cos(kRightAngle * openness), cut_off = 1 - 25. / 90 * c;
        const double angle = std::acos(std::min(cosine, 1.0)) / kRightAngle;
        if (angle >= cut_off) return {};
        return transmittance * std::pow(std::cos(kRightAngle * angle / cut_off), 0.6 * std::pow(c, 0.3));
    }
    Rgb reflectance_bound() const { return transmittance; }
};

}  // namespace stilb::materials
