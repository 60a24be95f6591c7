#include "random/thresholds.h"

#include <fmt/format.h>

#include <fstream>
#include <string>

namespace stilb::random {

std::span<const Threshold> thresholds() {
    static constexpr Threshold list[] = {
        // Numbers of lamps.
        {"kFew", "src/transport/light_sampler.h", "32", "lamps: all of them are weighed, or a tree chooses",
         "scenes with 31, 32, 33 and 34 lamps of each kind"},
        {"kMost", "src/transport/lane_lights.h", "32", "lamps: sixteen lanes at a time, or one by one",
         "scenes with 31, 32 and 33 lamps"},
        {"kMostOpen", "src/transport/light_tree.h", "32", "nodes of a cut through the tree of lamps",
         "scenes with 33 to 200 lamps"},
        {"kFewPoints", "src/transport/direct/direct_light.h", "16",
         "point lamps of pictures: all of them, or some that are chosen", "scenes with 15, 16 and 17 lamps"},
        {"kMostExact", "src/transport/direct/direct_light.h", "100'000'000",
         "point lamps times readings: all of them once, or some that are chosen",
         "not crossed: 200 points times 500,000 readings"},
        {"kMostElements", "src/transport/direct/uniform_lamp.h", "32",
         "triangles of a lamp: closed form, or samples",
         "faces cut: lamps of 8, 18, 32, 50, 72 and 98 triangles"},
        {"kMostElements", "src/transport/direct/opening_lamp.cpp", "64",
         "elements of an opening: closed form, or samples", "openings from 1 cm to the size of the room"},
        {"kMostLightGroups", "src/scene/light_groups.h", "32",
         "groups of lamps of a solution: apart, or together",
         "not crossed here; tests/scene/light_groups_test.cpp"},
        {"kFew", "src/scene/overlaps.cpp", "16", "faces: pairs of all of them, or a tree",
         "scenes of 1 to 13 boxes, and faces cut"},
        // Numbers of readings.
        {"kMostReadings", "src/estimators/auto.cpp", "64",
         "readings: path tracing or light paths, or light paths or a guess",
         "grids of 63, 64 and 65 readings"},
        {"kVeryFew", "src/estimators/auto.cpp", "16", "readings: when planning pays",
         "grids of 15, 16 and 17 readings"},
        {"kMostInPilots", "src/estimators/auto.cpp", "128", "readings: pilots of all of them, or of some",
         "grids of 65 and 144 readings"},
        {"kLargeGrid", "src/run/campaign.cpp", "64",
         "readings of a grid: 32 replicates, or 8 that are pooled",
         "not crossed: these runs ask for 16 replicates"},
        {"kMostSums", "src/run/campaign.cpp", "std::size_t{1} << 22", "readings times strands: fewer strands",
         "not crossed: 131,072 readings"},
        {"kMostSurveyed", "src/estimators/local/split_plan.cpp", "1024", "packets: plans of all, or of some",
         "not crossed: 16,384 readings"},
        // Numbers of faces.
        {"kMost", "src/rays/few_triangles.h", "96", "triangles: all are tested, or Embree's tree",
         "scenes that are filled up to 95, 96 and 97 triangles"},
        {"kSaved", "src/scene/instances.cpp", "100'000", "triangles of copies: of their own, or instances",
         "not crossed: copies of 100,000 triangles"},
        {"kPatches", "src/estimators/local/guess/light_guess.cpp", "3000", "patches of the guess",
         "rooms of 2 to 600 faces with `guided`"},
        // Distances and sizes.
        {"kLargeTriangle_m", "src/rays/embree_geometry.cpp", "8", "edges: as they are, or cut",
         "rooms from 1 cm to 1 km"},
        {"kLargeTriangle_m", "src/rays/shaft_query.cpp", "8", "edges: as they are, or cut",
         "rooms from 1 cm to 1 km"},
        {"kMostNodes", "src/rays/shaft_query.cpp", "400", "nodes of a shaft: certain, or by rays",
         "scenes with up to 200 lamps, and faces cut"},
        {"kNear", "src/transport/light_tree.h", "1. / 9", "how near a node of the tree is opened",
         "sensors from 1e-6 to 300 sizes away from 33 to 200 lamps"},
        {"kFarthest_m", "src/rays/ray_caster.cpp", "1e9", "the largest coordinate of a scene",
         "not crossed here; tests/rays/ray_caster_test.cpp"},
        {"kLargeHalfExtent_m", "src/scene/lift.cpp", "32",
         "half extents: rays are most exact in the middle, or near to sensors",
         "rooms from 1 cm to 1 km; tests/scene/lift_test.cpp"},
        {"kAgreement", "src/transport/direct/opening_lamp.h", "5e-5",
         "solids of an opening: as a cosine in closed form, or samples",
         "openings of cosine.ies and washer.ies"},
        // Numbers of reflections and directions.
        {"kUnlimited", "src/transport/receiver.h", "std::numeric_limits<int>::max()",
         "reflections: a guess only without a limit", "scenes with 0, 1, 2, 3 and all reflections"},
        {"kMostFollowed", "src/transport/line_of_sight.cpp", "32", "mirrors along a line of sight",
         "not crossed: luminance between parallel mirrors is rare"},
        {"kResidualSplit", "src/estimators/local/guess/guess_points.h", "200",
         "exponents of gloss in the guess", "not crossed: exponents from 1 to 100"},
        {"kSharp", "src/estimators/local/guess/light_guess.cpp", "100",
         "gloss that the guess takes as a mirror's", "not crossed: exponents from 1 to 100"},
    };
    return list;
}

int check_thresholds(const std::filesystem::path& sources) {
    int missing = 0;
    for (const Threshold& threshold : thresholds()) {
        std::ifstream file(sources / threshold.file);
        bool is_found = false;
        for (std::string line; std::getline(file, line);) {
            const std::size_t name = line.find(std::string(threshold.constant) + " = ");
            is_found |= name != std::string::npos && line.find(threshold.value, name) != std::string::npos;
        }
        fmt::print("| `{}` | {} | {} | {} | {} |{}\n", threshold.constant, threshold.file, threshold.value,
                   threshold.what, threshold.crossed, is_found ? "" : " NOT THERE WITH THIS VALUE");
        missing += !is_found;
    }
    return missing;
}

}  // namespace stilb::random
