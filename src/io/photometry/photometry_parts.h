// The common part of the readers of luminaire files: lines, numbers, names, lists of angles, symmetry.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/photometry/photometry_file.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {

/// The lines without their ends (CR LF, LF or CR), without a byte order mark and the end-of-file mark of DOS.
std::vector<std::string_view> split_lines(std::string_view content);

/// The text as printable UTF-8: invalid bytes are read as Latin-1, control characters become blanks.
std::string printable(std::string_view text);

/// A number of a file and its position.
struct LocatedNumber {
    double value = 0;
    std::size_t line = 0;
};

/// The power that a file states; 0 and less mean that it states none.
std::optional<double> stated_power_w(std::optional<double> number);

/// The numbers as angles. Throws InputError where they do not increase or leave [least, greatest] degrees;
/// `what` names one of them in messages.
std::vector<double> checked_angles(const std::vector<LocatedNumber>& numbers, std::string_view what,
                                   double least, double greatest, const std::string& file);

/// Puts the numbers times `factor` into the grid. Throws InputError where one is negative, where all
/// are 0, and where one is too large.
void set_intensities(PhotometricSolid::Grid& grid, const std::vector<LocatedNumber>& numbers, double factor,
                     const std::string& file);

/// Appends the mirror images of the planes about the last plane (without that plane itself).
void mirror_at_last_plane(PhotometricSolid::Grid& grid);

/// Prepends the mirror images of the planes about the first plane, which is at 0.
void mirror_at_first_plane(PhotometricSolid::Grid& grid);

/// Appends the first plane again, one turn on, where it is missing.
void close_circle(PhotometricSolid::Grid& grid);

/// Equality up to the rounding of angles in files.
bool same_angle(double a_deg, double b_deg);

}  // namespace stilb::io
