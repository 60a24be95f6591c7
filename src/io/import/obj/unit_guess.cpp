// The rules were chosen by 820 models of furniture, whose catalogue states their sizes: see docs/import.md.
#include "io/import/obj/unit_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/vec.h"

namespace stilb::io {
namespace {

struct Unit {
    std::string_view name;
    double metres;
    double points;  ///< the more usual, the more
};
constexpr std::array kUnits{Unit{"metres", 1, 0.6}, Unit{"millimetres", 1e-3, -0.2},
                            Unit{"centimetres", 1e-2, 0.8}, Unit{"inches", 0.0254, -1.8},
                            Unit{"feet", 0.3048, -2.4}};
constexpr double kLowestStorey_m = 2.2, kHighestStorey_m = 4;
/// Longer models are likely to have another unit.
constexpr double kLongest_m = 200;
constexpr double kLowestDoor_m = 1.85, kHighestDoor_m = 2.5;

std::size_t axis_of(UpAxis up) { return up == UpAxis::z ? 2 : 1; }
std::string_view name_of(UpAxis up) { return up == UpAxis::z ? "z" : "y"; }

bool names_a_door(std::string name) {
    std::ranges::transform(name, name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return name.find("door") != name.npos && name.find("doorway") == name.npos &&
           name.find("outdoor") == name.npos && name.find("indoor") == name.npos;
}

struct Heights {
    double least = kLargestCoordinate, most = -kLargestCoordinate;

    void include(double value) { least = std::min(least, value), most = std::max(most, value); }
};

/// Heights of the groups that are named as doors, in units of the file.
std::vector<double> door_heights(const MeshFile& file, UpAxis up) {
    std::vector<Heights> extents(file.group_names.size());
    for (std::size_t t = 0; t < file.mesh.triangles.size(); ++t) {
        for (const std::uint32_t corner : file.mesh.triangles[t])
            extents[file.group_of_triangle[t]].include(file.mesh.vertices[corner][axis_of(up)]);
    }
    std::vector<double> heights;
    for (std::size_t g = 0; g < extents.size(); ++g) {
        const auto& [least, most] = extents[g];
        if (names_a_door(file.group_names[g]) && most > least) heights.push_back(most - least);
    }
    return heights;
}

/// The surfaces of a model in the box around it, in units of the file.
class ModelBox {
  public:
    explicit ModelBox(const MeshFile& file) {
        for (const Triangle& triangle : file.mesh.triangles) {
            for (const std::uint32_t corner : triangle) box_.include(file.mesh.vertices[corner]);
        }
        for (std::size_t t = 0; t < file.mesh.triangles.size(); ++t) add_area(file.mesh.corners_of(t));
    }

    Vec3 size() const { return box_.max - box_.min; }
    double longest() const { return std::max({size().x, size().y, size().z}); }

    /// With z upwards.
    Vec3 size_for(UpAxis up) const { return up == UpAxis::z ? size() : Vec3{size().x, size().z, size().y}; }

    /// Whether the model begins at 0 along an axis, as things that stand on the ground do.
    bool stands_at_zero(UpAxis up) const {
        constexpr double rounding = 1e-3;
        return std::abs(box_.min[axis_of(up)]) < rounding * longest() && box_.max[axis_of(up)] > 0;
    }

    /// Of the area across y or z, the share across this axis; a half where there is none.
    double level_share(UpAxis up) const {
        const double both = across_[1] + across_[2];
        return both > 0 ? across_[axis_of(up)] / both : 0.5;
    }

    /// How much of the box's bottom the model covers; more than 1 where faces lie above each other.
    double floor_cover(UpAxis up) const { return side_cover(axis_of(up), 0); }

    /// Whether it has a floor and walls, at least two of them.
    bool encloses(UpAxis up) const {
        constexpr double least_floor = 0.5, least_wall = 0.4;
        int walls = 0;
        for (const std::size_t axis : {std::size_t{0}, 3 - axis_of(up)})
            for (const std::size_t end : {0, 1}) walls += side_cover(axis, end) >= least_wall ? 1 : 0;
        return floor_cover(up) >= least_floor && walls >= 2;
    }

  private:
    void add_area(const std::array<Vec3, 3>& corners) {
        constexpr double kAcross = 0.996;  // cosine of 5 degrees
        constexpr double kNear = 0.05;     // of the box
        const auto& [a, b, c] = corners;
        const Vec3 doubled = cross(b - a, c - a);
        const double size = length(doubled);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!(std::abs(doubled[axis]) > kAcross * size)) continue;
            across_[axis] += size / 2;
            const double at = (a[axis] + b[axis] + c[axis]) / 3, near = kNear * this->size()[axis];
            if (at <= box_.min[axis] + near) side_[axis][0] += size / 2;
            if (at >= box_.max[axis] - near) side_[axis][1] += size / 2;
        }
    }

    double side_cover(std::size_t axis, std::size_t end) const {
        const double whole = size()[(axis + 1) % 3] * size()[(axis + 2) % 3];
        return whole > 0 ? side_[axis][end] / whole : 0;
    }

    Bounds box_;
    std::array<double, 3> across_{};
    std::array<std::array<double, 2>, 3> side_{};
};

/// What a model may be.
struct Kind {
    double points = 0;  ///< the more usual, the more
    std::string_view words;
    bool has_floors = false;  ///< its level faces are floors and ceilings
};

/// The most usual kind that a size fits. `encloses`: whether there are a floor and walls.
Kind kind_of(const Vec3& size_m, bool encloses, double floor_cover) {
    constexpr double kLongestRoom_m = 60, kLeastRoom_m = 1.5, kLeastBuilding_m = 3, kHighestBuilding_m = 30;
    constexpr double kWidestFurniture_m = 1, kLongestFurniture_m = 2.4, kFullFloor = 0.8;
    const double length_m = std::max(size_m.x, size_m.y), breadth_m = std::min(size_m.x, size_m.y);
    const double height_m = size_m.z, longest_m = std::max(length_m, height_m);
    if (longest_m > kLongest_m) return {};
    Kind best{0.2, "not longer than 200 m"};
    const auto may_be = [&](bool fits, const Kind& kind) {
        if (fits && kind.points > best.points) best = kind;
    };
    const bool is_storey = height_m >= kLowestStorey_m && height_m <= kHighestStorey_m;
    may_be(encloses && is_storey && breadth_m >= kLeastRoom_m && length_m <= kLongestRoom_m,
           {5.6, "as high as one storey (2.2 to 4 m)", true});
    const bool is_building = encloses && breadth_m >= kLeastBuilding_m && height_m > kHighestStorey_m &&
                             height_m <= kHighestBuilding_m && height_m <= 1.5 * breadth_m;
    may_be(is_building && length_m <= kLongestRoom_m, {4.4, "as high as a hall or some storeys", true});
    may_be(is_building, {3.4, "as high as a hall or some storeys", true});
    may_be(floor_cover >= kFullFloor && breadth_m >= kLeastBuilding_m && length_m <= kLongestRoom_m,
           {2.0, "a floor with things on it"});
    may_be(longest_m >= 0.3 && longest_m <= kLongestFurniture_m && breadth_m <= kWidestFurniture_m,
           {3.2, "as large as furniture"});
    may_be(longest_m >= 0.3 && longest_m <= 4, {2.4, "as large as furniture"});
    may_be(longest_m >= 0.03 && longest_m < 0.3, {1.6, "as large as small things"});
    may_be(longest_m > 4 && longest_m <= 30, {1.2, "as large as trees or vehicles"});
    return best;
}

struct Candidate {
    UpAxis up = UpAxis::y;
    double scale = 1;
    Kind kind;
    double points = 0;
};

std::string_view unit_of(double scale) {
    const auto unit = std::ranges::find(kUnits, scale, &Unit::metres);
    return unit == kUnits.end() ? "" : unit->name;
}

/// How usual a model of this kind with this axis is.
double points_of_axis(const ModelBox& box, UpAxis up, const Kind& kind) {
    constexpr double y_upwards = 1, y_upwards_of_rooms = 0.4, standing = 0.8, level_faces = 4.8, sheet = 2.5;
    const UpAxis other = up == UpAxis::y ? UpAxis::z : UpAxis::y;
    double points = 0;
    if (up == UpAxis::y) points += kind.has_floors ? y_upwards_of_rooms : y_upwards;
    if (kind.has_floors) points += level_faces * (box.level_share(up) - 0.5);
    if (box.stands_at_zero(up) && !box.stands_at_zero(other)) points += standing;
    if (box.size_for(up).z <= 0) points += sheet;
    return points;
}

Candidate best_of(const ModelBox& box, const ImportOptions& options) {
    std::optional<Candidate> best;
    const auto consider = [&](UpAxis up, double metres, double points) {
        const Kind kind = kind_of(metres * box.size_for(up), box.encloses(up), box.floor_cover(up));
        points += kind.points + points_of_axis(box, up, kind);
        if (kind.points > 0 && (!best || points > best->points)) best = {up, metres, kind, points};
    };
    for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
        if (options.up.value_or(up) != up) continue;
        if (options.scale) consider(up, *options.scale, 0);
        for (const Unit& unit : kUnits)
            if (!options.scale) consider(up, unit.metres, unit.points);
    }
    return best.value_or(Candidate{options.up.value_or(UpAxis::y), options.scale.value_or(1), {}});
}

std::string reason_of_up(const ModelBox& box, const Candidate& guess) {
    const UpAxis other = guess.up == UpAxis::y ? UpAxis::z : UpAxis::y;
    constexpr double clear_share = 0.75;
    const double share = box.level_share(guess.up);
    if (share < clear_share && box.stands_at_zero(guess.up) && !box.stands_at_zero(other)) {
        return fmt::format("because the model begins at {} = 0, as things that stand on the ground do",
                           name_of(guess.up));
    }
    if (guess.kind.has_floors || guess.up == UpAxis::z) {
        return fmt::format(
            "because {:.0f} % of the faces across y or z lie across {}, as floors and ceilings do",
            100 * share, name_of(guess.up));
    }
    return "because most OBJ files have y upwards";
}

std::string reason_of_scale(const Kind& kind) {
    if (kind.words.empty()) return "because in no usual unit the model is smaller than 200 m";
    return fmt::format("because the model is then {}", kind.words);
}

}  // namespace

PlacementGuess guess_placement(const MeshFile& file, const ImportOptions& options) {
    const ModelBox box(file);
    Candidate guess = best_of(box, options);
    PlacementGuess result;
    result.up = guess.up;
    result.up_reason = reason_of_up(box, guess);
    result.scale_reason = reason_of_scale(guess.kind);
    for (const double door : door_heights(file, guess.up)) {
        const auto fits = [&](const Unit& unit) {
            return door * unit.metres >= kLowestDoor_m && door * unit.metres <= kHighestDoor_m;
        };
        const auto unit = std::ranges::find_if(kUnits, fits);
        if (options.scale || unit == kUnits.end()) continue;
        guess.scale = unit->metres;
        result.scale_reason = fmt::format("because a door is then {:.3g} m high", door * unit->metres);
        break;
    }
    result.scale = guess.scale;
    result.unit = unit_of(guess.scale);
    result.size_m = guess.scale * box.size_for(guess.up);
    return result;
}

}  // namespace stilb::io
