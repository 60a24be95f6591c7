// Octrees and compiled meshes of Radiance: any bytes give primitives and triangles, or an InputError.
#include <cstdint>
#include <string_view>

#include "io/import/radiance/compiled_files.h"
#include "stilb/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace stilb::io::radiance;
    const std::string_view content(reinterpret_cast<const char*>(data), size);
    try {
        files_of_octree(content, "scene.oct");
    } catch (const stilb::InputError&) {
    }
    try {
        Description description;
        description.files = {"scene.rad"};
        description.folders = {"."};
        Collector collector(description, {.primitives = 100'000});
        add_compiled_mesh(content, "mesh.rtm", {}, {}, collector);
    } catch (const stilb::InputError&) {
    }
    return 0;
}
