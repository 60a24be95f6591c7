#include "io/import/radiance/generators.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

#include "io/text/text.h"

namespace stilb::io::radiance {
namespace {

double size_of(const std::string& text, std::string_view what) {
    const auto value = parse_number(text);
    if (!value || !(*value > 0 && *value <= 1e9))
        throw InputError(fmt::format("{} is no {}. Allowed: a number above 0.", in_quotes(text), what));
    return *value;
}

/// A box from the origin to `size`, its edges cut or rounded by `bevel`.
class BoxMaker {
  public:
    BoxMaker(const std::vector<std::string>& arguments, const Place& place, Collector& collector)
        : material_(arguments[0]), name_(arguments[1]), place_(place), collector_(collector) {
        for (std::size_t i = 0; i < 3; ++i) size_[i] = size_of(arguments[i + 2], "size of a box");
        read_options(arguments);
    }

    void run() {
        // The corners are numbered by bits: which of the three coordinates are at the upper end.
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const bool is_upper : {false, true}) add_face(axis, is_upper);
        }
        if (!(bevel_ > 0)) return;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (unsigned ends = 0; ends < 4; ++ends) add_edge(axis, (ends & 1) != 0, (ends & 2) != 0);
        }
        for (unsigned corner = 0; corner < 8; ++corner) add_corner(corner);
    }

  private:
    using Corner = std::array<double, 3>;

    void read_options(const std::vector<std::string>& arguments) {
        for (std::size_t i = 5; i < arguments.size(); ++i) {
            const std::string& option = arguments[i];
            const bool is_last = i + 1 == arguments.size();
            if (option == "-i") {
                is_inverted_ = true;
            } else if ((option == "-b" || option == "-r") && !is_last) {
                is_round_ = option == "-r";
                bevel_ = size_of(arguments[++i], "bevel");
            } else if (option == "-n" && !is_last) {
                ++i;  // the number of segments: rounded edges are cylinders here
            } else if (option != "-s") {
                throw InputError(
                    fmt::format("genbox: {} is not allowed here. Allowed: -i, -b BEVEL, -r RADIUS, -n "
                                "SEGMENTS, -s.",
                                in_quotes(option)));
            }
        }
        if (is_round_ && is_inverted_)
            throw InputError("genbox: -i together with -r is not supported. Allowed: one of both.");
        for (const double size : size_) {
            if (2 * bevel_ >= size)
                throw InputError("genbox: the bevel is not less than half of the size of the box.");
        }
    }

    double inner(std::size_t axis, bool is_upper) const { return is_upper ? size_[axis] - bevel_ : bevel_; }
    double outer(std::size_t axis, bool is_upper) const { return is_upper ? size_[axis] : 0; }

    /// Adds a flat face; `outwards` is about its normal.
    void add_polygon(std::vector<Corner> corners, const Corner& outwards) {
        const auto vector = [&](std::size_t i) { return Vec3{corners[i][0], corners[i][1], corners[i][2]}; };
        const Vec3 across = cross(vector(1) - vector(0), vector(2) - vector(0));
        const Vec3 out{outwards[0], outwards[1], outwards[2]};
        if ((dot(across, out) > 0) == is_inverted_) std::ranges::reverse(corners);
        std::vector<double> numbers;
        for (const Corner& corner : corners) numbers.insert(numbers.end(), corner.begin(), corner.end());
        add(SurfaceKind::polygon, std::move(numbers));
    }
    void add(SurfaceKind kind, std::vector<double> numbers) {
        collector_.add_surface(kind, fmt::format("{}.{}", name_, ++made_), material_, std::move(numbers),
                               place_);
    }

    void add_face(std::size_t axis, bool is_upper) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::vector<Corner> corners;
        for (const auto& [at_u, at_v] :
             {std::pair{false, false}, {true, false}, {true, true}, {false, true}}) {
            Corner& corner = corners.emplace_back();
            corner[axis] = outer(axis, is_upper);
            corner[u] = inner(u, at_u), corner[v] = inner(v, at_v);
        }
        Corner outwards{};
        outwards[axis] = is_upper ? 1 : -1;
        add_polygon(std::move(corners), outwards);
    }
    /// The edge along an axis, at the ends of the two others.
    void add_edge(std::size_t axis, bool at_u, bool at_v) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        Corner begin{}, end{};
        begin[axis] = inner(axis, false), end[axis] = inner(axis, true);
        begin[u] = end[u] = inner(u, at_u), begin[v] = end[v] = inner(v, at_v);
        if (is_round_) {
            return add(SurfaceKind::cylinder, {begin[0], begin[1], begin[2], end[0], end[1], end[2], bevel_});
        }
        std::vector<Corner> corners{begin, end, end, begin};
        corners[0][u] = corners[1][u] = outer(u, at_u);
        corners[2][v] = corners[3][v] = outer(v, at_v);
        Corner outwards{};
        outwards[u] = at_u ? 1 : -1, outwards[v] = at_v ? 1 : -1;
        add_polygon(std::move(corners), outwards);
    }
    void add_corner(unsigned bits) {
        Corner middle{};
        Corner outwards{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool is_upper = (bits >> axis & 1) != 0;
            middle[axis] = inner(axis, is_upper);
            outwards[axis] = is_upper ? 1 : -1;
        }
        if (is_round_) return add(SurfaceKind::sphere, {middle[0], middle[1], middle[2], bevel_});
        std::vector<Corner> corners(3, middle);
        for (std::size_t axis = 0; axis < 3; ++axis) corners[axis][axis] = outer(axis, outwards[axis] > 0);
        add_polygon(std::move(corners), outwards);
    }

    std::string material_, name_;
    Place place_;
    Collector& collector_;
    Corner size_{};
    double bevel_ = 0;
    bool is_round_ = false, is_inverted_ = false;
    int made_ = 0;
};

}  // namespace

void run_genbox(const std::vector<std::string>& arguments, const Place& place, Collector& collector) {
    if (arguments.size() < 5) {
        throw InputError(
            "arguments are missing. Needed: genbox MATERIAL NAME X Y Z [-i] [-b BEVEL | -r RADIUS].");
    }
    BoxMaker(arguments, place, collector).run();
}

}  // namespace stilb::io::radiance
