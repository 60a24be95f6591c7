// Luminaire files: IES LM-63 and EULUMDAT.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lights/photometric_solid.h"

namespace stilb::io {

/// The contents of a luminaire file, in SI units. `grid.intensity_cd` is absolute: all factors of the file
/// are applied. docs/photometry.md lists the numbers of the file that are used.
struct PhotometryFile {
    std::string format;       ///< "IES LM-63-2002", "EULUMDAT"
    std::string luminaire;    ///< name and manufacturer as given, in UTF-8; may be empty
    bool absolute = false;    ///< absolute photometry: no lamp lumens are stated
    double lamp_flux_lm = 0;  ///< of all lamps in their ballast, before output ratio; 0 where absolute
    /// Luminous flux of the luminaire as the file states it, to be compared with the integral of the
    /// distribution. 0: none is stated, as in all IES files.
    double stated_flux_lm = 0;
    /// The electric power of the luminaire, where the file states one above 0.
    std::optional<double> power_w = {};
    /// Luminous opening along C0-C180 and C90-C270, and its height; a negative extent means round.
    Vec3 opening_m;
    PhotometricSolid::Grid grid;
    /// Data of the file that are not applied (TILT factors ...), one sentence each.
    std::vector<std::string> warnings;
};

/// Selects the format by content, not by extension. Throws InputError with file and line.
PhotometryFile read_photometry_file(const std::filesystem::path& path);

/// The readers for content in memory; `name` is used in messages only. A PhotometricSolid accepts every
/// result of them.
PhotometryFile read_photometry(std::string_view content, const std::string& name);
PhotometryFile read_ies(std::string_view content, const std::string& name);
PhotometryFile read_eulumdat(std::string_view content, const std::string& name);

/// A distribution as a file in LM-63-2002, with absolute photometry and all digits. Precondition: its type is
/// C, and its planes begin at 0 (or it has one plane).
std::string to_ies(const PhotometricSolid::Grid& grid, std::string_view luminaire);

/// Comparison of the integral of a file's distribution with the flux that the file states.
struct FluxAgreement {
    enum class Classification {
        NothingStated,  ///< absolute photometry, or lamps of no stated flux
        Agrees,         ///< within kTolerance of the stated flux
        Differs,        ///< by more than that
        BelowLampFlux,  ///< only the lamps' flux is stated, and the luminaire emits no more than that
        AboveLampFlux,  ///< only the lamps' flux is stated, and the luminaire would emit more: impossible
    };
    /// Files round output ratios to a percent, and tabulate angles at steps of 5 degrees: differences of 1 %
    /// are usual.
    static constexpr double kTolerance = 0.02;

    Classification classification = Classification::NothingStated;
    double integral_lm = 0;
    double stated_lm = 0;  ///< of the luminaire, or of its lamps where only theirs is stated

    /// The result as text: "the integral, 512 lm, is 2.4 % above the stated 500 lm".
    std::string description() const;
};
FluxAgreement check_flux(const PhotometryFile& file, double integral_lm);

/// A sentence where the file's luminous opening is larger or smaller than that of any luminaire.
std::optional<std::string> opening_warning(const PhotometryFile& file);

/// The file's own warnings, and one where the stated flux and the integral of `solid` disagree.
std::vector<std::string> photometry_warnings(const PhotometryFile& file, const PhotometricSolid& solid);

}  // namespace stilb::io
