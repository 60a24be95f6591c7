// Luminance pictures, and solutions to make them from.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "stilb/options.h"
#include "stilb/result.h"
#include "stilb/scene.h"

namespace stilb::api {

/// A picture of a camera. Pixels run row by row from the top.
struct Picture : Summary {
    int width = 0, height = 0;
    std::vector<float> luminance_cd_m2;           ///< NaN where the camera shows nothing
    std::vector<float> standard_error_cd_m2;      ///< empty where the method knows none
    std::vector<std::array<float, 3>> rgb_cd_m2;  ///< linear Rec. 709

    /// By extension: .exr, .hdr or .png. Throws InputError where it cannot be written.
    void save(const std::filesystem::path& path) const;

    struct Implementation;
    std::shared_ptr<const Implementation> implementation;
};

/// Renders a camera; the name may be empty where the scene has one only. Without any target, for a minute.
Picture render(const Scene& scene, const std::string& camera = "", const Options& options = {},
               const Control& control = {});

/// The light of a scene, computed once for all views.
class Solution {
  public:
    /// The same scene as was solved; cameras may differ.
    Picture render(const Scene& scene, const std::string& camera = "", const Control& control = {}) const;
    const Summary& summary() const;

    struct Implementation;
    explicit Solution(std::shared_ptr<const Implementation> implementation);

  private:
    std::shared_ptr<const Implementation> implementation_;
};

/// Solves by method ray-bundle. Without any target, for a minute.
Solution solve(const Scene& scene, const Options& options = {}, const Control& control = {});

}  // namespace stilb::api
