#include "estimators/patch_readings.h"

#include <algorithm>
#include <limits>

#include "estimators/direct_light.h"

namespace stilb {
namespace {

/// From each point: a step of the light costs far more than a ray.
constexpr std::uint64_t kRaysPerSample = 4;
constexpr double kShare = 1.0 / kRaysPerSample;

}  // namespace

PatchReadings::PatchReadings(const PatchTransport& transport, std::span<const Measurand> measurands)
    : transport_(transport), known_part_(measurands.size()) {
    for (std::uint32_t reading = 0; reading < measurands.size(); ++reading) {
        add_reading(reading, measurands[reading]);
    }
    points_ = sorted_receivers(std::move(points_));
    add_shares();
}

void PatchReadings::add_reading(std::uint32_t reading, const Measurand& measurand) {
    const RayCaster& caster = transport_.caster;
    if (const auto* point = std::get_if<MeasuringPoint>(&measurand)) {
        points_.emplace_back(reading, *point, caster);
        known_part_[reading] = direct_from_points(points_.back(), caster, transport_.lights);
        return;
    }
    const Sight sight = look(measurand, transport_.scene, caster, transport_.lights, kUnlimited);
    known_part_[reading] = sight.emission_cd_m2;
    for (const SubPoint& sub_point : sight.sub_points) {
        const auto seen = find_place(transport_.patch_caster, sub_point.surface, sub_point.outgoing);
        if (!seen) continue;
        views_.push_back(
            {reading, sub_point.transmission, *seen, sub_point.surface.position, sub_point.outgoing});
    }
}

void PatchReadings::add_shares() {
    std::vector<VertexInterpolation::Place> places;
    for (const View& view : views_) {
        places.push_back({transport_.patches.patch_of(view.seen.side), view.seen.place});
    }
    auto shares = transport_.interpolation.shares_of(places);
    for (std::size_t i = 0; i < views_.size(); ++i) views_[i].shares = std::move(shares[i]);
}

void PatchReadings::add(const PatchLight& light, RandomKey key, std::uint64_t sample,
                        ReadingSums& sums) const {
    for (const View& view : views_) add_luminance(light, view, sums);
    for (std::size_t first = 0; first < points_.size(); first += kPacketWidth) {
        const std::size_t count = std::min<std::size_t>(kPacketWidth, points_.size() - first);
        for (std::uint64_t ray = 0; ray < kRaysPerSample; ++ray) {
            add_illuminances(light, std::span(points_).subspan(first, count),
                             SampleStream(key.derived(first), kRaysPerSample * sample + ray), sums);
        }
    }
}

void PatchReadings::add_luminance(const PatchLight& light, const View& view, ReadingSums& sums) const {
    const Patches& patches = transport_.patches;
    const bool front = patches.is_front(view.seen.side);
    Spectrum luminance = transport_.first_reflected_at(view.seen.side, view.position, view.outgoing);
    for (const auto& [patch, weight] : view.shares) {
        luminance += light.reflected(front ? patch : patches.other_side(patch), view.outgoing) * weight;
    }
    sums.add(view.reading, view.transmission * luminance);
}

/// The rays have one direction in the frames of their points, so that they are coherent.
void PatchReadings::add_illuminances(const PatchLight& light, std::span<const Receiver> points,
                                     SampleStream stream, ReadingSums& sums) const {
    const Vec3& center = transport_.patches.center;
    const auto [u1, u2] = stream.next_two();
    RayPacket packet;
    LaneMask lanes{};
    std::array<Receiver::Sample, kPacketWidth> samples;
    for (std::size_t i = 0; i < points.size(); ++i) {
        sums.add(points[i].reading(),
                 kShare * sample_direct_from_areas(points[i], transport_.caster, transport_.lights, stream));
        const auto sample = points[i].sample(u1, u2);
        if (!sample) continue;
        samples[i] = *sample;
        packet.set(i, points[i].lifted() - center, sample->direction, std::numeric_limits<float>::infinity());
        lanes[i] = -1;
    }
    const auto sides = transport_.patch_caster.closest(packet, lanes).sides;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (sides[i] == kNoSide) continue;
        const Vec3 out = -samples[i].direction;
        const Vec3 met = points[i].lifted() - double{packet.end[i]} * out;
        sums.add(points[i].reading(),
                 kShare * samples[i].weight *
                     (light.reflected(sides[i], out) + transport_.first_reflected_at(sides[i], met, out)));
    }
}

}  // namespace stilb
