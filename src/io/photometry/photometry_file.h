// Luminaire files: IES LM-63 and EULUMDAT.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lights/photometric_solid.h"

namespace stilb::io {

/// What a luminaire file says, in SI units. `grid.intensity_cd` is absolute: all factors of the file are in
/// it. docs/photometry.md says which numbers those are.
struct PhotometryFile {
    std::string format;       ///< "IES LM-63-2002", "EULUMDAT"
    std::string luminaire;    ///< name and manufacturer as given, in UTF-8; may be empty
    bool absolute = false;    ///< absolute photometry: no lamp lumens are stated
    double lamp_flux_lm = 0;  ///< of all lamps in their ballast, before output ratio; 0 where absolute
    /// Flux that the file states for the luminaire: what the integral of the distribution should give. 0:
    /// none is stated, as in all IES files.
    double stated_flux_lm = 0;
    /// Luminous opening along C0-C180, along C90-C270, and its height; a negative extent means round.
    Vec3 opening_m;
    PhotometricSolid::Grid grid;
    /// What the file asks for and is not done (TILT factors ...), one sentence each.
    std::vector<std::string> warnings;
};

/// Reads by content, not by extension. Throws InputError naming file and line.
PhotometryFile read_photometry_file(const std::filesystem::path& path);

/// The readers themselves, on the file's content; `name` is used in messages only. What they return makes a
/// PhotometricSolid.
PhotometryFile read_photometry(std::string_view content, const std::string& name);
PhotometryFile read_ies(std::string_view content, const std::string& name);
PhotometryFile read_eulumdat(std::string_view content, const std::string& name);

/// Whether the integral of a file's distribution is the flux that the file states.
struct FluxAgreement {
    enum class Classification {
        NothingStated,  ///< absolute photometry, or lamps of no stated flux
        Agrees,         ///< within kTolerance of the stated flux
        Differs,        ///< by more than that
        BelowLampFlux,  ///< only the lamps' flux is stated, and the luminaire emits no more than that
        AboveLampFlux,  ///< only the lamps' flux is stated, and the luminaire would emit more: impossible
    };
    /// Files round output ratios to a percent, and interpolate between 5 degrees: 1 % is usual.
    static constexpr double kTolerance = 0.02;

    Classification classification = Classification::NothingStated;
    double integral_lm = 0;
    double stated_lm = 0;  ///< of the luminaire, or of its lamps where only that is stated

    /// For people: "the integral, 512 lm, is 2.4 % above the stated 500 lm".
    std::string description() const;
};
FluxAgreement check_flux(const PhotometryFile& file, double integral_lm);

/// The file's own warnings, and one where its flux and the integral of `solid` do not go together.
std::vector<std::string> photometry_warnings(const PhotometryFile& file, const PhotometricSolid& solid);

}  // namespace stilb::io
