// The bright parts of a view, for the Daylight Glare Probability: a fisheye picture at the eye, and the sum
// over its bright pixels.
//
// The sum of L^2 w / p^2 over the pixels brighter than a threshold must not grow by noise, which raises the
// mean of L^2 and lifts pixels over the threshold. So the replicates of the picture are two halves: one
// selects the pixels, by the mean over a pixel and its neighbours, and the other gives them their luminances;
// then the other way round. L^2 is the mean product of two different replicates. A pixel that noise has
// selected thus counts with its true luminance, which is below the threshold, and not with that of the noise.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/monitor.h"
#include "rays/ray_caster.h"
#include "sensors/measurand.h"
#include "transport/glare/glare.h"

namespace stilb::run {

/// Of pictures.
inline constexpr std::size_t kGlareReplicates = 8;

/// A square picture of all that is in front of an eye, row by row from the top.
struct EyePicture {
    int width = 0;
    std::vector<double> solid_angles_sr;  ///< 0 outside of the circle of view
    std::vector<double> weights_sr;       ///< solid angle / p^2; 0 where a lamp is seen
    std::vector<std::array<float, kGlareReplicates>> luminances_cd_m2;  ///< of the replicates

    double mean_luminance_cd_m2() const;
};

/// What a picture is made with.
struct PictureSetting {
    const Scene& scene;
    const rays::RayCaster& caster;
    int max_reflections = 0;
    std::uint64_t seed = 0;
    const Monitor& monitor;
};
/// By method `auto`. Throws Cancelled where the monitor ends the run.
EyePicture picture_at(const MeasuringPoint& eye, const PictureSetting& setting);

/// The sum of L^2 w / p^2 over the pixels above the threshold, beside lamps: the pseudo-values of its
/// jackknife over the replicates, whose mean is the sum and whose spread tells its error.
std::array<double, kGlareReplicates> glare_above(const EyePicture& picture, double threshold_cd_m2);

}  // namespace stilb::run
