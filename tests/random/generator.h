// Random scene files: everything that a scene file may hold.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "random/draft.h"
#include "random/draw.h"

namespace stilb::random {

/// A place of a surface: sensors lie on it or near it, goniometers need it.
struct Spot {
    Vec3 position, normal;
};

/// Where a scene happens: the inside of its room, or what stands for one outdoors.
struct Site {
    Vec3 low, high;
    std::vector<Spot> spots;  ///< of walls and floors, on the side that is lit
    bool is_closed = false;   ///< no ray from inside leaves it

    Vec3 size() const { return high - low; }
    Vec3 at(const Vec3& share) const {
        return {low.x + share.x * size().x, low.y + share.y * size().y, low.z + share.z * size().z};
    }
    double least() const { return std::min({size().x, size().y, size().z}); }
};

/// Readings whose values are known by a formula or quadrature of this program [lx or cd/m2]; empty where
/// none are.
using ExactValues = std::vector<double>;

struct RandomScene {
    Draft draft;
    ExactValues exact;
    /// Where two lamps lie in one place, both may count or one: all readings are then the exact values, or
    /// all are twice as much.
    bool may_be_twice = false;
    std::string kind;  ///< of the room and lamps, in words
};

/// Files that scenes refer to, written into the folder.
void write_files(const std::filesystem::path& folder);

RandomScene generate(std::uint64_t seed, std::uint64_t scene);

// The steps of generate().

/// A material; its name.
std::string add_material(Draft& draft, Draw& draw);
/// Diffuse, for surfaces that light must leave.
std::string add_plain_material(Draft& draft, double reflectance);
Site add_room(Draft& draft, Draw& draw, std::string& kind);
void add_things(Draft& draft, Draw& draw, const Site& site);
void add_lamps(Draft& draft, Draw& draw, const Site& site, std::string& kind);
void add_sensors(Draft& draft, Draw& draw, const Site& site);
/// Files of meshes, bodies and skies, colours, other projections, sensors of rooms and of glare by daylight.
void add_extras(Draft& draft, Draw& draw, const Site& site, std::string& kind);
/// Fills a scene up to so many triangles, where it has fewer, by small ones that lie together.
void fill_up(Draft& draft, std::size_t triangles, const Site& site);
/// A scene whose readings are known.
RandomScene generate_exact(Draw& draw);

/// The luminaire files of write_files(): a wide beam without an opening, a cosine with an opening of 0.3 x
/// 0.1 m, and a wall washer, which is not symmetric.
inline constexpr const char* kBeamFile = "beam.ies";
inline constexpr const char* kCosineFile = "cosine.ies";
inline constexpr const char* kWasherFile = "washer.ies";
/// A body of 20 triangles, the body of a luminaire, and a panorama.
inline constexpr const char* kThingFiles[] = {"thing.obj", "thing.ply"};
inline constexpr const char* kBodyFile = "body.obj";
inline constexpr const char* kSkyFile = "sky.hdr";
inline constexpr double kCosineLength_m = 0.1, kCosineWidth_m = 0.3;

}  // namespace stilb::random
