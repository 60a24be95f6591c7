// Luminaire files: IES LM-63 and EULUMDAT.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scene/photometric_solid.h"

namespace stilb {

/// What a luminaire file says, in SI units. `grid.intensity_cd` is absolute: all factors of the file are in
/// it.
struct PhotometryFile {
    std::string format;       ///< "IES LM-63-2002", "EULUMDAT", ...
    std::string luminaire;    ///< name and manufacturer as given; may be empty
    bool absolute = false;    ///< absolute photometry: no lamp lumens are stated
    double lamp_flux_lm = 0;  ///< lamps x lumens, before output ratio; 0 where absolute
    /// Flux that the file states for the luminaire: what the integral of the distribution should give. 0:
    /// none is stated.
    double stated_flux_lm = 0;
    Vec3 opening_m;  ///< luminous opening: width (C90-C270 in IES), length (C0-C180), height; as stated,
                     ///< metres
    PhotometricSolid::Grid grid;
};

/// Reads by content, not by extension. Throws InputError naming file and line.
PhotometryFile read_photometry_file(const std::filesystem::path& path);

PhotometryFile read_ies(std::string_view content, const std::string& name);
PhotometryFile read_eulumdat(std::string_view content, const std::string& name);

}  // namespace stilb
