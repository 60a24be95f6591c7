// Textures of glTF as means over the surfaces that have them.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "io/image/texture_file.h"
#include "io/import/gltf/gltf_nodes.h"

namespace stilb::io::gltf {

/// Points that lie evenly on all surfaces of one material, by area.
class SurfacePoints {
  public:
    SurfacePoints(const std::vector<PlacedPrimitive>& primitives, int material);
    /// The texture coordinates of the points in a set; empty where a surface has none.
    std::vector<std::array<double, 2>> uv(std::size_t set) const;

  private:
    struct Point {
        const PlacedPrimitive* primitive;
        std::uint32_t triangle;
        std::array<double, 3> weights;  ///< barycentric
    };
    std::vector<Point> points_;
};

class Textures {
  public:
    Textures(File& file, GroupedWarnings& warnings) : file_(file), warnings_(warnings) {}

    /// The means of red, green, blue and alpha (from 0 to 1) of a texture over the surface; ones where there
    /// is none, or it cannot be read (which is a warning). `is_colour`: red, green and blue are stored by the
    /// tone curve of sRGB.
    std::array<double, 4> mean(const tinygltf::TextureInfo& info, bool is_colour,
                               const SurfacePoints& surface, const std::string& part);

  private:
    const Texture* texture_of(int index, const std::string& part);
    std::string content_of(const tinygltf::Image& image, const std::string& part);

    File& file_;
    GroupedWarnings& warnings_;
    std::map<int, Texture> textures_;  ///< by image
};

}  // namespace stilb::io::gltf
