#include "estimators/local/point_tile.h"

#include <algorithm>
#include <cmath>

#include "base/rays.h"

namespace stilb::estimators {
namespace {

/// Without __restrict, which promises that nothing overlaps, the loop would stay scalar.
STILB_VECTORIZED bool connect_lanes(const SegmentOrigin& __restrict origin, std::int32_t reflections,
                                    const PointTile& __restrict tile, RayPacket& __restrict segments,
                                    LaneMask& __restrict lanes, PointTile::Floats& __restrict g_per_m2) {
    std::int32_t any = 0;
    for (int i = 0; i < kPacketWidth; ++i) {
        const float dx = tile.x[i] - origin.x, dy = tile.y[i] - origin.y, dz = tile.z[i] - origin.z;
        segments.origin_x[i] = origin.lifted_x, segments.origin_y[i] = origin.lifted_y,
        segments.origin_z[i] = origin.lifted_z;
        segments.direction_x[i] = tile.lifted_x[i] - origin.lifted_x;
        segments.direction_y[i] = tile.lifted_y[i] - origin.lifted_y;
        segments.direction_z[i] = tile.lifted_z[i] - origin.lifted_z;
        segments.end[i] = 1;
        const float squared = dx * dx + dy * dy + dz * dz;
        const float cos_origin = origin.normal_x * dx + origin.normal_y * dy + origin.normal_z * dz;
        const float cos_point = -(tile.normal_x[i] * dx + tile.normal_y[i] * dy + tile.normal_z[i] * dz);
        // & rather than &&: without a branch the loop vectorises.
        const std::int32_t active = -static_cast<std::int32_t>((cos_origin > 0) & (cos_point > 0) &
                                                               (reflections <= tile.reflections_left[i]));
        g_per_m2[i] = active ? cos_origin * cos_point / (squared * squared) : 0;
        lanes[i] = active;
        any |= active;
    }
    return any != 0;
}

/// Segments are as inexact at their ends as they are long, like those to lamps: they end above the surface by
/// the same share of their length at least. In scenes that are not large, receivers are lifted enough.
STILB_VECTORIZED void raise_ends(const PointTile& __restrict tile, RayPacket& __restrict segments) {
    constexpr auto share = static_cast<float>(Lift::kShare * Lift::kShareOfRay);
    for (int i = 0; i < kPacketWidth; ++i) {
        const float x = segments.direction_x[i], y = segments.direction_y[i], z = segments.direction_z[i];
        const float more_m = std::max(share * std::sqrt(x * x + y * y + z * z) - tile.lift_m[i], 0.0f);
        segments.direction_x[i] = x + more_m * tile.up_x[i];
        segments.direction_y[i] = y + more_m * tile.up_y[i];
        segments.direction_z[i] = z + more_m * tile.up_z[i];
    }
}

/// G for lanes of bodies, which connect_lanes() leaves unset: their normals are 0.
bool connect_bodies(const SegmentOrigin& origin, std::int32_t reflections, const PointTile& tile,
                    LaneMask& lanes, PointTile::Floats& g_per_m2) {
    const Vec3 normal{origin.normal_x, origin.normal_y, origin.normal_z};
    bool any = false;
    for (std::size_t i = 0; i < tile.receivers.size(); ++i) {
        const transport::Receiver& receiver = tile.receivers[i];
        if (!receiver.is_body() || reflections > tile.reflections_left[i]) continue;
        const Vec3 offset{tile.x[i] - origin.x, tile.y[i] - origin.y, tile.z[i] - origin.z};
        const double along = dot(normal, offset);
        if (!(along > 0)) continue;
        const double distance = length(offset);
        const double g = along * receiver.sensitivity(-offset / distance) / (distance * distance * distance);
        g_per_m2[i] = static_cast<float>(g);
        if (!(g_per_m2[i] > 0)) continue;
        lanes[i] = -1;
        any = true;
    }
    return any;
}

void set_responses(PointTile& tile) {
    for (std::size_t i = 0; i < tile.receivers.size(); ++i) {
        const Rgb response = tile.directional ? Rgb::grey(1) : *tile.receivers[i].constant_response();
        for (std::size_t b = 0; b < kBands; ++b) tile.response[b][i] = static_cast<float>(response[b]);
    }
}

}  // namespace

std::vector<PointTile> tiles_of(std::span<const transport::Receiver> receivers,
                                std::span<const double> k_per_m2, const rays::RayCaster& caster,
                                int max_reflections, transport::VertexChoice choice) {
    std::vector<PointTile> tiles((receivers.size() + kPacketWidth - 1) / kPacketWidth);
    for (std::size_t j = 0; j < receivers.size(); ++j) {
        const transport::Receiver& receiver = receivers[j];
        const Vec3 p = receiver.position() - caster.center();
        const Vec3 lifted = receiver.lifted() - caster.center();
        const Vec3& normal = receiver.normal();
        const std::size_t first = j / kPacketWidth * kPacketWidth, i = j - first;
        PointTile& tile = tiles[j / kPacketWidth];
        tile.x[i] = static_cast<float>(p.x), tile.y[i] = static_cast<float>(p.y),
        tile.z[i] = static_cast<float>(p.z);
        tile.lifted_x[i] = static_cast<float>(lifted.x);
        tile.lifted_y[i] = static_cast<float>(lifted.y);
        tile.lifted_z[i] = static_cast<float>(lifted.z);
        const double lift_m = length(receiver.lift());
        const Vec3 up = lift_m > 0 ? receiver.lift() / lift_m : Vec3{};
        tile.lift_m[i] = static_cast<float>(lift_m);
        tile.up_x[i] = static_cast<float>(up.x), tile.up_y[i] = static_cast<float>(up.y),
        tile.up_z[i] = static_cast<float>(up.z);
        tile.normal_x[i] = static_cast<float>(normal.x);
        tile.normal_y[i] = static_cast<float>(normal.y);
        tile.normal_z[i] = static_cast<float>(normal.z);
        tile.inverse_k[i] = static_cast<float>(1 / k_per_m2[j]);
        tile.readings[i] = receiver.reading();
        tile.reflections_left[i] = receiver.reflections_left(max_reflections);
        tile.choice = choice;
        tile.receivers = receivers.subspan(first, i + 1);
        tile.directional = tile.directional || !receiver.constant_response();
        tile.has_bodies = tile.has_bodies || receiver.is_body();
        tile.is_in_large_scene = caster.lift().half_extent_m() > caster.lift().largest_size_m();
    }
    for (PointTile& tile : tiles) set_responses(tile);
    return tiles;
}

SegmentOrigin::SegmentOrigin(const SurfacePoint& at, const Vec3& center) {
    const Vec3 p = at.position - center, lifted = at.lifted - center, &normal = at.normal;
    x = static_cast<float>(p.x), y = static_cast<float>(p.y), z = static_cast<float>(p.z);
    lifted_x = static_cast<float>(lifted.x), lifted_y = static_cast<float>(lifted.y),
    lifted_z = static_cast<float>(lifted.z);
    normal_x = static_cast<float>(normal.x), normal_y = static_cast<float>(normal.y),
    normal_z = static_cast<float>(normal.z);
}

bool connect(const SegmentOrigin& origin, int reflections, const PointTile& tile, RayPacket& segments,
             LaneMask& lanes, PointTile::Floats& g_per_m2) {
    const bool any = connect_lanes(origin, reflections, tile, segments, lanes, g_per_m2);
    if (tile.is_in_large_scene) raise_ends(tile, segments);
    return tile.has_bodies ? connect_bodies(origin, reflections, tile, lanes, g_per_m2) || any : any;
}

}  // namespace stilb::estimators
