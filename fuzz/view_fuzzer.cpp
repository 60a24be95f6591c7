// The reader of view files: any bytes give a camera, or an InputError that names the file.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "io/import/view_file.h"
#include "mesh_promises.h"
#include "sensors/camera.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace stilb;
    try {
        const Camera camera =
            io::read_view_file({reinterpret_cast<const char*>(data), size}, "fuzzed").camera;
        require(camera.resolution[0] > 0 && camera.resolution[1] > 0);
        const auto middle =
            sensors::CameraView(camera).direction_at(0.5 * camera.resolution[0], 0.5 * camera.resolution[1]);
        require(middle && std::abs(length(*middle) - 1) < 1e-6);
    } catch (const InputError& error) {
        require(std::string_view(error.what()).starts_with("fuzzed:"));
    }
    return 0;
}
