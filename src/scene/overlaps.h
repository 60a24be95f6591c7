// Surfaces that lie in one plane and overlap there, and lamps that are modelled in the plane of a ceiling.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace stilb::scene {

/// Two triangles that overlap in one plane and differ in material or emission. Of a lamp and another surface,
/// `first` is the lamp.
struct Overlap {
    ObjectId first{}, second{};
    std::uint32_t triangle = 0;  ///< of the first, as Hit::triangle; 0 for a disk
    std::uint32_t second_triangle = 0;
    Vec3 position, normal;  ///< the middle of the overlap; the unit normal of the front of the first
    double gap_m = 0;       ///< how far the first lies in front of the second (on the side of `normal`)
};

enum class OverlapsOf { all_surfaces, lamps };

/// Pairs of triangles closer than rays can tell apart (2.25 offsets of lifted points there) that share more
/// than a thousandth of the smaller one. Ends after `most`. Disks count as polygons; other curved shapes are
/// left out, as are instances. `lamps`: only pairs of a lamp and another surface that is no lamp, with
/// instances.
std::vector<Overlap> find_overlaps(const Scene& scene, OverlapsOf of, std::size_t most);

/// The same of all triangles of a mesh, by their numbers.
std::vector<std::array<std::uint32_t, 2>> find_overlaps(const Mesh& mesh, const Lift& lift);

/// The triangles of flat shapes other than meshes; of a disk those of a polygon. Curved shapes have none.
Mesh flat_mesh(const Shape& shape);

/// Moves lamps that lie in the plane of another surface in front of it, on the side that they light: by twice
/// the distance by which points are lifted off a surface, 15 micrometres in a room of 8 m. Then every ray
/// from that side meets the lamp, by every method. A lamp in the plane of a ceiling is a common model of a
/// panel.
void put_lamps_in_front(Scene& scene);

}  // namespace stilb::scene

namespace stilb {
using scene::Overlap;
}  // namespace stilb
