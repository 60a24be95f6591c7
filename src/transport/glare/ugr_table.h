// Tables of the Unified Glare Rating of a luminaire [CIE 117, CIE 190]: in rooms of standard sizes and
// reflectances, for an eye in the middle of a wall that looks along the room.
//
// Lengths are in units of H, the height of the luminaires over the eye. The room reaches from the plane of
// the eye, whose reflectance is called that of the floor, to the plane of the luminaires, its ceiling. The
// luminaires form a regular grid, half a spacing away from the walls. With the direction of each to the eye,
//
//     L^2 w / p^2 = I^2 / (A r^2 p^2),
//
// A the projected area of its opening. The background is the indirect illuminance of the walls over pi, their
// mean, where each of the three surfaces (floor, walls, ceiling) has one illuminance. Luminaires at more than
// 85 degrees from the vertical, and outside of the table of position indices (is_in_field()), are left out.
#pragma once

#include <array>
#include <cstddef>

#include "lights/opening_shape.h"
#include "lights/photometric_solid.h"

namespace stilb::transport {

/// The sizes across and along the line of sight, in H.
struct UgrRoom {
    int across = 0, along = 0;
};
inline constexpr std::array<UgrRoom, 19> kUgrRooms{{{2, 2},
                                                    {2, 3},
                                                    {2, 4},
                                                    {2, 6},
                                                    {2, 8},
                                                    {2, 12},
                                                    {4, 2},
                                                    {4, 3},
                                                    {4, 4},
                                                    {4, 6},
                                                    {4, 8},
                                                    {4, 12},
                                                    {8, 4},
                                                    {8, 6},
                                                    {8, 8},
                                                    {8, 12},
                                                    {12, 4},
                                                    {12, 6},
                                                    {12, 8}}};

/// Reflectances, or shares of a flux.
struct OfSurfaces {
    double ceiling = 0, walls = 0, floor = 0;
};
inline constexpr std::array<OfSurfaces, 5> kUgrReflectances{
    {{0.7, 0.5, 0.2}, {0.7, 0.3, 0.2}, {0.5, 0.5, 0.2}, {0.5, 0.3, 0.2}, {0.3, 0.3, 0.2}}};

/// Ratings for the luminaire's own flux: of a room, for each of the reflectances.
using UgrColumns = std::array<std::array<double, kUgrReflectances.size()>, kUgrRooms.size()>;
struct UgrTable {
    /// The opening's longer side, where it has one, lies across or along the line of sight. Where it has
    /// none, C0 points to the eye, or C90.
    UgrColumns crosswise, endwise;
};

/// The height H of the luminaires over the eye.
inline constexpr double kUgrHeight_m = 2;

/// `spacing`: of the luminaires, in H; all rooms are multiples of it. A rating is minus infinity where the
/// eye sees no light. The opening must not be a point.
UgrTable ugr_table(const PhotometricSolid& solid, const lights::Opening& opening, double spacing);

/// The share of a flux that falls on the walls after one reflection or more. `direct`: where it falls first.
double indirect_share_of_walls(const UgrRoom& room, const OfSurfaces& reflectances, const OfSurfaces& direct);

}  // namespace stilb::transport
