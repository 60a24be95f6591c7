#include "io/import/obj/unit_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace stilb::io {
namespace {

struct Unit {
    std::string_view name;
    double metres;
    bool is_imperial = false;
};
/// The first of equally likely ones is taken.
constexpr std::array kUnits{Unit{"metres", 1}, Unit{"millimetres", 1e-3}, Unit{"centimetres", 1e-2},
                            Unit{"inches", 0.0254, true}, Unit{"feet", 0.3048, true}};
constexpr double kLowestStorey_m = 2.2, kHighestStorey_m = 4;
/// Longer scenes than this are likely to have another unit.
constexpr double kLongestInMetres = 200;
constexpr double kNarrowestRoom_m = 1.5;
constexpr double kLowestDoor_m = 1.85, kHighestDoor_m = 2.5;

double height_along(const Vec3& v, UpAxis up) { return up == UpAxis::z ? v.z : v.y; }

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
            extents[file.group_of_triangle[t]].include(height_along(file.mesh.vertices[corner], up));
    }
    std::vector<double> heights;
    for (std::size_t g = 0; g < extents.size(); ++g) {
        const auto& [least, most] = extents[g];
        if (names_a_door(file.group_names[g]) && most > least) heights.push_back(most - least);
    }
    return heights;
}

/// From 0 (impossible) on. `breadth_m`: the shorter horizontal side.
int likelihood(double height_m, double breadth_m) {
    if (breadth_m < kNarrowestRoom_m) return height_m >= 0.3 && height_m <= 60 ? 1 : 0;
    if (height_m >= kLowestStorey_m && height_m <= kHighestStorey_m) return 3;  // one storey
    if (height_m > kHighestStorey_m && height_m <= 60) return 2;                // several storeys, or a hall
    return height_m >= 0.3 && height_m < kLowestStorey_m ? 1 : 0;               // furniture
}

std::string words_for(int likelihood) {
    constexpr std::array<std::string_view, 4> kWords{"", "as furniture is", "as a hall or some storeys are",
                                                     "as one storey is (2.2 to 4 m)"};
    return std::string(kWords[static_cast<std::size_t>(likelihood)]);
}

/// The box around the triangles.
struct Extent {
    Vec3 least{kLargestCoordinate, kLargestCoordinate, kLargestCoordinate};
    Vec3 most{-kLargestCoordinate, -kLargestCoordinate, -kLargestCoordinate};

    Vec3 size() const { return most - least; }
    double longest() const { return std::max({size().x, size().y, size().z}); }
    /// Whether the model begins at 0 along an axis, as things that stand on the ground do.
    bool stands_at_zero(UpAxis up) const {
        constexpr double rounding = 1e-3;
        return std::abs(height_along(least, up)) < rounding * longest() && height_along(most, up) > 0;
    }
};
Extent extent_of_triangles(const MeshFile& file) {
    Extent extent;
    for (const Triangle& triangle : file.mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            const Vec3& v = file.mesh.vertices[corner];
            extent.least = {std::min(extent.least.x, v.x), std::min(extent.least.y, v.y),
                            std::min(extent.least.z, v.z)};
            extent.most = {std::max(extent.most.x, v.x), std::max(extent.most.y, v.y),
                           std::max(extent.most.z, v.z)};
        }
    }
    return extent;
}

std::string_view name_of(UpAxis up) { return up == UpAxis::z ? "z" : "y"; }

}  // namespace

UpGuess guess_up(const MeshFile& file) {
    constexpr double kAcross = 0.996;  // cosine of 5 degrees
    // Of a room of usual size it is about 0.65, as of furniture, in which other faces may be larger.
    constexpr double kClearShare = 0.75;
    double across_y = 0, across_z = 0;
    for (const auto& [a, b, c] : file.mesh.triangles) {
        const std::vector<Vec3>& v = file.mesh.vertices;
        const Vec3 area = cross(v[b] - v[a], v[c] - v[a]);
        const double size = length(area);
        if (std::abs(area.y) > kAcross * size) across_y += size;
        if (std::abs(area.z) > kAcross * size) across_z += size;
    }
    const UpAxis up = across_z > across_y ? UpAxis::z : UpAxis::y;
    const double both = across_y + across_z;
    if (!(both > 0))
        return {
            UpAxis::y,
            "up = \"y\", because no face is level in either direction, and most OBJ files have y upwards."};
    const double share = std::max(across_y, across_z) / both;
    const Extent extent = extent_of_triangles(file);
    const bool stands_on_y = extent.stands_at_zero(UpAxis::y), stands_on_z = extent.stands_at_zero(UpAxis::z);
    if (share < kClearShare && stands_on_y != stands_on_z) {
        const UpAxis standing = stands_on_z ? UpAxis::z : UpAxis::y;
        return {standing,
                fmt::format("up = \"{0}\", because the model begins at {0} = 0, as things that stand on the "
                            "ground do.",
                            name_of(standing))};
    }
    return {up, fmt::format(
                    "up = \"{}\", because {:.0f} % of the faces across y or z lie across {}, as floors and "
                    "ceilings do.",
                    name_of(up), 100 * share, name_of(up))};
}

ScaleGuess guess_scale(const MeshFile& file, UpAxis up) {
    for (const double door : door_heights(file, up)) {
        for (const Unit& unit : kUnits) {
            const double height_m = door * unit.metres;
            if (height_m < kLowestDoor_m || height_m > kHighestDoor_m) continue;
            return {unit.metres, fmt::format("scale = {} ({}), because a door is then {:.3g} m high.",
                                             unit.metres, unit.name, height_m)};
        }
    }
    const Extent extent = extent_of_triangles(file);
    const double height = height_along(extent.size(), up);
    const double breadth = std::min(extent.size().x, up == UpAxis::z ? extent.size().y : extent.size().z);
    const auto likelihood_in = [&](const Unit& unit) {
        return likelihood(height * unit.metres, breadth * unit.metres);
    };
    // Metres stand if they are possible at all: halls are high, and models of furniture low.
    const Unit* best = &kUnits[0];
    if (likelihood_in(*best) == 0 || extent.longest() > kLongestInMetres) {
        // Inches and feet are rare: they need the height of one storey.
        const auto rank = [&](const Unit& unit) {
            if (extent.longest() * unit.metres > kLongestInMetres) return 0;
            const int of_height = likelihood_in(unit);
            return unit.is_imperial ? std::max(of_height - 1, std::min(of_height, 1)) : of_height;
        };
        for (const Unit& unit : kUnits) {
            if (rank(unit) > rank(*best)) best = &unit;
        }
    }
    const double height_m = height * best->metres;
    if (likelihood_in(*best) == 0)
        return {1,
                fmt::format("scale = 1 (metres), because in no usual unit the height of {:.3g} is that of a "
                            "room or of furniture.",
                            height)};
    return {best->metres, fmt::format("scale = {} ({}), because the model is then {:.3g} m high, {}.",
                                      best->metres, best->name, height_m, words_for(likelihood_in(*best)))};
}

}  // namespace stilb::io
