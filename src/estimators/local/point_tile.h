// Sixteen receivers, and the segments from one point on a surface to all of them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rays/ray_caster.h"
#include "transport/receiver.h"
#include "transport/weights.h"

namespace stilb::estimators {

/// A packet of neighbouring receivers as a structure of arrays, relative to the ray caster's centre.
struct alignas(64) PointTile {
    using Floats = std::array<float, kPacketWidth>;
    Floats x{}, y{}, z{};                       ///< the points themselves, which determine G
    Floats lifted_x{}, lifted_y{}, lifted_z{};  ///< where segments end, unless they are long
    Floats lift_m{}, up_x{}, up_y{}, up_z{};    ///< off a receiver's surface, and in which direction; or 0
    Floats normal_x{}, normal_y{}, normal_z{};  ///< 0 in lanes without a point
    Floats inverse_k{};                         ///< of the bounded connection [m2]
    /// The number of reflections that light may have met before it arrives.
    std::array<std::int32_t, kPacketWidth> reflections_left{};
    /// The constant responses of the receivers: 1 of illuminance, [1/sr] of luminance. 1 where the tile is
    /// directional.
    std::array<Floats, kBands> response{};
    std::array<std::uint32_t, kPacketWidth> readings{};  ///< of the receivers
    std::span<const transport::Receiver> receivers;      ///< of the first lanes
    bool directional = false;                            ///< the response of one of them depends on direction
    bool has_bodies = false;                             ///< one of them is on no surface; its normal is 0
    bool is_in_large_scene = false;                      ///< segments may be so long that ends are raised
    transport::VertexChoice choice{};                    ///< of vertices that are connected

    Rgb response_of(std::size_t lane) const {
        return {{response[0][lane], response[1][lane], response[2][lane]}};
    }
};

/// Receivers in packets, in their order; keeps references to them. `k_per_m2`: of each receiver; may be
/// infinite.
std::vector<PointTile> tiles_of(std::span<const transport::Receiver> receivers,
                                std::span<const double> k_per_m2, const rays::RayCaster& caster,
                                int max_reflections,
                                transport::VertexChoice choice = transport::VertexChoice::by_flux);

/// A point on a surface in single precision, relative to the ray caster's centre.
struct SegmentOrigin {
    float x = 0, y = 0, z = 0;
    float lifted_x = 0, lifted_y = 0, lifted_z = 0;
    float normal_x = 0, normal_y = 0, normal_z = 0;

    SegmentOrigin(const SurfacePoint& at, const Vec3& center);
};

/// Prepares the segments from `origin`, for light after so many reflections, to a tile's points, and G =
/// cos+ s / d^2 [1/m2] without visibility, with s the sensitivity of the receiver (cos+ on a surface); a lane
/// is set where G is not 0 and so many reflections are allowed. Returns false where no lane is.
bool connect(const SegmentOrigin& origin, int reflections, const PointTile& tile, RayPacket& segments,
             LaneMask& lanes, PointTile::Floats& g_per_m2);

}  // namespace stilb::estimators
