// What the fuzz targets of the two luminaire readers share.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "io/photometry/photometry_file.h"
#include "stilb/error.h"

namespace stilb {

/// What a reader accepts must make a solid, and sampling it must give unit directions of finite density.
inline void check_solid(const io::PhotometryFile& file) {
    const PhotometricSolid solid(file.grid);
    check_flux(file, solid.flux_lm()).description();
    for (const double u1 : {0.0, 0.3, 1 - 0x1p-53}) {
        for (const double u2 : {0.0, 0.5, 1 - 0x1p-53}) {
            const Vec3 direction = solid.sample_direction(u1, u2);
            if (!(std::abs(length(direction) - 1) < 1e-9) || !std::isfinite(solid.pdf_per_sr(direction)))
                std::abort();
        }
    }
}

inline int fuzz_photometry(io::PhotometryFile (*read)(std::string_view, const std::string&),
                           const std::uint8_t* data, std::size_t size) {
    io::PhotometryFile file;
    try {
        file = read(std::string_view(reinterpret_cast<const char*>(data), size), "input");
    } catch (const InputError&) {
        return 0;
    }
    check_solid(file);
    return 0;
}

}  // namespace stilb
