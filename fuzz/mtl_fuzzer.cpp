// The reader of MTL files: any bytes give materials.
#include <cstdint>

#include "io/import/obj/mtl_file.h"
#include "mesh_promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace stilb;
    const io::MtlLibrary library = io::read_mtl({reinterpret_cast<const char*>(data), size});
    for (const io::MtlMaterial& material : library.materials) {
        require(material.opacity >= 0 && material.opacity <= 1);
        require(material.diffuse.is_finite() && material.diffuse.min() >= 0);
    }
    return 0;
}
