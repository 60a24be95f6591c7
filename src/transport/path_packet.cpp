#include "transport/path_packet.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "math/lane_functions.h"
#include "transport/weights.h"

namespace stilb::transport {

void PathPacket::set_ray(std::size_t lane, const Vec3& from, const Vec3& along) {
    origin.set(lane, from);
    direction.x[lane] = packet_direction(along.x);
    direction.y[lane] = packet_direction(along.y);
    direction.z[lane] = packet_direction(along.z);
}

void PathPacket::copy_lane(std::size_t lane, const PathPacket& from, std::size_t from_lane) {
    // All members are rows of sixteen words.
    constexpr std::size_t word = sizeof(std::uint32_t), row = word * kPacketWidth;
    static_assert(sizeof(PathPacket) % row == 0);
    auto* const to_bytes = reinterpret_cast<unsigned char*>(this) + word * lane;
    const auto* const from_bytes = reinterpret_cast<const unsigned char*>(&from) + word * from_lane;
    for (std::size_t at = 0; at < sizeof(PathPacket); at += row) {
        std::memcpy(to_bytes + at, from_bytes + at, word);
    }
}

STILB_VECTORIZED void connect_diffuse(const PathPacket& __restrict paths, const Bands& __restrict reflectance,
                                      const LightPacket& __restrict light, const LaneMask& __restrict lanes,
                                      ConnectionPacket& __restrict connections) {
    constexpr auto inverse_pi = std::numbers::inv_pi_v<float>;
    const rays::SurfacePacket& surface = paths.surface;
    RayPacket& segments = connections.segments;
    for (int i = 0; i < kPacketWidth; ++i) {
        const float cosine = surface.normal.x[i] * light.direction.x[i] +
                             surface.normal.y[i] * light.direction.y[i] +
                             surface.normal.z[i] * light.direction.z[i];
        // The balance heuristic, pdf / (pdf + cosine / pi).
        const float weight = 1 / (1 + inverse_pi * cosine * light.inverse_pdf_sr[i]);
        const float factor = inverse_pi * cosine * weight;
        const float r =
            factor * paths.throughput[0][i] * reflectance[0][i] * light.normal_illuminance_lx[0][i];
        const float g =
            factor * paths.throughput[1][i] * reflectance[1][i] * light.normal_illuminance_lx[1][i];
        const float b =
            factor * paths.throughput[2][i] * reflectance[2][i] * light.normal_illuminance_lx[2][i];
        connections.luminance_cd_m2[0][i] = r;
        connections.luminance_cd_m2[1][i] = g;
        connections.luminance_cd_m2[2][i] = b;
        // & rather than &&: without a branch the loop vectorises.
        const int lit =
            static_cast<int>(lanes[i] != 0) & static_cast<int>(cosine > 0) & static_cast<int>(r + g + b > 0);
        connections.lanes[i] = -lit;
        segments.origin_x[i] = surface.lifted.x[i];
        segments.origin_y[i] = surface.lifted.y[i];
        segments.origin_z[i] = surface.lifted.z[i];
        segments.direction_x[i] = lane_direction(light.source.x[i] - surface.lifted.x[i]);
        segments.direction_y[i] = lane_direction(light.source.y[i] - surface.lifted.y[i]);
        segments.direction_z[i] = lane_direction(light.source.z[i] - surface.lifted.z[i]);
        segments.end[i] = 1;
    }
}

STILB_VECTORIZED void reflect_diffuse(const math::NumberPacket& __restrict numbers,
                                      const Bands& __restrict reflectance, LaneMask& __restrict lanes,
                                      PathPacket& __restrict paths) {
    constexpr auto inverse_pi = std::numbers::inv_pi_v<float>;
    constexpr float least_cosine = 1e-6f;
    const rays::SurfacePacket& surface = paths.surface;
    for (int i = 0; i < kPacketWidth; ++i) {
        const float r = paths.throughput[0][i] * reflectance[0][i];
        const float g = paths.throughput[1][i] * reflectance[1][i];
        const float b = paths.throughput[2][i] * reflectance[2][i];
        const float largest = std::max(std::max(reflectance[0][i], reflectance[1][i]), reflectance[2][i]);
        const float survival = patient_survival_probability(std::max(std::max(r, g), b), largest);
        const auto survives =
            static_cast<int>(math::lane_unit_interval(numbers.hashed(i, kRoulette)) < survival);
        const int goes_on = static_cast<int>(lanes[i] != 0) & survives;
        const float factor = 1 / survival;

        const auto [x, y] = math::lane_unit_disk(math::lane_unit_interval(numbers.words[2][i]),
                                                 math::lane_unit_interval(numbers.words[3][i]));
        const float z = std::max(std::sqrt(std::max(1 - x * x - y * y, 0.0f)), least_cosine);
        // The axes of Frame::around.
        const float nx = surface.normal.x[i], ny = surface.normal.y[i], nz = surface.normal.z[i];
        const float sign = std::copysign(1.0f, nz), a = -1 / (sign + nz), c = nx * ny * a;
        const float dx = x * (1 + sign * nx * nx * a) + y * c + z * nx;
        const float dy = x * sign * c + y * (sign + ny * ny * a) + z * ny;
        const float dz = -x * sign * nx - y * ny + z * nz;

        lanes[i] = -goes_on;
        paths.throughput[0][i] = r * factor;
        paths.throughput[1][i] = g * factor;
        paths.throughput[2][i] = b * factor;
        paths.origin.x[i] = surface.lifted.x[i];
        paths.origin.y[i] = surface.lifted.y[i];
        paths.origin.z[i] = surface.lifted.z[i];
        paths.direction.x[i] = lane_direction(dx);
        paths.direction.y[i] = lane_direction(dy);
        paths.direction.z[i] = lane_direction(dz);
        paths.previous_pdf_per_sr[i] = inverse_pi * z;
        paths.previous_position.x[i] = surface.position.x[i];
        paths.previous_position.y[i] = surface.position.y[i];
        paths.previous_position.z[i] = surface.position.z[i];
        paths.previous_normal.x[i] = nx;
        paths.previous_normal.y[i] = ny;
        paths.previous_normal.z[i] = nz;
    }
}

}  // namespace stilb::transport
