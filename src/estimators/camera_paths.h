// What the methods have in common that trace pictures from the camera.
#pragma once

#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "transport/path_tracer.h"

namespace stilb::estimators {

/// What of a pass's key the pixels' own numbers are derived by; other purposes take other numbers.
inline constexpr std::uint64_t kPixels = 1;

struct Pixel {
    int x = 0, y = 0;
};

/// Paths that stand on what pixels see. The emission that is seen is in their luminances.
struct CameraPaths {
    std::vector<transport::Path> paths;
    std::vector<std::size_t> pixels;  ///< of each path: which of the pixels asked for
    /// Pixels that look out of the scene, and the light that comes from there.
    struct Outside {
        std::size_t pixel = 0;
        Rgb luminance_cd_m2;
    };
    std::vector<Outside> outside;

    /// Writes what the paths have gathered and what comes from outside, and 0 for the others of
    /// `luminances_cd_m2`, one for each pixel asked for. Returns the number that were not finite: these are
    /// 0.
    std::uint64_t write_to(std::span<Rgb> luminances_cd_m2) const;
};

/// Keeps references to the scene, its ray caster and the lights. Immutable.
struct PictureTracing {
    /// Of the problem's camera. `lights`: all that shine on what is seen.
    PictureTracing(const Problem& problem, const transport::LightSampler& lights);

    /// One path for each pixel that sees something, along a ray drawn by the camera's filter.
    CameraPaths start_paths(std::span<const Pixel> pixels, const Pass& pass) const;

    const Scene& scene;
    const rays::RayCaster& caster;
    Camera camera;
    sensors::CameraView view;
    int max_reflections;
    const transport::LightSampler& lights;
    transport::PathTracer tracer;
};

/// The pixels of a block, row by row.
std::vector<Pixel> pixels_of(const PixelBlock& block);

}  // namespace stilb::estimators
