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
        packet.rays.set(lane, point.lifted - caster_.center(), directions[i]);
        lanes[i] = -1;
    }
    caster_.closest(packet, lanes);
    for (int lane = 0; lane < lanes_used; ++lane) {
        const auto i = static_cast<std::size_t>(lane);
        if (packet.object[i] == HitPacket::kNone) continue;
        const Material& material = caster_.material_of(packet, lane);
        GatheredShare share;
        double survival = 1;
        if (!is_specular(material)) {
            // G as the fan has it: between the points themselves, not the lifted ones.
            const PackedPoint& point = points_[first + i];
            const Vec3 normal{packet.normal_x[i], packet.normal_y[i], packet.normal_z[i]};
            const Vec3 from_point =
                point.lifted + double{packet.rays.end[i]} * directions[i] - point.position;
            const double squared_m2 = squared_length(from_point);
            const double g = std::max(0.0, dot(point.normal, from_point)) *
                             std::abs(dot(normal, from_point)) / (length(normal) * squared_m2 * squared_m2);
            share.g_over_k = g / plans_[first + i].k_per_m2;
            // Russian roulette with the largest 1 - w that any way of the light can have.
            survival = share(relative_brdf(material, Spectrum::grey(largest_brdf_per_sr(material))));
            if (rotated(survival_number, lane) >= survival) continue;
        }
        // The same Sobol' point: its next dimensions, scrambled for each lane on its own.
        SampleStream own = shared.continued(key.derived(i));
        const Spectrum luminance =
            tracer_.luminance_without_direct(caster_.hit_of(packet, lane), directions[i], max_reflections_,
                                             share, own) *
            (1 / survival);
        sums.add(points_[first + i].reading, weight * kPi * luminance);
    }
}

}  // namespace stilb
