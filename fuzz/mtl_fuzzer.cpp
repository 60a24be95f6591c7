// The reader of MTL files: any bytes give materials, or an InputError that names the file.
#include <cstdint>
#include <string_view>

#include "io/import/obj/mtl_file.h"
#include "mesh_promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace stilb;
    try {
        for (const io::MtlMaterial& material :
             io::read_mtl({reinterpret_cast<const char*>(data), size}, "fuzzed")) {
            require(material.opacity >= 0 && material.opacity <= 1);
            require(material.diffuse.is_finite() && material.diffuse.min() >= 0);
        }
    } catch (const InputError& error) {
        require(std::string_view(error.what()).starts_with("fuzzed:"));
    }
    return 0;
}
