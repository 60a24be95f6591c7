// The OBJ reader: any bytes give a mesh that keeps its promises, or an InputError.
#include "mesh_promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    stilb::check_mesh_reader(stilb::io::read_obj, data, size);
    return 0;
}
