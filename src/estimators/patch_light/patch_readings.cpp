
#include "estimators/patch_light/patch_readings.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "transport/direct/one_receiver.h"

namespace stilb::estimators {

namespace {

/// Rays from each point: a step of the light costs far more than a ray.
constexpr std::uint64_t kRaysPerSample = 4;
constexpr double kShare = 1.0 / kRaysPerSample;
/// A comparison's path costs about as much as so many rays to the patches.
constexpr double kRaysPerPath = 10;
/// Comparisons of a sample, and samples of a comparison, at most.
constexpr double kMostComparisons = 64, kMostSamples = 4;

}  // namespace

PatchReadings::PatchReadings(const PatchTransport& transport, std::span<const Measurand> measurands,
                             double rays_per_sample, const Monitor& monitor)
    : transport_(transport),
      monitor_(monitor),
      tracer_(transport.scene, transport.caster, transport.lights),
      known_part_(measurands.size()),
      sight_ends_(measurands.size()) {
    for (std::uint32_t reading = 0; reading < measurands.size(); ++reading) {
        add_reading(reading, measurands[reading]);
    }
    points_ = sorted_receivers(std::move(points_));
    add_shares();
    // As much time for comparisons as for the light itself.
    const double readings = static_cast<double>(std::max<std::size_t>(measurands.size(), 1));
    const double paths = (rays_per_sample / readings + double{kRaysPerSample}) / kRaysPerPath;
    comparisons_ = static_cast<std::uint64_t>(std::clamp(paths, 1.0, kMostComparisons));
    samples_per_comparison_ = static_cast<std::uint64_t>(std::clamp(1 / paths, 1.0, kMostSamples));
}

void PatchReadings::add_reading(std::uint32_t reading, const Measurand& measurand) {
    const rays::RayCaster& caster = transport_.caster;
    if (auto receiver = transport::receiver_of_illuminance(reading, measurand, caster)) {
        points_.push_back(*receiver);
        known_part_[reading] = direct_from_points(points_.back(), caster, transport_.lights);
        return;
    }
    const transport::VisibleSurfaces sight =
        trace_line_of_sight(measurand, transport_.scene, caster, transport_.lights, transport::kUnlimited);
    known_part_[reading] = sight.emission_cd_m2;
    sight_ends_[reading] = sight.end;
    for (const transport::FaintRay& branch : sight.faint) faint_.push_back({reading, branch});
    std::vector<ViewedHit> points;
    for (const transport::SubPoint& sub_point : sight.sub_points) {
        points.push_back({sub_point.surface, sub_point.outgoing});
    }
    const auto locations = find_patch_locations(transport_.patch_caster, points);
    for (std::size_t i = 0; i < locations.size(); ++i) {
        if (!locations[i]) continue;
        views_.push_back(
            {reading, sight.sub_points[i].transmission, *locations[i], points[i].hit, points[i].outgoing});
    }
}

void PatchReadings::add_shares() {
    std::vector<patches::VertexInterpolation::PatchPoint> locations;
    for (const View& view : views_) {
        locations.push_back({transport_.patches.patch_of(view.seen.side), view.seen.barycentric});
    }
    auto shares = transport_.interpolation.shares_of(locations);
    for (std::size_t i = 0; i < views_.size(); ++i) {
        views_[i].shares = std::move(shares[i]);
        views_[i].known = first_reflected(views_[i]);
        known_part_[views_[i].reading] += views_[i].transmission * views_[i].known;
    }
}

template <typename Visit>
void PatchReadings::for_each_share(const View& view, const Visit& visit) const {
    const patches::Patches& patches = transport_.patches;
    const bool front = patches.is_front(view.seen.side);
    for (const auto& [patch, weight] : view.shares) visit(front ? patch : patches.other_side(patch), weight);
}

Rgb PatchReadings::first_reflected(const View& view) const {
    Rgb luminance;
    for_each_share(view, [&](std::uint32_t side, double weight) {
        luminance += transport_.first_reflected(side, view.outgoing) * weight;
    });
    return luminance;
}

void PatchReadings::add(const PatchLight& light, math::KeyOf<Stream> key, std::uint64_t sample,
                        Tally& sums) const {
    const math::RandomKey key_of_views = key.derived(Stream::views).derived(sample);
    for (std::size_t i = 0; i < views_.size(); ++i) {
        monitor_.require_more();
        const View& view = views_[i];
        sums.add(view.reading, view.transmission * sampled_luminance(light, view, key_of_views.derived(i)));
    }
    const math::RandomKey key_of_faint = key.derived(Stream::faint);
    for (std::size_t i = 0; i < faint_.size(); ++i) {
        const auto& [reading, branch] = faint_[i];
        math::SampleStream stream(key_of_faint.derived(i), sample);
        sums.add(reading,
                 branch.transmission * tracer_.incoming_luminance({branch.origin, branch.direction}, {},
                                                                  transport::kUnlimited, stream));
    }
    for_each_packet([&](std::size_t first, std::span<const transport::Receiver> points) {
        for (std::uint64_t ray = 0; ray < kRaysPerSample; ++ray) {
            add_illuminances(
                light, points,
                math::SampleStream(key.derived(Stream::points).derived(first), kRaysPerSample * sample + ray),
                sums);
        }
    });
    if (sample % samples_per_comparison_ == 0) {
        for (std::uint64_t path = 0; path < comparisons_; ++path) {
            compare(light, {key.derived(Stream::comparisons)}, comparisons_ * sample + path, sums);
        }
    }
}

template <typename Visit>
void PatchReadings::for_each_packet(const Visit& visit) const {
    for (std::size_t first = 0; first < points_.size(); first += kPacketWidth) {
        monitor_.require_more();
        const std::size_t count = std::min<std::size_t>(kPacketWidth, points_.size() - first);
        visit(first, std::span(points_).subspan(first, count));
    }
}

void PatchReadings::compare(const PatchLight& light, math::KeyOf<Stream> key, std::uint64_t number,
                            Tally& sums) const {
    sums.begin_comparison();
    for (std::size_t i = 0; i < views_.size(); ++i) {
        monitor_.require_more();
        const View& view = views_[i];
        const math::RandomKey own_key = key.derived(Stream::views).derived(i);
        math::SampleStream stream(own_key, number);
        const Rgb traced =
            tracer_.luminance_behind(view.hit, -view.outgoing, {}, transport::kUnlimited, stream);
        const Rgb of_patches = view.known + sampled_luminance(light, view, own_key.derived(number));
        sums.add_lacking(view.reading, view.transmission * (traced + -1 * of_patches));
    }
    for_each_packet([&](std::size_t first, std::span<const transport::Receiver> points) {
        const math::RandomKey own_key = key.derived(Stream::points).derived(first);
        math::SampleStream directions(own_key, number);
        const auto [u1, u2] = directions.next_two();
        const GatheredRays rays = gather(light, points, u1, u2);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!rays[i]) continue;
            const auto hit = transport_.caster.closest(points[i].lifted(), rays[i]->direction);
            math::SampleStream stream(own_key.derived(i), number);
            const Rgb traced = hit ? tracer_.luminance_without_direct(*hit, rays[i]->direction,
                                                                      transport::kUnlimited, stream)
                                   : Rgb{};
            sums.add_lacking(points[i].reading(), rays[i]->weight * (traced + -1 * rays[i]->luminance_cd_m2));
        }
    });
}

Rgb PatchReadings::sampled_luminance(const PatchLight& light, const View& view, math::RandomKey key) const {
    Rgb luminance = transport_.first_reflected_at(view.seen.side, view.hit.position, key, view.outgoing);
    for_each_share(view, [&](std::uint32_t side, double weight) {
        luminance += light.reflected(side, view.outgoing) * weight;
    });
    return luminance;
}

void PatchReadings::add_illuminances(const PatchLight& light, std::span<const transport::Receiver> points,
                                     math::SampleStream stream, Tally& sums) const {
    const auto [u1, u2] = stream.next_two();
    const GatheredRays rays = gather(light, points, u1, u2);
    for (std::size_t i = 0; i < points.size(); ++i) {
        sums.add(points[i].reading(),
                 kShare * sample_direct_from_areas(points[i], transport_.caster, transport_.lights, stream));
        if (rays[i]) sums.add(points[i].reading(), kShare * rays[i]->weight * rays[i]->luminance_cd_m2);
    }
}

/// The rays have one direction in the frames of their points, so that they are coherent.
auto PatchReadings::gather(const PatchLight& light, std::span<const transport::Receiver> points, double u1,
                           double u2) const -> GatheredRays {
    const Vec3& center = transport_.patches.center;
    RayPacket packet;
    LaneMask lanes{};
    GatheredRays rays;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto sample = points[i].sample(u1, u2);
        if (!sample) continue;
        rays[i] = {sample->direction, sample->weight, {}};
        packet.set(i, points[i].lifted() - center, sample->direction, std::numeric_limits<float>::infinity());
        lanes[i] = -1;
    }
    const auto sides = transport_.patch_caster.closest(packet, lanes).sides;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (sides[i] == patches::kNoSide) continue;
        const Vec3 out = -rays[i]->direction;
        const Vec3 met = points[i].lifted() - double{packet.end[i]} * out;
        rays[i]->luminance_cd_m2 = light.reflected(sides[i], out) +
                                   transport_.first_reflected(sides[i], out) +
                                   transport_.first_reflected_at(sides[i], met, {}, out);
    }
    return rays;
}

VisibleSides::VisibleSides(const PatchTransport& transport, const Vec3& camera)
    : transport_(transport),
      camera_(camera),
      are_backs_seen_(std::ranges::any_of(transport.scene.materials,
                                          [](const auto& named) { return is_specular(named.material); })),
      first_(2 * transport.patches.count()) {
    for_each([&](std::uint32_t side, const Vec3& out) {
        first_[side] = to_float_rgb(transport.first_reflected(side, out));
    });
}

void VisibleSides::add(const PatchLight& light, std::vector<FloatRgb>& sums_cd_m2) const {
    for_each(
        [&](std::uint32_t side, const Vec3& out) { add_to(sums_cd_m2[side], light.reflected(side, out)); });
}

std::vector<FloatRgb> VisibleSides::mean_cd_m2(const std::vector<FloatRgb>& sums_cd_m2, double lights) const {
    std::vector<FloatRgb> means = first_;
    for (std::size_t side = 0; side < means.size(); ++side) {
        add_to(means[side], to_rgb(sums_cd_m2[side]) * (1 / lights));
    }
    return means;
}

PatchPass::PatchPass(const PictureTracing& tracing, const PatchTransport& transport, const Pass& pass,
                     const std::vector<FloatRgb>& sides_cd_m2)
    : tracing_(tracing), transport_(transport), pass_(pass) {
    std::vector<Rgb> values;
    values.reserve(sides_cd_m2.size());
    std::ranges::transform(sides_cd_m2, std::back_inserter(values), to_rgb);
    const std::span<const Rgb> all(values);
    fronts_ = transport.interpolation.at_vertices(all.first(transport.patches.count()));
    backs_ = transport.interpolation.at_vertices(all.subspan(transport.patches.count()));
}

void PatchPass::sample(const PixelBlock& block, Tally& sums) const {
    CameraPaths started = tracing_.start_paths(pixels_of(block), pass_);
    std::vector<transport::Path>& paths = started.paths;
    std::vector<std::size_t> standing;
    std::vector<ViewedHit> points;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        if (!tracing_.tracer.follow_to_scattering(paths[i])) continue;
        standing.push_back(i);
        points.push_back({paths[i].hit, paths[i].outgoing});
    }
    const auto locations = find_patch_locations(transport_.patch_caster, points);
    for (std::size_t i = 0; i < locations.size(); ++i) {
        transport::Path& path = paths[standing[i]];
        if (locations[i]) path.luminance_cd_m2 += path.throughput * reflected(path, *locations[i]);
    }
    started.add_to(sums);
}

Rgb PatchPass::reflected(const transport::Path& path, const PatchLocation& seen) const {
    const bool is_front = transport_.patches.is_front(seen.side);
    const std::span<const Rgb> vertices(is_front ? fronts_ : backs_);
    return transport_.interpolation.at(vertices, transport_.patches.patch_of(seen.side), seen.barycentric) +
           transport_.first_reflected_at(seen.side, path.hit.position, {}, path.outgoing);
}

}  // namespace stilb::estimators
