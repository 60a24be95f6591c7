// The textures of a scene as small faces with a few colours of each texture (import.textures = true).
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/import/textures/texture_pieces.h"
#include "io/text/grouped_warnings.h"
#include "scene/scene.h"

namespace stilb::io {

class UniqueNames;

/// The texture of a material's faces.
struct FaceTexture {
    MaskedTexture texture;
    /// The material of a face with this colour of the texture, in place of that with its mean. It is not
    /// called where the texture shows no colours but cuts holes alone.
    std::function<Material(const Rgb& colour)> material;
};

struct SceneTextures {
    std::map<MaterialId, FaceTexture> of_material;
    /// For the objects with textures, meshes: the place of each triangle in the texture of its material.
    /// Triangles without a place keep their material.
    std::map<ObjectId, std::vector<FacePlace>> places;
};

/// The default suits textures that are shown.
struct TextureLimits {
    std::size_t faces_of_material = 200'000, faces = 2'000'000;  ///< about
    std::size_t colours_of_material = 256, colours = 32'768;
};

/// The name of a material of one colour of a texture: "wall (texture 17)".
std::string colour_name(std::string_view material, std::size_t number);
/// "wall" of such a name; empty where it is none.
std::string_view material_of_colour(std::string_view name);

/// Divides faces with textures, gives each the material of its colour (colour_name()), and leaves holes out.
/// Faces that touch them are divided as well, so that no gap opens. The mean colour over the surfaces of a
/// material stays that of its texture. `remarks`: a sentence about each texture.
void apply_textures(Scene& scene, const SceneTextures& textures, UniqueNames& names, GroupedWarnings& remarks,
                    GroupedWarnings& warnings, const TextureLimits& limits = {});

}  // namespace stilb::io
