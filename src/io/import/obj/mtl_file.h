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
    std::string file;  ///< as written; empty where there is none
    /// Of texture coordinates: -s, then -o.
    std::array<double, 2> scale{1, 1}, offset{0, 0};
    bool is_clamped = false;  ///< -clamp on
};

/// One material, with the values of the file. [Wavefront, Advanced Visualizer, appendix B5]
struct MtlMaterial {
    std::string name;
    Rgb diffuse = Rgb::grey(0.8);  ///< Kd
    Rgb specular;                  ///< Ks
    Rgb emission_cd_m2;            ///< Ke
    Rgb filter = Rgb::grey(1);     ///< Tf
    double exponent = 0;           ///< Ns
    double opacity = 1;            ///< by d and Tr
    std::optional<double> ior;     ///< Ni
    std::optional<int> illum;
    std::optional<double> roughness, metallic;  ///< Pr, Pm of later exporters
    MtlPicture diffuse_map, specular_map, emission_map, opacity_map;
    std::vector<std::string> remarks;  ///< sentences about what is left out or taken otherwise
    /// Whether bright materials of the file have the same Ks: then it is that of all materials, and no share
    /// of dark ones.
    bool has_usual_specular = false;
};

struct MtlLibrary {
    std::vector<MtlMaterial> materials;
    std::vector<std::string> remarks;  ///< about the file as a whole
};

/// What cannot be used is a remark: a material is known well enough without it.
MtlLibrary read_mtl(std::string_view content);

}  // namespace stilb::io
