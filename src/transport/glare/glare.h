// The lamps that an eye sees, as sources of discomfort glare.
//
// Of each lamp, with V = 1 where the eye sees it, else 0 (panes: their transmittance):
//
//     w = integral of V dw,  L = integral of V L dw / w,  E = integral of V L cos+ dw,
//
// by points on the lamp. The Unified Glare Rating [CIE 117] needs sum L^2 w / p^2, with Guth's position index
// p; the background is all light at the eye but E.
#pragma once

#include <cstdint>
#include <vector>

#include "rays/ray_caster.h"
#include "sensors/measurand.h"
#include "transport/light_sampler.h"

namespace stilb::transport {

/// The largest position index that is tabulated.
inline constexpr double kMostPositionIndex = 16;
/// Guth's position index p of a source in a unit direction, for a unit line of sight that is not vertical; at
/// most kMostPositionIndex.
double position_index(const Vec3& direction, const Vec3& line_of_sight);

/// Whether the Unified Glare Rating counts a source in a unit direction: whether CIE 117's table of position
/// indices has an entry for it. With its distances R along the line of sight, T beside it, and H above or
/// below it: R is above 0, T / R at most 3, H / R at most 2, and the index below kMostPositionIndex.
bool is_in_field(const Vec3& direction, const Vec3& line_of_sight);

/// Solid angles [sr] for which the Unified Glare Rating was made.
inline constexpr double kLeastGlare_sr = 0.0003, kMostGlare_sr = 0.1;

struct GlareSource {
    std::uint32_t light = 0;  ///< of Scene::lights
    double solid_angle_sr = 0, luminance_cd_m2 = 0, position_index = 16;
    bool is_in_field = false;
    std::vector<double> glare_of_replicates;  ///< glare() by independent samples of the lamp

    /// L^2 w / p^2.
    double glare() const {
        return luminance_cd_m2 * luminance_cd_m2 * solid_angle_sr / (position_index * position_index);
    }
};

struct Glare {
    std::vector<GlareSource> sources;  ///< in front of the eye and seen by it
    std::vector<GlareSource> points;   ///< the same without a luminous area: their L and w are 0
    /// In front of the eye: objects that scatter the light that they let through, and so may glare
    /// themselves.
    std::vector<ObjectId> diffusers;
    /// The illuminance at the eye by all lamps, points included, by independent samples of them.
    std::vector<double> direct_of_replicates_lx;
};

/// `eye`: its normal is the line of sight. The light from infinity is background.
Glare find_glare(const MeasuringPoint& eye, const Scene& scene, const rays::RayCaster& caster,
                 const LightSampler& lights, math::RandomKey key, std::size_t replicates);

}  // namespace stilb::transport
