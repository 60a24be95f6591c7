// The reader of Radiance pictures: any bytes give an InputError, or a picture that can be written again.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "io/image/picture_file.h"
#include "stilb/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    stilb::io::Picture picture;
    try {
        picture = stilb::io::read_hdr({reinterpret_cast<const char*>(data), size}, "fuzzed");
    } catch (const stilb::InputError& error) {
        if (!std::string_view(error.what()).starts_with("fuzzed:")) std::abort();
        return 0;
    }
    for (std::size_t i = 0; i < picture.pixel_count(); ++i)
        if (!std::isfinite(picture.luminance_cd_m2(i))) std::abort();
    if (picture.pixel_count() < 10'000) stilb::io::read_hdr(stilb::io::to_hdr(picture), "written");
    return 0;
}
