// Results as values that can be kept elsewhere and made again: for Python's pickle.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "api/scene_data.h"
#include "base/rgb.h"
#include "io/image/picture.h"
#include "run/result.h"
#include "run/solve.h"
#include "scene/whites.h"
#include "stilb/measure.h"
#include "stilb/render.h"

namespace stilb::api {

/// What the document is made of when it is asked for, or the document.
struct Result::Data {
    struct Source {
        RunResult run;  ///< without the replicates
        std::string scene;
    };
    std::variant<Source, std::string> document;
};

struct Picture::Data {
    io::Picture picture;
    scene::WhiteRange white;
};

Result restored_result(const Summary& summary, std::vector<SensorResult> sensors, double confidence,
                       std::string json, std::vector<LightSceneResult> light_scenes);

/// A scene with its light.
struct Solution::Data {
    Scene scene;
    Summary summary;
    SolveResult result;
    int threads = 0;
};

struct StoredPicture {
    std::string exr;
    Rgb warmest, coolest;
};
StoredPicture stored(const Picture& picture);
/// Throws InputError where it is damaged.
Picture restored_picture(const Summary& summary, const StoredPicture& stored);

std::string stored(const Solution& solution);
/// With the precision of a solution's file. `scene`: the one that was solved. Throws InputError where the
/// bytes are damaged.
Solution restored_solution(const Scene& scene, const Summary& summary, std::string_view bytes);

}  // namespace stilb::api
