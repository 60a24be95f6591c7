// Packets of sixteen rays in the layout of Embree, whole and in parts: processors without 16-wide vectors
// trace eight or four rays at a time.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "rays/surface_packet.h"

namespace stilb::rays {

static_assert(sizeof(RayPacket) == sizeof(RTCRay16));
static_assert(offsetof(RayPacket, direction_x) == offsetof(RTCRay16, dir_x));
static_assert(offsetof(RayPacket, end) == offsetof(RTCRay16, tfar));
static_assert(offsetof(RayPacket, flags) == offsetof(RTCRay16, flags));
static_assert(sizeof(RayHitPacket) == sizeof(RTCRayHit16));
static_assert(offsetof(RayHitPacket, u) == offsetof(RTCRayHit16, hit.u));
static_assert(offsetof(RayHitPacket, object) == offsetof(RTCRayHit16, hit.geomID));
static_assert(kNothing == RTC_INVALID_GEOMETRY_ID);

/// A packet in parts of `width` rays, for processors without 16-wide vectors: calls `trace(valid, first,
/// fill)` for each; `fill(rays)` fills an RTCRay8 or RTCRay4.
template <int width, typename Trace>
void trace_in_parts(const RayPacket& packet, const LaneMask& lanes, const Trace& trace) {
    for (int first = 0; first < kPacketWidth; first += width) {
        const auto part = [&](const auto& all) { return all.data() + first; };
        alignas(32) std::array<int, width> valid;
        std::copy_n(part(lanes), width, valid.begin());
        trace(valid.data(), first, [&](auto& rays) {
            std::copy_n(part(packet.origin_x), width, rays.org_x);
            std::copy_n(part(packet.origin_y), width, rays.org_y);
            std::copy_n(part(packet.origin_z), width, rays.org_z);
            std::copy_n(part(packet.start), width, rays.tnear);
            std::copy_n(part(packet.direction_x), width, rays.dir_x);
            std::copy_n(part(packet.direction_y), width, rays.dir_y);
            std::copy_n(part(packet.direction_z), width, rays.dir_z);
            std::copy_n(part(packet.time), width, rays.time);
            std::copy_n(part(packet.end), width, rays.tfar);
            std::copy_n(part(packet.mask), width, rays.mask);
            std::copy_n(part(packet.id), width, rays.id);
            std::copy_n(part(packet.flags), width, rays.flags);
        });
    }
}

template <int width, typename EmbreeRays, typename Occlude>
void occlude_in_parts(RayPacket& packet, const LaneMask& lanes, const Occlude& occlude) {
    trace_in_parts<width>(packet, lanes, [&](const int* valid, int first, const auto& fill) {
        EmbreeRays rays;
        fill(rays);
        occlude(valid, &rays);
        std::copy_n(rays.tfar, width, packet.end.data() + first);
    });
}

template <int width, typename EmbreeRayHits, typename Intersect>
void intersect_in_parts(RayHitPacket& packet, const LaneMask& lanes, const Intersect& intersect) {
    trace_in_parts<width>(packet.ray, lanes, [&](const int* valid, int first, const auto& fill) {
        EmbreeRayHits part;
        fill(part.ray);
        std::fill_n(part.hit.geomID, width, RTC_INVALID_GEOMETRY_ID);
        intersect(valid, &part);
        const auto keep = [&](const auto* found, auto& all) {
            std::copy_n(found, width, all.data() + first);
        };
        keep(part.ray.tfar, packet.ray.end);
        keep(part.hit.Ng_x, packet.normal_x), keep(part.hit.Ng_y, packet.normal_y);
        keep(part.hit.Ng_z, packet.normal_z), keep(part.hit.u, packet.u), keep(part.hit.v, packet.v);
        keep(part.hit.primID, packet.primitive), keep(part.hit.geomID, packet.object);
        keep(part.hit.instID[0], packet.instance);
    });
}

}  // namespace stilb::rays
