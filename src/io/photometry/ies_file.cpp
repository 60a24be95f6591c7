// IES LM-63 of 1986, 1991, 1995, 2002 and 2019.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/photometry/photometry_file.h"
#include "io/photometry/photometry_parts.h"
#include "io/text/text.h"

namespace stilb::io {
namespace {

constexpr double kMetresPerFoot = 0.3048;

/// The numbers below the TILT line: separated by blanks, commas and line ends in any order.
class NumberReader {
  public:
    NumberReader(const std::vector<std::string_view>& lines, std::size_t first, std::string file)
        : file_(std::move(file)), last_line_(lines.size()) {
        for (std::size_t i = first; i < lines.size(); ++i) {
            std::string_view rest = lines[i];
            while (true) {
                const std::size_t start = rest.find_first_not_of(kSeparators);
                if (start == std::string_view::npos) break;
                rest.remove_prefix(start);
                words_.push_back({rest.substr(0, rest.find_first_of(kSeparators)), i + 1});
                rest.remove_prefix(words_.back().text.size());
            }
        }
    }

    double number(std::string_view what) { return located_number(what).value; }

    /// A whole number of [least, greatest].
    int whole_number(std::string_view what, int least, int greatest) {
        const auto [value, line] = located_number(what);
        if (value != std::floor(value) || value < least || value > greatest) {
            throw InputError(fmt::format("the {} is {}: a whole number from {} to {} is required", what,
                                         value, least, greatest),
                             {file_, line});
        }
        return static_cast<int>(value);
    }

    /// The number of values that follow: at least one and, so that no memory is reserved for missing values,
    /// at most as many as the file still has.
    std::size_t count(std::string_view what) {
        const int greatest = static_cast<int>(std::min<std::size_t>(words_.size(), 100'000'000));
        return static_cast<std::size_t>(whole_number(what, 1, std::max(greatest, 1)));
    }

    std::vector<LocatedNumber> numbers(std::size_t count, std::string_view what) {
        if (count > left()) {
            throw InputError(
                fmt::format("the file ends too early: {} numbers are required for the {}, {} are left", count,
                            what, left()),
                {file_, last_line_});
        }
        std::vector<LocatedNumber> result;
        for (std::size_t i = 0; i < count; ++i) result.push_back(located_number(what));
        return result;
    }

    void expect_end() const {
        if (left() == 0) return;
        throw InputError(fmt::format("{} numbers more than the counts of angles allow, from {} on: either a "
                                     "count is wrong or there are surplus intensities",
                                     left(), in_quotes(words_[next_].text)),
                         {file_, words_[next_].line});
    }

    const std::string& file() const { return file_; }
    /// The position of the number read last.
    SourceLocation here() const { return {file_, next_ > 0 ? words_[next_ - 1].line : last_line_}; }

  private:
    struct Word {
        std::string_view text;
        std::size_t line;
    };
    static constexpr std::string_view kSeparators = " \t\v\f,";

    std::size_t left() const { return words_.size() - next_; }

    LocatedNumber located_number(std::string_view what) {
        if (left() == 0) {
            throw InputError(fmt::format("the file ends where the {} should follow", what),
                             {file_, last_line_});
        }
        const Word word = words_[next_++];
        const auto value = parse_number(word.text);
        if (!value) {
            throw InputError(
                fmt::format("{} is not a number: the {} is expected here", in_quotes(word.text), what),
                {file_, word.line});
        }
        return {*value, word.line};
    }

    std::string file_;
    std::size_t last_line_;
    std::vector<Word> words_;
    std::size_t next_ = 0;
};

/// The letters and digits of a line, in capitals: versions are spelled with all kinds of signs between them.
std::string letters_and_digits(std::string_view line) {
    std::string result;
    for (const char c : line) {
        if (c >= 'a' && c <= 'z') result += static_cast<char>(c - 'a' + 'A');
        if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) result += c;
    }
    return result;
}

/// Takes `word` off the front of `text`, if it is there.
bool take(std::string_view& text, std::string_view word) {
    const bool is_there = text.starts_with(word);
    if (is_there) text.remove_prefix(word.size());
    return is_there;
}

/// The year of the LM-63 version that the first line names in any spelling ("IESNA:LM-63-2002", "IESNA91",
/// "ANSI/IES LM-63-19"); files of 1986 have no such line.
int read_year(std::string_view first_line, std::vector<std::string>& warnings) {
    constexpr std::array<std::pair<std::string_view, int>, 10> kVersions{{{"1986", 1986},
                                                                          {"86", 1986},
                                                                          {"1991", 1991},
                                                                          {"91", 1991},
                                                                          {"1995", 1995},
                                                                          {"95", 1995},
                                                                          {"2002", 2002},
                                                                          {"02", 2002},
                                                                          {"2019", 2019},
                                                                          {"19", 2019}}};
    const std::string spelled = letters_and_digits(first_line);
    std::string_view rest = spelled;
    take(rest, "ANSI");
    const bool is_of_society = take(rest, "IESNA") || take(rest, "IES");
    const bool names_standard = take(rest, "LM63");
    if (is_of_society || names_standard) {
        for (const auto& [version, year] : kVersions) {
            if (rest == version) return year;
        }
    }
    const std::string_view line = trimmed(first_line);
    const bool is_header = line.starts_with("IESNA:") || line.starts_with("IES:");
    if (!is_header && spelled.find("LM63") == spelled.npos) return 1986;
    constexpr int kOtherwise = 2002;
    warnings.push_back(
        fmt::format("its first line, {}, names no known version of LM-63 (1986, 1991, 1995, "
                    "2002 or 2019): it is read as one of {}. Check the flux and the opening.",
                    in_quotes(line), kOtherwise));
    return kOtherwise;
}

/// The name from the keywords LUMINAIRE and MANUFAC; in files of 1986 from the first line.
std::string read_name(const std::vector<std::string_view>& lines, std::size_t tilt_line, int year) {
    std::string luminaire, manufacturer;
    const auto take = [](std::string_view line, std::string_view keyword, std::string& text) {
        if (text.empty() && line.starts_with(keyword)) text = printable(line.substr(keyword.size()));
    };
    for (std::size_t i = 0; i < tilt_line; ++i) {
        take(trimmed(lines[i]), "[LUMINAIRE]", luminaire);
        take(trimmed(lines[i]), "[MANUFAC]", manufacturer);
    }
    if (luminaire.empty() && year == 1986 && tilt_line > 0) luminaire = printable(lines[0]);
    if (manufacturer.empty() || luminaire.empty()) return luminaire + manufacturer;
    return luminaire + ", " + manufacturer;
}

/// The dependence of the lamp's output on the tilt of the luminaire against the measured position: checked,
/// but not used.
void skip_included_tilt(NumberReader& reader) {
    reader.whole_number("lamp-to-luminaire geometry of TILT", 1, 3);
    const std::size_t pairs = reader.count("number of TILT angles");
    checked_angles(reader.numbers(pairs, "angles of TILT"), "TILT angle", 0, 180, reader.file());
    for (const auto& [factor, line] : reader.numbers(pairs, "factors of TILT")) {
        if (factor < 0) {
            throw InputError(
                fmt::format("TILT factor {} is negative: it multiplies the lamp's output", factor),
                {reader.file(), line});
        }
    }
}

void read_tilt(std::string_view tilt, NumberReader& reader, std::vector<std::string>& warnings) {
    if (tilt == "NONE") return;
    if (tilt.empty()) throw InputError("TILT= must be NONE, INCLUDE or the name of a file", reader.here());
    if (tilt == "INCLUDE") skip_included_tilt(reader);
    warnings.push_back(fmt::format(
        "TILT={}: the dependence of the lamp's output on the tilt of the luminaire is ignored; the "
        "intensities are those of the measured position",
        printable(tilt)));
}

/// A positive number that multiplies the intensities.
double read_factor(NumberReader& reader, std::string_view what) {
    const double factor = reader.number(what);
    if (!(factor > 0)) {
        throw InputError(
            fmt::format("the {} is {}: it multiplies all intensities and must be above 0", what, factor),
            reader.here());
    }
    return factor;
}

/// The length, width and height of the luminous opening with the signs of LM-63-2002, where every extent of a
/// round outline is negative. Up to 1995 one sign makes an ellipse of the outline, 0 stands for an extent
/// that is the same as another, and with a negative height both make a sphere or an ellipsoid. What only the
/// older tables have is read so in newer files, too.
Vec3 in_signs_of_2002(const Vec3& opening, int year) {
    const double length = opening.x, width = opening.y, height = opening.z;
    const bool is_round = length < 0 || width < 0;
    if (height >= 0) {
        if (!is_round) return opening;
        const double diameter = std::max(std::abs(length), std::abs(width));
        const auto extent = [&](double number) { return number == 0 ? -diameter : -std::abs(number); };
        return {extent(length), extent(width), height};
    }
    if (!is_round) {
        // A horizontal tube, whose height is its diameter.
        if (width == 0 && length > 0) return {length, height, height};
        if (length == 0 && width > 0) return {height, width, height};
        return opening;
    }
    if (year >= 2002) return opening;
    const auto extent = [&](double number) { return number == 0 ? height : -std::abs(number); };
    return {extent(length), extent(width), height};
}

struct Header {
    int lamps = 0;
    double lumens_per_lamp = 0;
    double multiplier = 1;
    std::size_t vertical_angles = 0, horizontal_angles = 0;
    lights::PhotometryType type = lights::PhotometryType::C;
    Vec3 opening_m;
    double input_watts = 0;
    double ballast_factor = 1;  ///< times the ballast-lamp photometric factor of 1986 and 1991
};

Header read_header(NumberReader& reader, int year, std::vector<std::string>& warnings) {
    Header header;
    header.lamps = reader.whole_number("number of lamps", 0, 1'000'000);
    header.lumens_per_lamp = reader.number("lumens per lamp");
    if (header.lumens_per_lamp < 0 && header.lumens_per_lamp != -1) {
        throw InputError(
            fmt::format("the lumens per lamp are {}: a flux cannot be negative, and only -1 means "
                        "absolute photometry",
                        header.lumens_per_lamp),
            reader.here());
    }
    header.multiplier = read_factor(reader, "candela multiplier");
    header.vertical_angles = reader.count("number of vertical angles");
    header.horizontal_angles = reader.count("number of horizontal angles");
    constexpr std::array kTypes{lights::PhotometryType::C, lights::PhotometryType::B,
                                lights::PhotometryType::A};
    header.type = kTypes[static_cast<std::size_t>(
        reader.whole_number("photometric type (1: C, 2: B, 3: A)", 1, 3) - 1)];
    const double metres =
        reader.whole_number("unit of length (1: feet, 2: metres)", 1, 2) == 1 ? kMetresPerFoot : 1;
    const double width = reader.number("width of the luminous opening");
    const double length = reader.number("length of the luminous opening");
    const double height = reader.number("height of the luminous opening");
    header.opening_m = metres * in_signs_of_2002({length, width, height}, year);

    header.ballast_factor = read_factor(reader, "ballast factor");
    if (year < 1995) {
        header.ballast_factor *= read_factor(reader, "ballast-lamp photometric factor");
    } else if (const double reserved = reader.number("number after the ballast factor");
               year < 2019 && reserved != 1) {
        warnings.push_back(
            fmt::format("the number after the ballast factor is {}: LM-63-{} reserves it, so it "
                        "is not applied as a factor",
                        reserved, year));
    }
    header.input_watts = reader.number("input watts");
    return header;
}

/// Type C: planes over a quarter, half or whole turn, or one plane for all.
void unfold_turn(PhotometricSolid::Grid& grid, const SourceLocation& where) {
    const auto& planes = grid.planes_deg;
    if (planes.size() == 1) return;
    const double first = planes.front(), last = planes.back();
    if (same_angle(first, 0) && same_angle(last, 90)) mirror_at_last_plane(grid);
    const double turn = planes.back() - first;
    const bool half = same_angle(turn, 180) && same_angle(std::fmod(first, 90), 0);
    // Some programs omit the plane at 360.
    const bool open = same_angle(first, 0) && same_angle(360 - last, last - planes[planes.size() - 2]);
    if (half) {
        mirror_at_last_plane(grid);
    } else if (same_angle(turn, 360) || open) {
        close_circle(grid);
    } else {
        throw InputError(
            fmt::format("the horizontal angles run from {} to {}: type C allows 0 alone, 0 to 90, 0 to "
                        "180, 90 to 270 and 0 to 360",
                        first, last),
            where);
    }
}

/// Types A and B: horizontal angles from 0 on are mirrored at 0.
void unfold_sides(PhotometricSolid::Grid& grid, const SourceLocation& where) {
    if (grid.planes_deg.size() < 2) {
        throw InputError("there is one horizontal angle: types A and B require at least two", where);
    }
    if (grid.planes_deg.front() > 0) {
        throw InputError(
            fmt::format("the horizontal angles start at {}: types A and B start at 0 (symmetric) "
                        "or below",
                        grid.planes_deg.front()),
            where);
    }
    if (same_angle(grid.planes_deg.front(), 0)) mirror_at_first_plane(grid);
}

/// In type B the vertical angles are those of the rotation about an axis.
PhotometricSolid::Grid transposed(const PhotometricSolid::Grid& grid) {
    PhotometricSolid::Grid result{grid.type, grid.polar_deg, grid.planes_deg, {}};
    const std::size_t rings = grid.polar_deg.size();
    for (std::size_t ring = 0; ring < rings; ++ring) {
        for (std::size_t plane = 0; plane < grid.planes_deg.size(); ++plane) {
            result.intensity_cd.push_back(grid.intensity_cd[plane * rings + ring]);
        }
    }
    return result;
}

/// Angles and intensities, unfolded.
PhotometricSolid::Grid read_grid(NumberReader& reader, const Header& header,
                                 std::vector<std::string>& warnings) {
    struct Limits {
        double horizontal_least, horizontal_greatest, vertical_least, vertical_greatest;
    };
    const Limits limits = header.type == lights::PhotometryType::A   ? Limits{-180, 180, -90, 90}
                          : header.type == lights::PhotometryType::B ? Limits{-90, 90, -180, 180}
                                                                     : Limits{-90, 360, 0, 180};
    if (header.vertical_angles < 2) {
        throw InputError("there is one vertical angle: two or more are required", reader.here());
    }
    PhotometricSolid::Grid grid;
    grid.type = header.type;
    grid.polar_deg =
        checked_angles(reader.numbers(header.vertical_angles, "vertical angles"), "vertical angle",
                       limits.vertical_least, limits.vertical_greatest, reader.file());
    grid.planes_deg =
        checked_angles(reader.numbers(header.horizontal_angles, "horizontal angles"), "horizontal angle",
                       limits.horizontal_least, limits.horizontal_greatest, reader.file());
    const SourceLocation planes_end = reader.here();
    const auto intensities = reader.numbers(header.vertical_angles * header.horizontal_angles, "intensities");
    reader.expect_end();
    set_intensities(grid, intensities, header.multiplier * header.ballast_factor, reader.file(), warnings);
    constexpr std::array of_c{0.0, 90.0}, of_a_and_b{-90.0, 0.0}, last{90.0, 180.0};
    const bool is_c = header.type == lights::PhotometryType::C;
    check_range(grid.polar_deg, is_c ? of_c : of_a_and_b, std::span(last).first(is_c ? 2 : 1),
                "vertical angles", is_c ? "LM-63" : "LM-63, for types A and B,", warnings);
    if (header.type == lights::PhotometryType::C) {
        unfold_turn(grid, planes_end);
    } else {
        unfold_sides(grid, planes_end);
    }
    return header.type == lights::PhotometryType::B ? transposed(grid) : grid;
}

}  // namespace

PhotometryFile read_ies(std::string_view content, const std::string& name) {
    constexpr std::string_view kTilt = "TILT=";
    const auto lines = split_lines(content);
    const auto tilt = std::find_if(lines.begin(), lines.end(),
                                   [&](std::string_view line) { return trimmed(line).starts_with(kTilt); });
    if (tilt == lines.end()) {
        throw InputError("the line TILT= is missing; every IES file has it before its numbers",
                         {name, lines.size()});
    }
    const auto tilt_line = static_cast<std::size_t>(tilt - lines.begin());

    PhotometryFile file;
    const auto first = std::find_if_not(lines.begin(), tilt, [](auto line) { return trimmed(line).empty(); });
    const int year = read_year(*first, file.warnings);
    file.format = fmt::format("IES LM-63-{}", year);
    file.luminaire = read_name(lines, tilt_line, year);
    NumberReader reader(lines, tilt_line + 1, name);
    read_tilt(trimmed(trimmed(*tilt).substr(kTilt.size())), reader, file.warnings);
    const Header header = read_header(reader, year, file.warnings);
    file.absolute = header.lumens_per_lamp < 0;
    if (!file.absolute) file.lamp_flux_lm = header.lamps * header.lumens_per_lamp * header.ballast_factor;
    file.power_w = stated_power_w(header.input_watts);
    file.opening_m = header.opening_m;
    file.grid = read_grid(reader, header, file.warnings);
    return file;
}

}  // namespace stilb::io
