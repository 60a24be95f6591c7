// The reader of glTF: any bytes give a scene whose meshes keep their promises, or an InputError. Files beside
// the scene are not found.
#include <cstdint>
#include <string_view>

#include "io/import/gltf/gltf_scene.h"
#include "mesh_promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace stilb;
    static const io::ImportSettings settings({}, "fuzzed");
    try {
        const io::SceneFile file = io::read_gltf_scene({reinterpret_cast<const char*>(data), size},
                                                       "no-such-folder/fuzzed", settings);
        require(!file.scene.objects.empty());
        for (const Object& object : file.scene.objects) {
            const auto& mesh = std::get<Mesh>(object.shape);
            for (const Vec3& vertex : mesh.vertices) require(is_finite(vertex));
            for (const Triangle& triangle : mesh.triangles)
                for (const std::uint32_t corner : triangle) require(corner < mesh.vertices.size());
            require(object.materials.size() == 1 || object.materials.size() == mesh.triangles.size());
        }
    } catch (const InputError& error) {
        require(std::string_view(error.what()).find("fuzzed") != std::string_view::npos);
    }
    return 0;
}
