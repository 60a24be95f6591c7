#include "estimators/gather.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "base/sampling.h"
#include "estimators/kernel_split.h"

namespace stilb {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

void Gather::collect(const Batch& batch, ReadingSums& sums) const {
    for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
        const RandomKey key = batch.key.derived(tile);
        const std::uint64_t chains = plans_[tile * kPacketWidth].chains_per_ray;
        for (std::uint64_t i = batch.first / chains; i < (batch.first + batch.count) / chains; ++i) {
            trace_round(tile, key, i, static_cast<double>(chains), sums);
        }
    }
}

void Gather::trace_round(std::size_t tile, RandomKey key, std::uint64_t round, double weight,
                         ReadingSums& sums) const {
    const std::span<const PackedPoint> points =
        points_.subspan(tile * kPacketWidth).first(static_cast<std::size_t>(tiles_[tile].count));
    // Consecutive Sobol' points: the rays of a round are spread evenly by themselves. Which ray has which is
    // drawn: the low digits of the index tell the cell that every coordinate lies in, and each ray needs all.
    constexpr std::uint64_t rotations = 0;
    const std::uint64_t rotation = random_block(key.derived(rotations), round, 0)[0];
    std::vector<SampleStream> streams;
    streams.reserve(points.size());
    HitPacket packet;
    LaneMask lanes{};
    std::array<Vec3, kPacketWidth> directions;
    for (std::size_t i = 0; i < points.size(); ++i) {
        SampleStream& stream =
            streams.emplace_back(key, round * points.size() + (i + rotation) % points.size());
        const auto [u1, u2] = stream.next_two();
        directions[i] = Frame::around(points[i].normal).to_world(sample_cosine_hemisphere(u1, u2).direction);
        packet.rays.set(static_cast<int>(i), points[i].lifted - caster_.center(), directions[i]);
        lanes[i] = -1;
    }
    caster_.closest(packet, lanes);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (packet.object[i] == HitPacket::kNone) continue;
        const int lane = static_cast<int>(i);
        const Hit hit = caster_.hit_of(packet, lane);
        if (is_specular(scene_.material(hit.material))) {
            const Spectrum luminance =
                tracer_.luminance_without_direct(hit, directions[i], max_reflections_, streams[i]);
            sums.add(points[i].reading, weight * kPi * luminance);
        } else {
            share_out(hit, tiles_[tile], lane, streams[i], weight, sums);
        }
    }
}

void Gather::share_out(const Hit& hit, const PointTile& tile, int own_lane, SampleStream& stream,
                       double weight, ReadingSums& sums) const {
    RayPacket segments;
    LaneMask lanes;
    alignas(64) PointTile::Floats g_per_m2;
    connect(SegmentOrigin(hit.position, hit.lifted, hit.normal, caster_.center()), tile, segments, lanes,
            g_per_m2);
    const auto own = static_cast<std::size_t>(own_lane);
    if (max_reflections_ == 0 || lanes[own] == 0) return;
    const Material& material = scene_.material(hit.material);
    const double concentration = mean_concentration(material);
    const auto share = [&](std::size_t lane) {
        return GatheredShare{double{g_per_m2[lane]} * double{tile.inverse_k[lane]}};
    };
    // Russian roulette with what 1 - w is on average over the ways of the light.
    double survival = 0;
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (lanes[i] != 0) survival = std::max(survival, share(i)(concentration));
    }
    if (stream.next() >= survival) return;
    // The own ray has shown that its point sees y.
    lanes[own] = 0;
    caster_.occlude(segments, lanes);
    lanes[own] = -1;
    double density_per_m2 = 0;
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (segments.end[i] < 0) lanes[i] = 0;
        if (lanes[i] != 0) density_per_m2 += double{g_per_m2[i]} / kPi;
    }

    const auto light = tracer_.sample_light(hit, stream);
    const Frame frame = Frame::around(hit.normal);
    std::array<Vec3, kPacketWidth> out;
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (lanes[i] == 0) continue;
        out[i] = frame.to_local(
            normalized(Vec3{segments.direction_x[i], segments.direction_y[i], segments.direction_z[i]}));
    }
    const auto add = [&](const Vec3& towards, const Spectrum& per_density) {
        const Vec3 in = frame.to_local(towards);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            if (lanes[i] == 0) continue;
            const Spectrum brdf = evaluate_brdf_per_sr(material, in, out[i]);
            const double kernel = double{g_per_m2[i]} * share(i)(relative_brdf(material, brdf)) * in.z;
            sums.add(tile.reading[i], per_density * brdf * (weight * kernel / survival));
        }
    };
    if (light) add(light->direction, light->normal_illuminance_lx * (1 / density_per_m2));
    const auto beam = tracer_.sample_beam(hit, frame.to_world(out[own]), max_reflections_ - 1, stream);
    if (beam) {
        const Vec3 in = frame.to_local(beam->direction);
        double density = 0;  // of y and the beam's direction, over all rays that could have made both
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            if (lanes[i] != 0) density += double{g_per_m2[i]} / kPi * pdf_per_sr(material, out[i], in);
        }
        if (density > 0) add(beam->direction, beam->luminance_cd_m2 * (1 / density));
    }
}

}  // namespace stilb
