// Luminance pictures, and solutions: the light of a scene for all viewpoints.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stilb/measure.h"
#include "stilb/options.h"
#include "stilb/scene.h"

#pragma GCC visibility push(default)

namespace stilb::api {

/// Pixels row by row from the top; NaN where the camera shows nothing.
struct Picture : Summary {
    int width = 0, height = 0;
    std::vector<float> luminance_cd_m2;
    std::vector<float> standard_error_cd_m2;      ///< empty where it is not known
    std::vector<std::array<float, 3>> rgb_cd_m2;  ///< linear Rec. 709
    std::vector<float> depth_m;                   ///< of the surface in the pixel's middle; NaN where none is
    std::vector<std::array<float, 3>> normals;    ///< its unit normal, likewise

    /// Writes .exr, .hdr or .png, by the extension. Throws InputError where the file cannot be written.
    void save(const std::filesystem::path& path) const;

    struct Data;
    std::shared_ptr<const Data> data;
};

/// Renders a camera of the scene; its name may be left out where there is one only. Throws as measure().
Picture render(const Scene& scene, const std::string& camera = "", const std::optional<Options>& options = {},
               const Control& control = {});

/// The light on all surfaces of a scene, independent of the viewpoint. Immutable; copies share their data.
class Solution {
  public:
    /// Reads a solution's file, with its scene. Throws InputError where it is damaged, and where the scene
    /// was changed since.
    static Solution load(const std::filesystem::path& path);

    const Summary& summary() const;
    /// The names of the groups of lights that can be dimmed; lights without a group have their own name.
    std::vector<std::string> lights() const;
    /// A picture from the stored light, without new light transport; `factors` multiply the light of groups,
    /// band by band. Throws as render().
    Picture render(const std::string& camera = "", const Control& control = {},
                   const std::map<std::string, Triple>& factors = {}) const;
    /// Writes a file for `stilb render --from`. Throws InputError where the file cannot be written, and where
    /// the scene was built in code: the solution's file refers to the scene's.
    void save(const std::filesystem::path& path) const;

    struct Data;
    explicit Solution(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
    const Data& data() const { return *data_; }

  private:
    std::shared_ptr<const Data> data_;
};

/// Solves a scene by ray bundles, whatever the options' method. `degree`: of the directional basis that
/// stores the light on glossy surfaces, from 0 to 12; a higher one is sharper and takes more memory. Throws
/// as measure().
Solution solve(const Scene& scene, const std::optional<Options>& options = {}, const Control& control = {},
               const std::optional<int>& degree = {});

}  // namespace stilb::api

#pragma GCC visibility pop
