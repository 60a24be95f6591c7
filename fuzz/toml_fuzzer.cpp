// Scene files: whatever the text, a scene or an InputError.
#include <cstdint>
#include <string_view>

#include "io/scene/scene_file.h"
#include "stilb/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    // Without slashes, escaped ones included, paths stay in the directory, which is not there: no file is
    // read.
    constexpr std::string_view slashes[] = {"/", "002f", "002F"};
    for (const std::string_view slash : slashes)
        if (text.find(slash) != std::string_view::npos) return 0;
    try {
        stilb::io::read_scene(text, "scene.toml", "no-such-directory");
    } catch (const stilb::InputError&) {
    }
    return 0;
}
