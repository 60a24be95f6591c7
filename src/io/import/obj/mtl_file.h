// Materials of Wavefront MTL files.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/rgb.h"

namespace stilb::io {

/// A picture that multiplies a value, with the options of its statement.
struct MtlPicture {
    std::string file;  ///< empty where there is none
    /// Of texture coordinates: -s, then -o.
    std::array<double, 2> scale{1, 1}, offset{0, 0};
    bool is_clamped = false;  ///< -clamp on
};

/// One material, with the values of the file. [Wavefront, Advanced Visualizer, appendix B5]
struct MtlMaterial {
    std::string name;
    std::size_t line = 0;          ///< of its newmtl
    Rgb diffuse = Rgb::grey(0.8);  ///< Kd
    Rgb specular;                  ///< Ks
    Rgb emission_cd_m2;            ///< Ke
    Rgb filter = Rgb::grey(1);     ///< Tf
    double exponent = 0;           ///< Ns
    double opacity = 1;            ///< d, or 1 - Tr
    std::optional<double> ior;     ///< Ni
    std::optional<int> illum;
    std::optional<double> roughness, metallic;  ///< Pr, Pm of later exporters
    MtlPicture diffuse_map, specular_map, emission_map, opacity_map;
    std::vector<std::string> ignored;  ///< other statements
    /// Whether bright materials of the file have the same Ks: then it is that of all materials, and no share
    /// of dark ones.
    bool has_usual_specular = false;
};

/// Throws InputError with file and line for values that are missing or no numbers.
std::vector<MtlMaterial> read_mtl(std::string_view content, const std::string& name);

}  // namespace stilb::io
