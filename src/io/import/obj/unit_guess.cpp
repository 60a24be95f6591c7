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
};
/// The first of equally likely ones is taken.
constexpr std::array kUnits{Unit{"metres", 1}, Unit{"millimetres", 1e-3}, Unit{"centimetres", 1e-2},
                            Unit{"inches", 0.0254}, Unit{"feet", 0.3048}};
constexpr double kLowestStorey_m = 2.2, kHighestStorey_m = 4;
constexpr double kLowestDoor_m = 1.85, kHighestDoor_m = 2.5;

double height_along(const Vec3& v, UpAxis up) { return up == UpAxis::z ? v.z : v.y; }

bool names_a_door(std::string name) {
    std::ranges::transform(name, name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return name.find("door") != name.npos && name.find("doorway") == name.npos &&
           name.find("outdoor") == name.npos && name.find("indoor") == name.npos;
}

struct Extent {
    double least = kLargestCoordinate, most = -kLargestCoordinate;

    void include(double value) { least = std::min(least, value), most = std::max(most, value); }
};

/// Heights of the groups that are named as doors, in units of the file.
std::vector<double> door_heights(const MeshFile& file, UpAxis up) {
    std::vector<Extent> extents(file.group_names.size());
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

/// From 0 (impossible) on.
int likelihood(double height_m) {
    if (height_m >= kLowestStorey_m && height_m <= kHighestStorey_m) return 3;  // one storey
    if (height_m > kHighestStorey_m && height_m <= 60) return 2;                // several storeys, or a hall
    return height_m >= 0.3 && height_m < kLowestStorey_m ? 1 : 0;               // furniture
}

std::string words_for(double height_m) {
    constexpr std::array<std::string_view, 4> kWords{"", "as furniture is", "as a hall or some storeys are",
                                                     "as one storey is (2.2 to 4 m)"};
    return std::string(kWords[static_cast<std::size_t>(likelihood(height_m))]);
}

double height_of(const MeshFile& file, UpAxis up) {
    Extent extent;
    for (const Triangle& triangle : file.mesh.triangles) {
        for (const std::uint32_t corner : triangle)
            extent.include(height_along(file.mesh.vertices[corner], up));
    }
    return extent.most - extent.least;
}

}  // namespace

UpGuess guess_up(const MeshFile& file) {
    constexpr double kAcross = 0.996;  // cosine of 5 degrees
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
    return {up, fmt::format(
                    "up = \"{}\", because {:.0f} % of the faces across y or z lie across {}, as floors and "
                    "ceilings do.",
                    up == UpAxis::z ? "z" : "y", 100 * std::max(across_y, across_z) / both,
                    up == UpAxis::z ? "z" : "y")};
}

ScaleGuess guess_scale(const MeshFile& file, UpAxis up) {
    for (const double door : door_heights(file, up)) {
        for (const auto& [name, metres] : kUnits) {
            const double height_m = door * metres;
            if (height_m < kLowestDoor_m || height_m > kHighestDoor_m) continue;
            return {metres, fmt::format("scale = {} ({}), because a door is then {:.3g} m high.", metres,
                                        name, height_m)};
        }
    }
    const double height = height_of(file, up);
    // Metres stand if they are possible at all: halls are high, and models of furniture low.
    const Unit* best = &kUnits[0];
    if (likelihood(height) == 0) {
        for (const Unit& unit : kUnits) {
            if (likelihood(height * unit.metres) > likelihood(height * best->metres)) best = &unit;
        }
    }
    const double height_m = height * best->metres;
    if (likelihood(height_m) == 0)
        return {1,
                fmt::format("scale = 1 (metres), because in no usual unit the height of {:.3g} is that of a "
                            "room or of furniture.",
                            height)};
    return {best->metres, fmt::format("scale = {} ({}), because the model is then {:.3g} m high, {}.",
                                      best->metres, best->name, height_m, words_for(height_m))};
}

}  // namespace stilb::io
