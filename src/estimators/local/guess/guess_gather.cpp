#include "estimators/local/guess/guess_gather.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimators/local/guess/guess_points.h"
#include "math/sampling.h"

namespace stilb::estimators {
namespace {

using Floats = PointTile::Floats;

/// A direction about the normal, before the lanes' shifts: squared radius and azimuth on the unit disk.
struct DiskDirection {
    float square = 0, cos = 0, sin = 0;
};

STILB_VECTORIZED void set_directions(const GatherLanes& __restrict lanes, const DiskDirection& disk,
                                     RayPacket& __restrict packet, Floats& __restrict cosine) {
    for (int i = 0; i < kPacketWidth; ++i) {
        const float shifted = disk.square + lanes.shift[i];
        const float square = shifted >= 1 ? shifted - 1 : shifted;
        const float radius = std::sqrt(square), z = std::sqrt(1 - square);
        const float x = radius * (disk.cos * lanes.turn_cos[i] - disk.sin * lanes.turn_sin[i]);
        const float y = radius * (disk.sin * lanes.turn_cos[i] + disk.cos * lanes.turn_sin[i]);
        packet.direction_x[i] = x * lanes.u[0][i] + y * lanes.v[0][i] + z * lanes.w[0][i];
        packet.direction_y[i] = x * lanes.u[1][i] + y * lanes.v[1][i] + z * lanes.w[1][i];
        packet.direction_z[i] = x * lanes.u[2][i] + y * lanes.v[2][i] + z * lanes.w[2][i];
        cosine[i] = z;
    }
}

/// As packet_direction().
void avoid_tiny_components(RayPacket& packet) {
    for (auto* component : {&packet.direction_x, &packet.direction_y, &packet.direction_z}) {
        for (float& value : *component) value = std::abs(value) < 1e-11f ? 0 : value;
    }
}

void add_shares(const transport::LightSum& light, std::vector<Rgb>& to) {
    to.resize(light.shares.size());
    for (std::size_t c = 0; c < to.size(); ++c) to[c] += light.shares[c];
}

}  // namespace

std::vector<GatherPoint> gather_points(math::RandomKey key, std::uint64_t first, std::uint64_t count) {
    std::vector<GatherPoint> points;
    points.reserve(count);
    for (std::uint64_t index = first; index < first + count; ++index) {
        math::SampleStream stream(key, index, 4);
        const auto [u1, u2] = stream.next_two();
        points.push_back({u1, u2, stream.next()});
    }
    return points;
}

std::array<double, 2> gather_shift(const std::array<double, 2>& random, std::size_t lane) {
    constexpr double spread = 1. / 8;
    // Fractional parts of multiples of the plastic number's powers are even in two dimensions.
    const auto i = static_cast<double>(lane);
    return {fraction(random[0] + spread * fraction(0.7548776662466927 * i)),
            fraction(random[1] + spread * fraction(0.5698402909980532 * i))};
}

GatherLanes::GatherLanes(const PointTile& tile, std::span<const std::array<double, 2>> shifts) {
    Frame frame;  // most receivers of a tile face alike
    for (std::size_t i = 0; i < tile.receivers.size(); ++i) {
        const Vec3 normal{tile.normal_x[i], tile.normal_y[i], tile.normal_z[i]};
        if (i == 0 || normal != frame.w) frame = Frame::around(normal);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            u[axis][i] = static_cast<float>(frame.u[axis]);
            v[axis][i] = static_cast<float>(frame.v[axis]);
            w[axis][i] = static_cast<float>(frame.w[axis]);
        }
        shift[i] = static_cast<float>(shifts[i][0]);
        const auto turn = static_cast<float>(2 * kPi * shifts[i][1]);
        turn_cos[i] = std::cos(turn);
        turn_sin[i] = std::sin(turn);
        roulette[i] = static_cast<float>(fraction(16 * (shifts[i][0] + shifts[i][1])));
    }
}

void GuessGather::set_rays(const PointTile& tile, const GatherLanes& lanes, const GatherPoint& u,
                           RayPacket& packet, Floats& cosine) const {
    packet.origin_x = tile.lifted_x;
    packet.origin_y = tile.lifted_y;
    packet.origin_z = tile.lifted_z;
    packet.end.fill(std::numeric_limits<float>::infinity());
    const double azimuth = 2 * kPi * u[1];
    const DiskDirection disk{static_cast<float>(u[0]), static_cast<float>(std::cos(azimuth)),
                             static_cast<float>(std::sin(azimuth))};
    set_directions(lanes, disk, packet, cosine);
    avoid_tiny_components(packet);
}

void GuessGather::add_round(const PointTile& tile, const GatherLanes& lanes, const GatherPoint& u,
                            math::RandomKey key, std::uint64_t round, const Shares& shares,
                            Sums& sums) const {
    rays::RayHitPacket packet;
    alignas(64) Floats cosine;
    set_rays(tile, lanes, u, packet.ray, cosine);
    LaneMask used{};
    std::fill_n(used.begin(), tile.receivers.size(), -1);
    GuessedLight light;
    guess_.look(packet, used, rays::Coherence::coherent, light);
    for (std::size_t i = 0; i < tile.receivers.size(); ++i) {
        // Infinite where a point lies in the surface that its ray meets.
        const float g_over_k =
            light.cosine[i] > 0
                ? cosine[i] * light.cosine[i] / (packet.ray.end[i] * packet.ray.end[i]) * tile.inverse_k[i]
                : 0;
        const Rgb gathered = gathered_cd_m2(light, i, g_over_k, shares, sums);
        for (std::size_t b = 0; b < kBands; ++b) sums.guessed[b][i] += static_cast<float>(gathered[b]);
        double largest = std::abs(gathered.luminance());
        const Continuation continuation = continuation_of(light, i, double{g_over_k});
        if (fraction(u[2] + double{lanes.roulette[i]}) < continuation.probability) {
            const Vec3 direction = normalized(
                Vec3{packet.ray.direction_x[i], packet.ray.direction_y[i], packet.ray.direction_z[i]});
            const transport::LightSum found = missing(tile.receivers[i], direction, light, i, continuation,
                                                      math::SampleStream(key.derived(i), round, 0));
            sums.found[i] += found.whole;
            add_shares(found, sums.shares[i]);
            ++sums.continued;
            largest = std::max(largest, std::abs(found.whole.luminance()));
        }
        sums.largest[i] = std::max(sums.largest[i], largest);
    }
}

Rgb GuessGather::gathered_cd_m2(const GuessedLight& light, std::size_t lane, float g_over_k,
                                const Shares& shares, Sums& sums) const {
    std::vector<Rgb>& of_lane = sums.shares[lane];
    if (guess_.channels()) of_lane.resize(guess_.channels()->count());
    const std::uint32_t side = light.sides[lane];
    const Rgb luminance = light.luminance_of(lane);
    if (side == patches::kNoSide) return luminance;
    const Sight sight = shares.sights.empty() ? Sight::uncertain : shares.sights[side];
    const double by_rays = sight == Sight::uncertain ? double{1 - 1 / (1 + shares.split * g_over_k)} : 1;
    guess_.add_shares(side, light.barycentric_of(lane), by_rays, of_lane);
    if (sight != Sight::certain) return luminance * by_rays;
    guess_.add_shares(side, LightGuess::kMiddle, -1, of_lane);
    return luminance + -1. * guess_.luminance_at(side, LightGuess::kMiddle);
}

void GuessGather::flush(const PointTile& tile, const Sums& sums, double weight, Tally& readings) const {
    readings.continued += sums.continued;
    for (std::size_t i = 0; i < tile.receivers.size(); ++i) {
        const Rgb per_ray = tile.response_of(i) * (kPi * weight);
        Rgb sum = sums.found[i];
        for (std::size_t b = 0; b < kBands; ++b) sum[b] += double{sums.guessed[b][i]};
        readings.add(tile.readings[i], per_ray * sum, per_ray.luminance() * sums.largest[i]);
        if (guess_.channels())
            guess_.channels()->add(std::span(sums.shares[i]), per_ray, tile.receivers[i].reflections(),
                                   tile.readings[i], readings.parts);
    }
}

void GuessGather::add(const transport::LightSum& light, const transport::Receiver& receiver,
                      Tally& readings) const {
    readings.add(receiver.reading(), light.whole);
    if (guess_.channels())
        guess_.channels()->add(std::span(light.shares), Rgb::grey(1), receiver.reflections(),
                               receiver.reading(), readings.parts);
}

void GuessGather::add_general_round(const PointTile& tile, math::RandomKey key, std::uint64_t round,
                                    Tally& readings) const {
    rays::RayHitPacket packet;
    LaneMask used{};
    std::array<transport::Receiver::Sample, kPacketWidth> samples;
    for (std::size_t i = 0; i < tile.receivers.size(); ++i) {
        const auto [u1, u2] = math::SampleStream(key.derived(i), round, 2).next_two();
        const auto sample = tile.receivers[i].sample(u1, u2);
        if (!sample) continue;
        used[i] = -1;
        samples[i] = *sample;
        packet.ray.set(i, tile.receivers[i].lifted() - caster_.center(), sample->direction,
                       std::numeric_limits<float>::infinity());
    }
    GuessedLight light;
    guess_.look(packet, used, rays::Coherence::scattered, light);
    for (std::size_t i = 0; i < tile.receivers.size(); ++i) {
        if (used[i] == 0) continue;
        const transport::Receiver& receiver = tile.receivers[i];
        const Vec3& direction = samples[i].direction;
        const double distance = packet.ray.end[i];
        const double g_over_k = light.cosine[i] > 0
                                    ? receiver.sensitivity(direction) * double{light.cosine[i]} /
                                          (distance * distance) * double{tile.inverse_k[i]} *
                                          receiver.response(direction).relative
                                    : 0;
        const Continuation continuation = continuation_of(light, i, g_over_k);
        math::SampleStream stream(key.derived(kPacketWidth + i), round, 0);
        transport::LightSum luminance = guess_.seen(light, i);
        if (stream.next() < continuation.probability)
            luminance.add(missing(receiver, direction, light, i, continuation, stream), Rgb::grey(1));
        add(luminance *= samples[i].weight, receiver, readings);
    }
}

transport::LightSum GuessGather::traced(const transport::Receiver& receiver,
                                        math::SampleStream stream) const {
    transport::LightSum light(guess_.channels());
    const auto [u1, u2] = stream.next_two();
    const auto sample = receiver.sample(u1, u2);
    if (!sample) return light;
    const auto hit = caster_.closest(receiver.lifted(), sample->direction);
    if (!hit) return light;
    light.add_sample(sample->weight, [&](auto* parts) {
        return tracer_.luminance_without_direct(*hit, sample->direction, transport::kUnlimited, stream,
                                                parts);
    });
    return light;
}

auto GuessGather::continuation_of(const GuessedLight& light, std::size_t lane, double g_over_k) const
    -> Continuation {
    if ((light.traced_lanes >> lane & 1u) != 0) return {{}, 1, true};
    const std::uint32_t side = light.sides[lane];
    if (side == patches::kNoSide) return {{}, 0, false};
    const materials::SplitMaterial& material = guess_.material(side);
    const PartShares shares(g_over_k, material);
    return {shares, continuation_probability(material, shares), false};
}

transport::LightSum GuessGather::missing(const transport::Receiver& receiver, const Vec3& direction,
                                         const GuessedLight& light, std::size_t lane,
                                         const Continuation& continuation, math::SampleStream stream) const {
    const auto& [shares, probability, is_traced] = continuation;
    if (!is_traced && !guess_.material(light.sides[lane]).gloss) {
        transport::LightSum missing =
            residual_.missing_cd_m2(light.sides[lane], light.barycentric_of(lane), stream);
        return missing *= Rgb::grey(shares.diffuse() / probability);
    }
    const auto hit = caster_.closest(receiver.lifted(), direction);
    if (is_traced) {
        transport::LightSum all(guess_.channels());
        if (hit)
            all.add_sample(Rgb::grey(1), [&](auto* parts) {
                return tracer_.luminance_without_direct(*hit, direction, transport::kUnlimited, stream,
                                                        parts);
            });
        return all;
    }
    transport::LightSum luminance = guess_.seen(light, lane);
    luminance *= Rgb::grey(-shares.diffuse());
    if (hit)
        luminance.add(reflected_luminance(tracer_, *hit, -direction, guess_.material(hit->material), shares,
                                          stream, guess_.channels()),
                      Rgb::grey(1));
    return luminance *= Rgb::grey(1 / probability);
}

}  // namespace stilb::estimators
