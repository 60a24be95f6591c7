// The reader of surfaces by spherical harmonics: any contents give an InputError, or a series that is written
// as a file that gives the same.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "io/mesh/harmonics_file.h"
#include "math/spherical_harmonics.h"
#include "stilb/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view content(reinterpret_cast<const char*>(data), size);
    try {
        const stilb::io::HarmonicsFile file = stilb::io::parse_harmonics(content, "fuzzed");
        if (!is_finite(file.center)) std::abort();
        for (const double coefficient : file.coefficients) {
            if (!std::isfinite(static_cast<float>(coefficient))) std::abort();
        }
        const std::string text = stilb::io::to_text(file);
        if (stilb::io::to_text(stilb::io::parse_harmonics(text, "written")) != text) std::abort();
    } catch (const stilb::InputError& error) {
        if (!std::string_view(error.what()).starts_with("fuzzed:")) std::abort();
    }
    return 0;
}
