// The common part of the readers of luminaire files: lines, numbers, names, lists of angles, symmetry.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/photometry/photometry_file.h"
#include "io/text/text.h"
#include "io/text/utf8.h"
#include "stilb/error.h"

namespace stilb::io {

/// The lines without their ends (CR LF, LF or CR), without a byte order mark and the end-of-file mark of DOS.
std::vector<std::string_view> split_lines(std::string_view content);

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

/// Puts the numbers times `factor` into the grid. Negative ones that are small against the largest are noise
/// of the measurement: they become 0, with a warning. Throws InputError where one is more negative than that,
/// where all are 0, and where one is too large.
void set_intensities(PhotometricSolid::Grid& grid, const std::vector<LocatedNumber>& numbers, double factor,
                     const std::string& file, std::vector<std::string>& warnings);

/// Adds a warning where the angles begin at none of `first` or end at none of `last`: the directions beyond
/// them are dark then. `what` names the angles, `format` what wants them so.
void check_range(const std::vector<double>& angles_deg, std::span<const double> first,
                 std::span<const double> last, std::string_view what, std::string_view format,
                 std::vector<std::string>& warnings);

/// Appends the mirror images of the planes about the last plane (without that plane itself).
void mirror_at_last_plane(PhotometricSolid::Grid& grid);

/// Prepends the mirror images of the planes about the first plane, which is at 0.
void mirror_at_first_plane(PhotometricSolid::Grid& grid);

/// Appends the first plane again, one turn on, where it is missing.
void close_circle(PhotometricSolid::Grid& grid);

/// Equality up to the rounding of angles in files.
bool same_angle(double a_deg, double b_deg);

}  // namespace stilb::io
