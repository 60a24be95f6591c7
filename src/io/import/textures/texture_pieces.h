// Surfaces with textures as small pieces, each with the mean colour of its own part of the picture.
//
// Pieces are divided where their texture varies most, until each is nearly of one colour or about a texel, or
// until there are too many. An edge is halved in all triangles that share it, so that no ray passes between
// pieces, whatever their materials.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/shape.h"
#include "io/import/textures/texture_map.h"

namespace stilb::io {

/// A texture in which the picture's alpha may cut holes.
struct MaskedTexture {
    TextureMap map;
    double least_alpha = 0;  ///< of surface; texels of less are holes
    bool shows_colours = true;

    bool is_hole(const std::array<std::uint8_t, 4>& texel) const { return texel[3] / 255.0 < least_alpha; }
};

inline constexpr std::uint32_t kNoTexture = ~0u;

struct TexturedMesh {
    Mesh mesh;  ///< triangles that touch share their vertices, and there are no normals
    std::vector<std::uint32_t> textures;  ///< per triangle: its texture, or kNoTexture
    std::vector<FacePlace> places;        ///< per triangle: in its texture
};

/// A part of a triangle.
struct Piece {
    Triangle corners{};
    std::uint32_t parent = 0;  ///< the triangle of the mesh
    double area_m2 = 0;
    Rgb colour = {};            ///< mean of the texture where it is no hole, as shares of light
    double filled = 1;          ///< the share that is no hole
    double deviation = 0;       ///< standard deviation of the band (or the holes) that varies most
    double longest_texels = 0;  ///< the longest edge
};

struct TexturePieces {
    std::vector<Vec3> vertices;  ///< those of the mesh first
    std::vector<Piece> pieces;   ///< in the order of their parents; triangles without texture, too
    /// For each texture, the longest edge [m] of the pieces that vary although they are larger than a texel;
    /// 0 where there are none.
    std::vector<double> coarsest_m;
};

/// `most`: about how many pieces a texture may have.
TexturePieces divide_by_texture(const TexturedMesh& mesh, std::span<const MaskedTexture> textures,
                                std::size_t most);

/// The barycentric coordinates of a corner of a piece in its parent.
std::array<double, 3> place_in_parent(const TexturedMesh& mesh, const TexturePieces& all, const Piece& piece,
                                      std::size_t corner);

}  // namespace stilb::io
