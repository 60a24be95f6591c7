// Textures of glTF: their pictures, their places on surfaces and their means.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/import/gltf/gltf_nodes.h"
#include "io/import/textures/texture_pieces.h"

namespace stilb::io::gltf {

/// From the texture coordinates of a vertex to those in the picture (KHR_texture_transform).
struct UvTransform {
    double offset_u = 0, offset_v = 0, scale_u = 1, scale_v = 1, rotation = 0;
    std::size_t set = 0;  ///< of texture coordinates: TEXCOORD_0 ...

    Uv operator()(const Uv& uv) const;
};
UvTransform uv_transform(const tinygltf::TextureInfo& info);

/// The texture coordinates of a triangle; no_place() where the primitive has none in this set.
FacePlace place_of(const PlacedPrimitive& primitive, std::size_t triangle, const UvTransform& transform);

/// Points that lie evenly on all surfaces of one material, by area.
class SurfacePoints {
  public:
    SurfacePoints(const std::vector<PlacedPrimitive>& primitives, int material);
    /// Their texture coordinates; empty where a surface has none.
    std::vector<Uv> uv(const UvTransform& transform) const;
    /// Leaves points in holes out. Returns the share of the others; 1 where a surface has no texture
    /// coordinates.
    double leave_holes_out(const MaskedTexture& mask, const UvTransform& transform);

  private:
    struct Face {
        const PlacedPrimitive* primitive;
        std::uint32_t triangle;
    };
    std::vector<Face> faces_;
    std::vector<PointOfTriangle> points_;
};

class Textures {
  public:
    Textures(File& file, GroupedWarnings& warnings) : file_(file), warnings_(warnings) {}

    /// Nothing where there is no texture, or it cannot be read (which is a warning).
    std::optional<TextureMap> map_of(const tinygltf::TextureInfo& info, const std::string& part);
    /// The means of red, green, blue and alpha (from 0 to 1) of a texture over the surface; ones where there
    /// is none, `unread` where it cannot be read.
    std::array<double, 4> mean(const tinygltf::TextureInfo& info, Texels texels, const SurfacePoints& surface,
                               const std::string& part, const std::array<double, 4>& unread = {1, 1, 1, 1});

  private:
    std::shared_ptr<const Texture> picture_of(int index, const std::string& part);
    std::string content_of(const tinygltf::Image& image, const std::string& part);

    File& file_;
    GroupedWarnings& warnings_;
    std::map<int, std::shared_ptr<const Texture>> pictures_;  ///< by image
};

}  // namespace stilb::io::gltf
