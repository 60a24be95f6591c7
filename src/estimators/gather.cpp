#include "estimators/gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/sampling.h"

namespace stilb {
namespace {

constexpr double kPi = std::numbers::pi;

/// Another number in [0, 1) for every lane of a packet; uniform where u is.
double rotated(double u, int lane) {
    constexpr double golden = 0.6180339887498949;
    const double sum = u + golden * lane;
    return sum - std::floor(sum);
}

}  // namespace

void Gather::collect(const Batch& batch, ReadingSums& sums) const {
    for (std::size_t first = 0; first < points_.size(); first += kPacketWidth) {
        const RandomKey key = batch.key.derived(first);
        const std::uint64_t chains = plans_[first].chains_per_ray;
        for (std::uint64_t i = batch.first / chains; i < (batch.first + batch.count) / chains; ++i) {
            trace_packet(first, key, i, static_cast<double>(chains), sums);
        }
    }
}

void Gather::trace_packet(std::size_t first, RandomKey key, std::uint64_t index, double weight,
                          ReadingSums& sums) const {
    SampleStream shared(key, index);
    const auto [u1, u2] = shared.next_two();
    const double survival_number = shared.next();
    const Vec3 local = sample_cosine_hemisphere(u1, u2).direction;
    const int lanes_used = static_cast<int>(std::min<std::size_t>(kPacketWidth, points_.size() - first));
    HitPacket packet;
    LaneMask lanes{};
    std::array<Vec3, kPacketWidth> directions;
    for (int lane = 0; lane < lanes_used; ++lane) {
        const auto i = static_cast<std::size_t>(lane);
        const PackedPoint& point = points_[first + i];
        directions[i] = Frame::around(point.normal).to_world(local);
        packet.rays.set(lane, point.position - caster_.center(), directions[i]);
        lanes[i] = -1;
    }
    caster_.closest(packet, lanes);
    for (int lane = 0; lane < lanes_used; ++lane) {
        const auto i = static_cast<std::size_t>(lane);
        if (packet.object[i] == HitPacket::kNone) continue;
        if (!is_specular(caster_.material_of(packet, lane))) {
            const Vec3 normal{packet.normal_x[i], packet.normal_y[i], packet.normal_z[i]};
            const double distance_m = packet.rays.end[i];
            const double cos_hit = std::abs(dot(normal, directions[i])) / length(normal);
            const double g = local.z * cos_hit / (distance_m * distance_m);
            // Russian roulette with 1 - w itself: what survives has weight 1.
            const double remaining = g / (plans_[first + i].k_per_m2 + g);
            if (rotated(survival_number, lane) >= remaining) continue;
        }
        SampleStream own(key.derived(i), index);
        const Spectrum luminance = tracer_.luminance_without_direct(caster_.hit_of(packet, lane),
                                                                    directions[i], max_reflections_, own);
        sums.add(points_[first + i].reading, weight * kPi * luminance);
    }
}

}  // namespace stilb
