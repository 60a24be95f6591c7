// EULUMDAT [Stockmar 1990]: one value per line.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/photometry/photometry_file.h"
#include "io/photometry/photometry_parts.h"
#include "io/text/text.h"

namespace stilb::io {
namespace {

class FieldReader {
  public:
    FieldReader(std::vector<std::string_view> lines, std::string file)
        : lines_(std::move(lines)), file_(std::move(file)) {}

    std::string_view text(std::string_view what) {
        if (next_ == lines_.size()) {
            throw InputError(fmt::format("the file ends where the {} should follow", what), here());
        }
        return trimmed(lines_[next_++]);
    }

    /// A number, whose decimal sign may be a comma; nothing where the line is none.
    std::optional<double> find_number(std::string_view what) {
        std::string with_point(text(what));
        std::replace(with_point.begin(), with_point.end(), ',', '.');
        return parse_number(with_point);
    }

    double number(std::string_view what) {
        const auto value = find_number(what);
        if (!value) {
            throw InputError(fmt::format("{} is not a number: the {} is expected here",
                                         in_quotes(trimmed(lines_[next_ - 1])), what),
                             here());
        }
        return *value;
    }

    /// The same, and `otherwise` where the line is blank: some programs leave out what they do not know.
    double number_or(double otherwise, std::string_view what) {
        if (next_ == lines_.size() || !trimmed(lines_[next_]).empty()) return number(what);
        ++next_;
        blank_.push_back(fmt::format("line {} ({}) as {}", next_, what, otherwise));
        return otherwise;
    }
    /// How the blank lines were read, in words.
    const std::vector<std::string>& blank() const { return blank_; }

    double positive_number(std::string_view what) { return above_zero(number(what), what); }

    double above_zero(double value, std::string_view what) const {
        if (!(value > 0)) {
            throw InputError(
                fmt::format("the {} is {}: this factor of the intensities must be above 0", what, value),
                here());
        }
        return value;
    }

    int whole_number(std::string_view what, int least, int greatest) {
        const double value = number(what);
        if (value != std::floor(value) || value < least || value > greatest) {
            throw InputError(fmt::format("the {} is {}: a whole number from {} to {} is required", what,
                                         value, least, greatest),
                             here());
        }
        return static_cast<int>(value);
    }

    /// The number of lines or groups of lines that follow: at most as many as the file has.
    std::size_t count(std::string_view what) {
        const int greatest = static_cast<int>(std::min<std::size_t>(lines_.size(), 100'000'000));
        return static_cast<std::size_t>(whole_number(what, 1, greatest));
    }

    std::vector<LocatedNumber> numbers(std::size_t count, std::string_view what) {
        if (count > lines_.size() - next_) {
            throw InputError(
                fmt::format("the file ends too early: {} lines are required for the {}, {} are left", count,
                            what, lines_.size() - next_),
                {file_, lines_.size()});
        }
        std::vector<LocatedNumber> result;
        for (std::size_t i = 0; i < count; ++i) {
            const double value = number(what);
            result.push_back({value, next_});
        }
        return result;
    }

    void skip(std::size_t count, std::string_view what) {
        for (std::size_t i = 0; i < count; ++i) text(what);
    }

    void expect_end() {
        for (; next_ < lines_.size(); ++next_) {
            if (const std::string_view rest = trimmed(lines_[next_]); !rest.empty()) {
                throw InputError(
                    fmt::format("{} follows the last intensity: the numbers of planes and angles allow "
                                "for no more",
                                in_quotes(rest)),
                    {file_, next_ + 1});
            }
        }
    }

    const std::string& file() const { return file_; }
    /// The position of the line read last.
    SourceLocation here() const { return {file_, next_}; }

  private:
    std::vector<std::string_view> lines_;
    std::string file_;
    std::size_t next_ = 0;
    std::vector<std::string> blank_;
};

/// Isym, the symmetry indicator of the file.
enum class Symmetry { None, Axis, PlaneC0, PlaneC90, BothPlanes };

/// The planes with stored intensities: those of a full turn from plane `first` on, cyclically.
struct StoredPlanes {
    std::size_t first, count;
};
StoredPlanes stored_planes(Symmetry symmetry, std::size_t planes) {
    switch (symmetry) {
        case Symmetry::None:
            return {0, planes};
        case Symmetry::Axis:
            return {0, 1};
        case Symmetry::PlaneC0:
            return {0, planes / 2 + 1};
        case Symmetry::PlaneC90:
            return {3 * planes / 4, planes / 2 + 1};  // C270 over C0 to C90
        case Symmetry::BothPlanes:
            break;
    }
    return {0, planes / 4 + 1};
}

/// The stored planes' angles, increasing over C360. They must start and end on the planes of symmetry.
std::vector<double> angles_of_stored(const std::vector<double>& turn, Symmetry symmetry,
                                     const SourceLocation& where) {
    const StoredPlanes stored = stored_planes(symmetry, turn.size());
    std::vector<double> angles;
    for (std::size_t i = stored.first; i < stored.first + stored.count; ++i) {
        const bool next_turn = i >= turn.size();
        angles.push_back(turn[next_turn ? i - turn.size() : i] + (next_turn ? 360 : 0));
    }
    if (symmetry == Symmetry::None || symmetry == Symmetry::Axis) return angles;
    const double first = symmetry == Symmetry::PlaneC90 ? 270 : 0;
    const double last = symmetry == Symmetry::BothPlanes ? 90 : first + 180;
    if (!same_angle(angles.front(), first) || !same_angle(angles.back(), last)) {
        throw InputError(fmt::format("symmetry {} stores {} of {} planes, here C{} to C{}: they should run "
                                     "from C{} to C{}",
                                     static_cast<int>(symmetry), stored.count, turn.size(), angles.front(),
                                     angles.back(), first, last),
                         where);
    }
    return angles;
}

void unfold(PhotometricSolid::Grid& grid, Symmetry symmetry) {
    switch (symmetry) {
        case Symmetry::Axis:
            return;
        case Symmetry::BothPlanes:
            mirror_at_last_plane(grid);
            [[fallthrough]];
        case Symmetry::PlaneC0:
        case Symmetry::PlaneC90:
            mirror_at_last_plane(grid);
            return;
        case Symmetry::None:
            break;
    }
    if (grid.planes_deg.size() > 1) close_circle(grid);
}

/// The luminous opening in metres; a round opening has a diameter and no width.
Vec3 read_opening(FieldReader& reader) {
    const auto metres = [&](std::string_view what) { return reader.number_or(0, what) / 1000; };
    const double length = metres("length of the luminous area");
    const double width = metres("width of the luminous area");
    double height = 0;
    for (const char* plane : {"C0", "C90", "C180", "C270"})
        height = std::max(height, metres(fmt::format("height of the luminous area at {}", plane)));
    if (width == 0) return {-length, -length, height};
    return {width, length, height};  // C0 lies across the luminaire's length
}

struct LampSet {
    bool absolute = false;
    double flux_lm = 0;
    std::optional<double> power_w;  ///< with ballasts
};

/// The first set of lamps; the further sets are alternatives.
LampSet read_lamp_sets(FieldReader& reader, std::vector<std::string>& warnings) {
    constexpr std::size_t kLinesPerSet = 6;
    const std::size_t sets = reader.count("number of sets of lamps");
    LampSet first;
    first.absolute = reader.whole_number("number of lamps", -1'000'000, 1'000'000) < 0;
    const std::string type = printable(reader.text("type of lamps"));
    first.flux_lm = reader.positive_number("total luminous flux of the lamps");
    reader.skip(2, "colour of the lamps");
    first.power_w = stated_power_w(reader.find_number("power of the lamps"));
    reader.skip(kLinesPerSet * (sets - 1), "data of the lamps");
    if (sets > 1) {
        warnings.push_back(
            fmt::format("the file has {} alternative sets of lamps: the first is used ({}, {} lm)", sets,
                        type, first.flux_lm));
    }
    return first;
}

}  // namespace

PhotometryFile read_eulumdat(std::string_view content, const std::string& name) {
    FieldReader reader(split_lines(content), name);
    PhotometryFile file;
    file.format = "EULUMDAT";
    const std::string manufacturer = printable(reader.text("company identification"));
    reader.skip(1, "type indicator");
    const auto symmetry = static_cast<Symmetry>(reader.whole_number("symmetry indicator", 0, 4));
    const std::size_t planes = reader.count("number of C planes");
    reader.number_or(0, "distance between C planes");
    const std::size_t rings = reader.count("number of intensities in each C plane");
    if (rings < 2) throw InputError("each plane has one intensity: two or more are required", reader.here());
    reader.number_or(0, "distance between the intensities of a C plane");
    reader.skip(1, "number of the measurement report");
    file.luminaire = printable(reader.text("luminaire name"));
    if (!file.luminaire.empty() && !manufacturer.empty()) file.luminaire += ", ";
    file.luminaire += manufacturer;
    reader.skip(6, "luminaire number, file name, date and dimensions");
    file.opening_m = read_opening(reader);
    reader.skip(1, "downward flux fraction");
    const double output_ratio = reader.number_or(0, "light output ratio") / 100;
    if (!(output_ratio >= 0)) {
        throw InputError(
            fmt::format("the light output ratio is {} %: it cannot be negative", 100 * output_ratio),
            reader.here());
    }
    const std::string_view factor = "conversion factor for luminous intensities";
    const double conversion = reader.above_zero(reader.number_or(1, factor), factor);
    if (const double tilt = reader.number_or(0, "tilt of the luminaire during measurement"); tilt != 0) {
        file.warnings.push_back(fmt::format(
            "the luminaire was tilted by {} degrees during the measurement: the angles are used as the "
            "file gives them, without correction",
            tilt));
    }
    const LampSet lamps = read_lamp_sets(reader, file.warnings);
    file.absolute = lamps.absolute;
    file.power_w = lamps.power_w;
    if (!lamps.absolute) file.lamp_flux_lm = lamps.flux_lm;
    file.stated_flux_lm = lamps.flux_lm * output_ratio;
    reader.skip(10, "direct ratios");

    const auto turn = checked_angles(reader.numbers(planes, "C angles"), "C angle", 0, 360, name);
    const SourceLocation planes_end = reader.here();
    file.grid.polar_deg = checked_angles(reader.numbers(rings, "gamma angles"), "gamma angle", 0, 180, name);
    file.grid.planes_deg = angles_of_stored(turn, symmetry, planes_end);
    const auto intensities = reader.numbers(file.grid.planes_deg.size() * rings, "intensities");
    reader.expect_end();
    if (!reader.blank().empty())
        file.warnings.push_back(fmt::format("blank lines are read: {}", fmt::join(reader.blank(), ", ")));
    set_intensities(file.grid, intensities, conversion * lamps.flux_lm / 1000, name, file.warnings);
    constexpr std::array first{0.0, 90.0}, last{90.0, 180.0};
    check_range(file.grid.polar_deg, first, last, "gamma angles", "EULUMDAT", file.warnings);
    unfold(file.grid, symmetry);
    return file;
}

}  // namespace stilb::io
