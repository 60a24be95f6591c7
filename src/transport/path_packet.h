// Sixteen paths side by side, in single precision: the state between two vertices, and a diffuse reflection
// of all of them at once. Coordinates are relative to the scene's centre (RayCaster::center()).
#pragma once

#include <array>
#include <cstdint>

#include "math/random_lanes.h"
#include "rays/ray_caster.h"
#include "transport/lane_lights.h"

namespace stilb::transport {

using Bands = std::array<RayPacket::Floats, kBands>;

struct alignas(64) PathPacket {
    using Floats = RayPacket::Floats;
    using Words = RayPacket::Words;

    math::StreamPacket streams;
    Words number;  ///< of the path
    Words reflections_left;
    Bands throughput;
    /// As PreviousVertex.
    Floats previous_pdf_per_sr;
    rays::LaneVectors previous_position, previous_normal;
    Words previous_in_packet;
    /// The ray to the next vertex, and that vertex.
    rays::LaneVectors origin, direction;
    rays::SurfacePacket surface;
    Words general;  ///< of vertices that are reflected one by one: their number; else kPlain

    static constexpr std::uint32_t kPlain = ~0u;

    /// `from`: relative to the scene's centre.
    void set_ray(std::size_t lane, const Vec3& from, const Vec3& along);
    /// Moves a path.
    void copy_lane(std::size_t lane, const PathPacket& from, std::size_t from_lane);
};

/// The light of a source at the surfaces of paths if nothing lies in between.
struct alignas(64) ConnectionPacket {
    RayPacket segments;
    LaneMask lanes{};
    Bands luminance_cd_m2;
    RayPacket::Words light;  ///< of Scene::lights
};

/// Connects the lanes that are set with the sampled light, weighted against the reflected ray's density.
void connect_diffuse(const PathPacket& paths, const Bands& reflectance, const LightPacket& light,
                     const LaneMask& lanes, ConnectionPacket& connections);

/// Continues the paths of the lanes that are set along cosine-distributed directions, by the third and fourth
/// number; unsets those that end by roulette.
void reflect_diffuse(const math::NumberPacket& numbers, const Bands& reflectance, LaneMask& lanes,
                     PathPacket& paths);

}  // namespace stilb::transport
