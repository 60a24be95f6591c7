// Radiosity: the light of a diffuse scene, of all patches at once (theory 9, [LocalEstimation (2)]).
//
//     L_j = L*_j + (rho_j / pi) sum over sides i of pi L_i F_ij A_i / A_j
//
// solved by progressive shooting [Cohen, Chen, Wallace, Greenberg 1988], which is Southwell's relaxation: the
// sides with the most unshot flux send it to all sides that they see, until almost none is left. L* is the
// first reflection of the lights that first shot replaces, other area lights emit from their patches. Form
// factors are computed anew for every shot (patch_shots.h), none are stored. Each shot sends
//
//     omega = 2 / (1 + sqrt(1 - r^2)),    r the mean reflectance                                [Young 1954]
//
// times the unshot flux, so that light which is about to return is sent in advance; an excess remains
// as negative unshot flux. With r = 0.8 that takes half of the shots, with 0.95 less than a third [the idea:
// Feda and Purgathofer 1992]. Many sides shoot at a time, those with the most unshot flux: the same ones for
// any number of threads.
#pragma once

#include <cstdint>

#include "base/monitor.h"
#include "estimators/patch_light/patch_readings.h"

namespace stilb::estimators {

/// The magnitude of unshot flux that may remain, over the flux of the lights: in an evenly lit scene
/// the share of the light that is missing.
inline constexpr double kUnshotShare = 1e-4;

struct RadiositySolution {
    ReflectedSides light;  ///< without first shot
    std::uint64_t shots = 0;
    std::uint64_t rays = 0;
};

/// Uses all threads. The transport's first shot depends on no position (FirstShot::needs_position). Throws
/// InputError as item buffers do, and where reflectances so close to 1 prevent convergence; Cancelled where
/// user or time limit end the run.
RadiositySolution solve_radiosity(const PatchTransport& transport, const Monitor& monitor = Monitor::none());

}  // namespace stilb::estimators
