// The reader of Radiance scenes: any bytes give a scene or an InputError.
#include <cstdint>
#include <string_view>

#include "io/import/radiance/radiance_scene_file.h"
#include "stilb/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    // The folder is not there, and without slashes no file of another folder is named: no file is read.
    if (text.find('/') != text.npos) return 0;
    try {
        stilb::io::read_radiance_scene(text, "scene.rad", "no-such-directory", {}, {.primitives = 2000});
    } catch (const stilb::InputError&) {
    }
    return 0;
}
