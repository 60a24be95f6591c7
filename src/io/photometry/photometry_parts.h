// What the two readers of luminaire files share: lines, numbers, names, lists of angles, symmetry.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/photometry/photometry_file.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {

/// The lines without their ends (CR LF, LF or CR), a byte order mark, or the end-of-file mark of DOS.
std::vector<std::string_view> split_lines(std::string_view content);

/// As UTF-8 that is safe to print: other bytes are taken for Latin-1, control characters become blanks.
std::string printable(std::string_view text);

/// A number of a file and where it stands.
struct LocatedNumber {
    double value = 0;
    std::size_t line = 0;
};

/// The numbers as angles. Throws InputError where they do not increase or leave [least, greatest] degrees;
/// `what` names one of them.
std::vector<double> checked_angles(const std::vector<LocatedNumber>& numbers, std::string_view what,
                                   double least, double greatest, const std::string& file);

/// Puts the numbers, which must not be negative, into the grid, times `factor`. Throws InputError also where
/// all are 0, or too large.
void set_intensities(PhotometricSolid::Grid& grid, const std::vector<LocatedNumber>& numbers, double factor,
                     const std::string& file);

/// Appends the planes' mirror images at the last plane (without that plane itself).
void mirror_at_last_plane(PhotometricSolid::Grid& grid);

/// Puts the planes' mirror images at the first plane, which is at 0, before it.
void mirror_at_first_plane(PhotometricSolid::Grid& grid);

/// Appends the first plane again, one turn on, where it is not there yet.
void close_circle(PhotometricSolid::Grid& grid);

/// Equal but for what rounding in a file's angles does.
bool same_angle(double a_deg, double b_deg);

}  // namespace stilb::io
