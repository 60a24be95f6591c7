// Small glTF files as text, for the tests of their reader.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/shape.h"
#include "io/import/gltf/gltf_scene.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {

/// A picture of a few texels, row by row from the top; each is red, green, blue and, if wanted, alpha. TGA
/// needs no compression.
template <std::size_t N>
std::string tga_of(int width, int height, const std::vector<std::array<std::uint8_t, N>>& texels) {
    std::string bytes(18, '\0');
    bytes[2] = 2;
    bytes[12] = static_cast<char>(width % 256), bytes[13] = static_cast<char>(width / 256);
    bytes[14] = static_cast<char>(height % 256), bytes[15] = static_cast<char>(height / 256);
    bytes[16] = 8 * N, bytes[17] = N == 4 ? 0x28 : 0x20;  // the first row is the top
    for (const auto& texel : texels) {
        for (const std::size_t c : {2, 1, 0}) bytes += static_cast<char>(texel[c]);
        if (N == 4) bytes += static_cast<char>(texel[3]);
    }
    return bytes;
}
inline std::string tga(int width, int height, const std::vector<std::array<std::uint8_t, 3>>& rgb) {
    return tga_of(width, height, rgb);
}

/// A glTF document: the buffer is kept in it as base64. Members are JSON without their enclosing brackets.
struct GltfText {
    std::string bytes;
    std::vector<std::string> views, accessors, meshes, materials, nodes, cameras, images, textures, samplers;
    std::string extensions;           ///< of the root: "\"X\": {...}"
    std::string scene_nodes = "all";  ///< indices of the scene's nodes

    int add_view(const void* data, std::size_t size) {
        views.push_back(
            fmt::format(R"({{"buffer": 0, "byteOffset": {}, "byteLength": {}}})", bytes.size(), size));
        bytes.append(static_cast<const char*>(data), size);
        bytes.resize((bytes.size() + 3) / 4 * 4);
        return static_cast<int>(views.size()) - 1;
    }
    template <typename T>
    int add_accessor(const std::vector<T>& numbers, std::size_t components, int component_type,
                     const std::string& more = "") {
        constexpr std::array kTypes{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
        const int view = add_view(numbers.data(), numbers.size() * sizeof(T));
        accessors.push_back(
            fmt::format(R"({{"bufferView": {}, "componentType": {}, "count": {}, "type": "{}"{}}})", view,
                        component_type, numbers.size() / components, kTypes[components], more));
        return static_cast<int>(accessors.size()) - 1;
    }
    int add_vectors(const std::vector<Vec3>& vectors) {
        std::vector<float> numbers;
        for (const Vec3& v : vectors)
            for (std::size_t axis = 0; axis < 3; ++axis) numbers.push_back(static_cast<float>(v[axis]));
        return add_accessor(numbers, 3, 5126);
    }
    /// A mesh of one primitive in the coordinates of glTF: y upwards. Returns the primitive's index.
    int add_mesh(const Mesh& mesh, int material, const std::string& more = "") {
        std::vector<std::uint32_t> indices;
        for (const Triangle& triangle : mesh.triangles)
            indices.insert(indices.end(), triangle.begin(), triangle.end());
        std::string attributes = fmt::format(R"("POSITION": {})", add_vectors(mesh.vertices));
        if (!mesh.normals.empty()) attributes += fmt::format(R"(, "NORMAL": {})", add_vectors(mesh.normals));
        meshes.push_back(fmt::format(R"({{"primitives": [{{"attributes": {{{}{}}}, "indices": {}{}}}]}})",
                                     attributes, more, add_accessor(indices, 1, 5125),
                                     material < 0 ? "" : fmt::format(R"(, "material": {})", material)));
        return static_cast<int>(meshes.size()) - 1;
    }
    /// A mesh of the primitives of two others.
    int join_meshes(int first, int second) {
        const auto primitive = [&](int mesh) {
            const std::string& text = meshes[static_cast<std::size_t>(mesh)];
            const std::size_t begin = text.find('[') + 1;
            return text.substr(begin, text.rfind(']') - begin);
        };
        meshes.push_back(fmt::format(R"({{"primitives": [{}, {}]}})", primitive(first), primitive(second)));
        return static_cast<int>(meshes.size()) - 1;
    }
    /// Returns the texture's index. `more`: of its members.
    int add_texture(const std::string& picture, const std::string& more = "") {
        const int view = add_view(picture.data(), picture.size());
        images.push_back(fmt::format(R"({{"bufferView": {}, "mimeType": "image/png"}})", view));
        textures.push_back(fmt::format(R"({{"source": {}{}}})", images.size() - 1, more));
        return static_cast<int>(textures.size()) - 1;
    }
    int add_node(const std::string& members) {
        nodes.push_back("{" + members + "}");
        return static_cast<int>(nodes.size()) - 1;
    }
    int add_material(const std::string& members) {
        materials.push_back("{" + members + "}");
        return static_cast<int>(materials.size()) - 1;
    }

    std::string text() const {
        std::string document = R"({"asset": {"version": "2.0"})";
        const auto list = [&](std::string_view key, const std::vector<std::string>& elements) {
            if (!elements.empty())
                document += fmt::format(",\n\"{}\": [{}]", key, fmt::join(elements, ",\n"));
        };
        list("bufferViews", views), list("accessors", accessors), list("meshes", meshes);
        list("materials", materials), list("nodes", nodes), list("cameras", cameras);
        list("images", images), list("textures", textures), list("samplers", samplers);
        if (!bytes.empty()) {
            list("buffers",
                 {fmt::format(R"({{"byteLength": {}, "uri": "data:application/octet-stream;base64,{}"}})",
                              bytes.size(), base64(bytes))});
        }
        if (!extensions.empty()) document += ",\n\"extensions\": {" + extensions + "}";
        if (scene_nodes != "all")
            document += fmt::format(",\n\"scenes\": [{{\"nodes\": [{}]}}]", scene_nodes);
        return document + "}";
    }
};

inline SceneFile read_gltf(const std::string& content, const std::vector<std::string>& overrides = {},
                           const std::filesystem::path& path = "s.gltf") {
    return read_gltf_scene(content, path, ImportSettings(overrides, path.string()));
}

/// The message with which the content is refused; "accepted" where it is not.
inline std::string gltf_refusal(const std::string& content, const std::filesystem::path& path = "s.gltf") {
    try {
        read_gltf(content, {}, path);
        return "accepted";
    } catch (const InputError& error) {
        return error.what();
    }
}

/// A square of 2 x 2 in the plane y = 0 of glTF, its front upwards.
inline Mesh gltf_square() {
    return {{{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}}, {{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace stilb::io
