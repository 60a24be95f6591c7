#include "io/import/radiance/distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/import/radiance/words.h"
#include "io/import/radiance/xform.h"
#include "io/text/text.h"
#include "io/text/utf8.h"
#include "lights/emitter_elements.h"

namespace stilb::io::radiance {
namespace {

constexpr double kDegree = kPi / 180;
constexpr std::size_t kMostValues = 10'000'000;
/// The step across an edge of a distribution, where it falls to 0 [degrees].
constexpr double kEdgeDeg = 1e-5;
/// Of distributions that are sampled anew [degrees].
constexpr double kPlaneStepDeg = 2.5, kPolarStepDeg = 1;

class TableReader {
  public:
    TableReader(std::string_view content, const std::string& name) : words_(content), name_(name) {}

    Table read() && {
        Table table;
        const double dimensions = number();
        if (dimensions != 1 && dimensions != 2)
            fail(fmt::format("the table has {} dimensions. Allowed: 1 or 2.", dimensions));
        std::size_t count = 1;
        for (double d = 0; d < dimensions; ++d) {
            table.coordinates.push_back(coordinates());
            count *= table.coordinates.back().size();
            if (count > kMostValues) fail("the table has more than ten million values.");
        }
        for (; count > 0; --count) table.values.push_back(number());
        turn_upwards(table);
        return table;
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(message, {name_, words_.line()});
    }
    double number() {
        words_.skip_to_word();
        const auto word = words_.next();
        if (!word) fail("the table ends too early.");
        const auto value = parse_number(*word);
        if (!value) fail(fmt::format("found {} where a number is needed.", in_quotes(*word)));
        return *value;
    }
    /// "begin end count", or "0 0 count" and the values.
    std::vector<double> coordinates() {
        const double begin = number(), end = number(), count = number();
        if (!(count >= 2 && count <= kMostValues && count == std::floor(count)))
            fail(fmt::format("a dimension of {} values is not allowed. Allowed: 2 or more.", count));
        std::vector<double> result;
        for (double i = 0; i < count; ++i)
            result.push_back(begin == end ? number() : begin + (end - begin) * i / (count - 1));
        const bool rises = result[1] > result[0];
        for (std::size_t i = 1; i < result.size(); ++i) {
            if (result[i] == result[i - 1] || (result[i] > result[i - 1]) != rises)
                fail("the values of a dimension do not all increase, or all decrease.");
        }
        return result;
    }
    /// Coordinates that fall are turned round, with their values.
    static void turn_upwards(Table& table) {
        const std::size_t inner = table.coordinates.back().size();
        const std::size_t outer = table.values.size() / inner;
        const auto row = [&](std::size_t i) {
            return table.values.begin() + static_cast<std::ptrdiff_t>(i * inner);
        };
        if (table.coordinates.back()[1] < table.coordinates.back()[0]) {
            std::ranges::reverse(table.coordinates.back());
            for (std::size_t i = 0; i < outer; ++i) std::reverse(row(i), row(i + 1));
        }
        if (outer > 1 && table.coordinates.front()[1] < table.coordinates.front()[0]) {
            std::ranges::reverse(table.coordinates.front());
            for (std::size_t i = 0; i < outer / 2; ++i)
                std::swap_ranges(row(i), row(i + 1), row(outer - 1 - i));
        }
    }

    Words words_;
    const std::string& name_;
};

/// The interval of a coordinate and the share of its upper end; nothing outside.
struct Interval {
    std::size_t lower = 0;
    double share = 0;
};
std::optional<Interval> interval_at(const std::vector<double>& coordinates, double value) {
    constexpr double rounding = 1e-9;
    const double slack = rounding * (coordinates.back() - coordinates.front());
    if (!(value >= coordinates.front() - slack && value <= coordinates.back() + slack)) return std::nullopt;
    const auto above = std::upper_bound(coordinates.begin() + 1, coordinates.end() - 1, value);
    const auto lower = static_cast<std::size_t>(above - coordinates.begin()) - 1;
    const double share = (value - coordinates[lower]) / (coordinates[lower + 1] - coordinates[lower]);
    return Interval{lower, std::clamp(share, 0.0, 1.0)};
}

/// A triangle wave of the period 2 `size`: it rises from 0 to `size` and falls again.
double triangle(double value, double size) {
    const double rest = value - 2 * size * std::floor(value / (2 * size));
    return rest > size ? 2 * size - rest : rest;
}

}  // namespace

double Table::at(const std::vector<double>& point) const {
    const auto inner = interval_at(coordinates.back(), point.back());
    if (!inner) return 0;
    const std::size_t stride = coordinates.back().size();
    const auto along = [&](std::size_t row) {
        const double* const first = &values[row * stride + inner->lower];
        return std::lerp(first[0], first[1], inner->share);
    };
    if (coordinates.size() == 1) return along(0);
    const auto outer = interval_at(coordinates.front(), point.front());
    return outer ? std::lerp(along(outer->lower), along(outer->lower + 1), outer->share) : 0;
}

Table read_table(std::string_view content, const std::string& name) {
    return TableReader(content, name).read();
}

std::optional<Pattern::Coordinate> Pattern::coordinate_of(std::string_view text) {
    constexpr std::array<std::pair<std::string_view, Angle>, 10> names{{{"src_theta", Angle::theta},
                                                                        {"src_phi", Angle::phi},
                                                                        {"src_phi2", Angle::phi2},
                                                                        {"src_phi4", Angle::phi4},
                                                                        {"srcB_vert", Angle::vertical},
                                                                        {"srcB_vert2", Angle::vertical2},
                                                                        {"srcB_horiz", Angle::horizontal},
                                                                        {"srcB_horiz2", Angle::horizontal2},
                                                                        {"stilb_c", Angle::phi},
                                                                        {"stilb_gamma", Angle::theta}}};
    const std::size_t sign = std::min(text.find_first_of("+-"), text.size());
    const auto found =
        std::ranges::find(names, text.substr(0, sign), &std::pair<std::string_view, Angle>::first);
    if (found == names.end()) return std::nullopt;
    if (sign == text.size()) return Coordinate{found->second, 0};
    const auto offset = parse_number(text.substr(sign));
    if (!offset) return std::nullopt;
    return Coordinate{found->second, *offset};
}

double Pattern::angle_deg(Angle angle, const Vec3& w) {
    const double phi = std::atan2(w.y, w.x) / kDegree, turned = phi < 0 ? phi + 360 : phi;
    switch (angle) {
        case Angle::theta:
            return std::atan2(std::hypot(w.x, w.y), -w.z) / kDegree;
        case Angle::phi:
            return turned;
        case Angle::phi2:
            return triangle(turned, 180);
        case Angle::phi4:
            return triangle(turned, 90);
        case Angle::vertical:
            return std::atan2(w.x, -w.z) / kDegree;
        case Angle::vertical2:
            return std::abs(std::atan2(w.x, -w.z)) / kDegree;
        case Angle::horizontal:
            return std::atan2(-w.y, -w.z) / kDegree;
        case Angle::horizontal2:
            break;
    }
    return std::abs(std::atan2(-w.y, -w.z)) / kDegree;
}

/// Reads one brightdata. A pattern that is not supported is left out with a warning.
class Pattern::Reader {
  public:
    Reader(const Modifier& modifier, const Description& description, GroupedWarnings& warnings)
        : modifier_(modifier), description_(description), warnings_(warnings) {
        if (modifier.texts.size() < 4)
            fail("texts are missing. Needed: FUNCTION DATAFILE FUNCTIONFILE COORDINATE ...");
    }

    std::optional<Pattern> read(std::vector<std::filesystem::path>& sources) && {
        if (!read_coordinates()) {
            leave_out(
                "only the functions of source.cal, which ies2rad uses, and of luminaire.cal by Stilb are "
                "supported.");
            return std::nullopt;
        }
        if (!read_function()) {
            leave_out(fmt::format("the function {} is not supported.", in_quotes(modifier_.texts[0])));
            return std::nullopt;
        }
        read_axes();
        read_table_file(sources);
        return std::move(pattern_);
    }

  private:
    /// The function of tables that `stilb export` writes; its numbers are the axes of the luminaire.
    static constexpr std::string_view kOwn = "stilb_value";
    struct Function {
        std::string_view name;
        Correction correction;
        std::size_t numbers;  ///< that it needs
        bool is_multiplied;
    };
    static constexpr std::array kFunctions{
        Function{"corr", Correction::none, 0, true},     Function{"noop", Correction::none, 0, false},
        Function{"flatcorr", Correction::flat, 0, true}, Function{"boxcorr", Correction::box, 4, true},
        Function{"lboxcorr", Correction::box, 4, true},  Function{"cylcorr", Correction::cylinder, 3, true},
        Function{kOwn, Correction::none, 9, false}};

    [[noreturn]] void fail(const std::string& message) const {
        throw InputError(fmt::format("brightdata {}: {}", modifier_.name, message),
                         description_.where(modifier_.place));
    }
    void leave_out(std::string_view reason) const {
        warnings_.add(modifier_.type, modifier_.name,
                      fmt::format("it is left out, and its factor is 1: {}", reason));
    }

    /// The texts between the file of functions and the transforms.
    bool read_coordinates() {
        const std::string file = std::filesystem::path(modifier_.texts[2]).filename().string();
        if (file != (modifier_.texts[0] == kOwn ? "luminaire.cal" : "source.cal")) return false;
        for (next_ = 3; next_ < modifier_.texts.size() && !modifier_.texts[next_].starts_with("-"); ++next_) {
            const auto coordinate = coordinate_of(modifier_.texts[next_]);
            if (!coordinate) return false;
            pattern_.coordinates_.push_back(*coordinate);
        }
        return !pattern_.coordinates_.empty();
    }
    bool read_function() {
        const auto function =
            std::ranges::find(kFunctions, std::string_view(modifier_.texts[0]), &Function::name);
        if (function == kFunctions.end()) return false;
        const std::vector<double>& n = modifier_.numbers;
        if (n.size() < function->numbers) {
            fail(fmt::format("{} needs {} numbers, but {} were found.", function->name, function->numbers,
                             n.size()));
        }
        pattern_.correction_ = function->correction;
        if (function->is_multiplied && !n.empty()) pattern_.multiplier_ = n[0];
        if (function->correction == Correction::box) pattern_.size_ = {n[1], n[2], n[3]};
        if (function->correction == Correction::cylinder) pattern_.size_ = {n[1], n[2], 0};
        return true;
    }
    void read_axes() {
        Xform own;
        const auto transforms = std::span(modifier_.texts).subspan(next_);
        if (read_transforms(transforms, own) != transforms.size())
            fail(fmt::format("{} is no transform.", in_quotes(transforms.front())));
        geometry::Transform frame = compose(modifier_.frame, own.transform);
        if (modifier_.texts[0] == kOwn) {
            const std::vector<double>& n = modifier_.numbers;
            frame = compose(frame, {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {-n[6], -n[7], -n[8]}, {}});
        }
        if (!(frame.regularity() > 1e-3)) fail("its axes are not at right angles to each other.");
        pattern_.axes_ = {normalized(frame.x_axis), normalized(frame.y_axis), normalized(frame.z_axis)};
    }
    void read_table_file(std::vector<std::filesystem::path>& sources) {
        const std::filesystem::path path = find_file(description_, modifier_.place, modifier_.texts[1]);
        if (std::ranges::find(sources, path) == sources.end()) sources.push_back(path);
        pattern_.table_ = read_table(read_text_file(path), path.string());
        const std::size_t dimensions = pattern_.table_.coordinates.size();
        if (dimensions != pattern_.coordinates_.size()) {
            fail(fmt::format("the table {} has {} dimensions, but {} coordinates were found.",
                             modifier_.texts[1], dimensions, pattern_.coordinates_.size()));
        }
    }

    const Modifier& modifier_;
    const Description& description_;
    GroupedWarnings& warnings_;
    std::size_t next_ = 3;
    Pattern pattern_;
};

std::optional<Pattern> Pattern::read(const Modifier& modifier, const Description& description,
                                     GroupedWarnings& warnings, std::vector<std::filesystem::path>& sources) {
    return Reader(modifier, description, warnings).read(sources);
}

double Pattern::factor(const Vec3& leaving) const {
    const Vec3 w{dot(leaving, axes_.u), dot(leaving, axes_.v), dot(leaving, axes_.w)};
    std::vector<double> point;
    for (const Coordinate& c : coordinates_) point.push_back(angle_deg(c.angle, w) + c.offset);
    const double value = multiplier_ * table_.at(point);
    if (correction_ == Correction::box) {
        return value / (std::abs(w.x) * size_.y * size_.z + std::abs(w.y) * size_.x * size_.z +
                        std::abs(w.z) * size_.x * size_.y);
    }
    if (correction_ == Correction::cylinder) {
        const double side = std::sqrt(std::max(0.0, 1 - w.z * w.z));
        return value / (size_.x * size_.y * side + kPi / 4 * size_.x * size_.x * std::abs(w.z));
    }
    return value;
}

lights::LuminaireFrame Pattern::frame() const { return {axes_.u, axes_.v, -axes_.w}; }

std::vector<double> Pattern::planes_deg() const {
    if (coordinates_.back().angle != Angle::theta || coordinates_.back().offset != 0) return {};
    if (coordinates_.size() == 1) return {0};
    const auto [angle, offset] = coordinates_.front();
    if (angle != Angle::phi && angle != Angle::phi2 && angle != Angle::phi4) return {};
    std::vector<double> planes{0};
    const auto add = [&](double plane) {
        plane -= 360 * std::floor(plane / 360);
        planes.push_back(plane);
    };
    for (const double coordinate : table_.coordinates.front()) {
        const double phi = coordinate - offset;
        add(phi);
        if (angle != Angle::phi) add(-phi);
        if (angle == Angle::phi4) add(180 - phi), add(180 + phi);
    }
    std::ranges::sort(planes);
    constexpr double same = 1e-4;
    std::vector<double> distinct;
    for (const double plane : planes) {
        if ((distinct.empty() || plane - distinct.back() > same) && plane < 360 - same)
            distinct.push_back(plane);
    }
    distinct.push_back(360);
    return distinct;
}

namespace {

/// The surface of a lamp as a direction sees it.
class SeenSurface {
  public:
    explicit SeenSurface(const Shape& shape) : elements_(lights::emitter_elements(shape)) {}

    /// The projected area, or with a flat correction the area of the parts whose front is seen.
    double area_m2(const Vec3& leaving, bool is_projected) const {
        double sum = 0;
        for (const lights::EmitterElement& element : elements_) {
            const double cosine = element.normal ? dot(*element.normal, leaving) : 1;
            // Directions along the surface count as seen, so that an edge of the distribution can be there.
            if (cosine > -kAlong) sum += element.area_m2 * (is_projected ? std::max(cosine, 0.0) : 1);
        }
        return sum;
    }
    /// The normal of all parts; nothing where they differ.
    std::optional<Vec3> normal() const {
        for (const lights::EmitterElement& element : elements_) {
            if (!element.normal || dot(*element.normal, *elements_.front().normal) < 1 - kAlong)
                return std::nullopt;
        }
        return elements_.front().normal;
    }

  private:
    static constexpr double kAlong = 1e-9;
    std::vector<lights::EmitterElement> elements_;
};

/// Angles of polar directions with an edge, where the distribution falls to 0 on one side.
void add_edge(std::vector<double>& polar_deg, double edge) {
    for (const double angle : {edge - kEdgeDeg, edge, edge + kEdgeDeg}) {
        if (angle >= 0 && angle <= 180) polar_deg.push_back(angle);
    }
}

void sort_angles(std::vector<double>& angles) {
    std::ranges::sort(angles);
    constexpr double same = 2e-6;
    const auto repeated = [&](double a, double b) { return b - a < same; };
    angles.erase(std::unique(angles.begin(), angles.end(), repeated), angles.end());
}

std::vector<double> steps(double last, double step) {
    std::vector<double> result;
    for (double i = 0; i * step < last - step / 2; ++i) result.push_back(i * step);
    result.push_back(last);
    return result;
}

/// Whether the correction of a pattern divides by the projected area of the shape. `is_flat`: the shape is
/// flat, across the vertical of the pattern.
bool is_corrected_for(const Pattern& pattern, const Shape& shape, bool is_flat) {
    switch (pattern.correction()) {
        case Pattern::Correction::none:
            return std::holds_alternative<Sphere>(shape);
        case Pattern::Correction::flat:
            return is_flat;
        case Pattern::Correction::box:
        case Pattern::Correction::cylinder:
            break;
    }
    return !is_flat;
}

/// A frame about the axis of a cone.
lights::LuminaireFrame frame_around(const Vec3& axis) {
    const Frame frame = Frame::around(axis);
    return {frame.u, frame.v, axis};
}

}  // namespace

namespace {

/// Chooses the angles of the grid: those of a table whose correction is that of the shape, so that the
/// intensity is linear between them; else even steps.
void choose_angles(const Shape& shape, const std::vector<Pattern>& patterns, const std::optional<Cone>& cone,
                   const std::optional<Vec3>& normal, Emission& emission) {
    PhotometricSolid::Grid& grid = emission.grid;
    const bool is_vertical = normal && std::abs(dot(*normal, emission.frame.nadir)) > 1 - 1e-9;
    if (patterns.size() == 1 && !cone && is_corrected_for(patterns.front(), shape, is_vertical)) {
        grid.planes_deg = patterns.front().planes_deg();
        if (!grid.planes_deg.empty()) grid.polar_deg = patterns.front().polar_deg();
    }
    if (grid.polar_deg.empty()) {
        const bool is_round = patterns.empty() && (!normal || is_vertical);
        grid.planes_deg = is_round ? std::vector<double>{0} : steps(360, kPlaneStepDeg);
        grid.polar_deg = steps(180, kPolarStepDeg);
        if (cone) add_edge(grid.polar_deg, cone->half_angle_deg);
    }
    if (is_vertical && grid.polar_deg.front() <= 90 && grid.polar_deg.back() >= 90)
        add_edge(grid.polar_deg, 90);
    std::erase_if(grid.polar_deg, [](double angle) { return angle < 0 || angle > 180; });
    sort_angles(grid.polar_deg);
}

/// The unit vector at these angles.
Vec3 direction_at(const lights::LuminaireFrame& frame, double plane_deg, double polar_deg) {
    // A little off the poles, where the direction would not tell the plane.
    const double c = plane_deg * kDegree, gamma = std::clamp(polar_deg, 1e-7, 180 - 1e-7) * kDegree;
    return normalized(std::sin(gamma) * std::cos(c) * frame.c0 + std::sin(gamma) * std::sin(c) * frame.c90 +
                      std::cos(gamma) * frame.nadir);
}

bool is_outside(const Cone& cone, const Vec3& w) {
    return dot(w, cone.axis) < std::cos((cone.half_angle_deg + kEdgeDeg / 10) * kDegree);
}

}  // namespace

std::optional<Emission> emission_of(const Shape& shape, const std::vector<Pattern>& patterns,
                                    const std::optional<Cone>& cone) {
    const SeenSurface surface(shape);
    Emission emission;
    emission.frame = patterns.empty() ? frame_around(cone->axis) : patterns.front().frame();
    choose_angles(shape, patterns, cone, surface.normal(), emission);
    const bool is_flat = std::ranges::any_of(
        patterns, [](const Pattern& pattern) { return pattern.correction() == Pattern::Correction::flat; });
    PhotometricSolid::Grid& grid = emission.grid;
    double largest = 0;
    for (const double plane : grid.planes_deg) {
        for (const double polar : grid.polar_deg) {
            const Vec3 w = direction_at(emission.frame, plane, polar);
            double intensity = cone && is_outside(*cone, w) ? 0 : surface.area_m2(w, !is_flat);
            for (const Pattern& pattern : patterns) intensity *= std::max(pattern.factor(w), 0.0);
            grid.intensity_cd.push_back(intensity);
            largest = std::max(largest, intensity);
        }
    }
    if (!(largest > 0) || !std::isfinite(largest) || grid.polar_deg.size() < 2) return std::nullopt;
    return emission;
}

}  // namespace stilb::io::radiance
