// Camera paths, the common part of the methods that trace pictures from the camera.
#pragma once

#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "transport/path_tracer.h"

namespace stilb::estimators {

struct Pixel {
    int x = 0, y = 0;
};

/// Camera paths at their first hit. The emission seen there is part of their luminances.
struct CameraPaths {
    std::vector<transport::Path> paths;
    std::vector<std::size_t> pixels;  ///< of each path: the index of its pixel among the requested ones
    /// Pixels whose ray leaves the scene, and the light that comes from there.
    struct Outside {
        std::size_t pixel = 0;
        Rgb luminance_cd_m2;
    };
    std::vector<Outside> outside;
    /// The parts of the luminance of each requested pixel; empty without channels.
    std::vector<transport::LightParts> parts;

    /// Adds the luminances of the paths and the light from outside; readings are the requested pixels.
    /// `channels`: those of the parts.
    void add_to(Tally& sums, const transport::Channels* channels = nullptr) const;
};

/// Keeps references to the scene, its ray caster and the lights. Immutable.
struct PictureTracing {
    /// For the problem's camera. `lights`: all lights that illuminate the first hits. `own_channels`: null
    /// for methods that do not divide their light.
    PictureTracing(const Problem& problem, const transport::LightSampler& lights,
                   const transport::Channels* own_channels = nullptr);

    /// One path for each pixel with a first hit, along a ray drawn by the camera's filter.
    CameraPaths start_paths(std::span<const Pixel> pixels, const Pass& pass) const;
    /// Traces such paths to their ends, and adds one luminance for each pixel.
    void trace(std::span<const Pixel> pixels, const Pass& pass, const transport::PathTracer& path_tracer,
               Tally& sums) const;

    const Scene& scene;
    const rays::RayCaster& caster;
    Camera camera;
    sensors::CameraView view;
    int max_reflections;
    const transport::Channels* channels;  ///< null where there are none
    const transport::LightSampler& lights;
    transport::PathTracer tracer;
};

/// The pixels of a block, row by row.
std::vector<Pixel> pixels_of(const PixelBlock& block);

}  // namespace stilb::estimators
