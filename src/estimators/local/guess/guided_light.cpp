#include "estimators/local/guess/guided_light.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "estimators/limits.h"

namespace stilb::estimators {
namespace {

/// Paths of the residual for each sample of readings, and the number of their vertices that are connected.
constexpr std::uint64_t kPathsPerSample = 32;
constexpr std::uint64_t kVerticesPerSample = 8;
/// The largest extent of tiles that share a choice of points and vertices, over half of the scene's.
constexpr double kGroupExtent = 0.1;
/// Receivers of a group for which points and vertices are chosen, at least.
constexpr std::size_t kSpread = 4;
/// Samples whose vertices are selected together, at most.
constexpr std::uint64_t kSamplesTogether = 64;
/// Paths that show that a receiver is lit, and that it is not.
constexpr std::uint64_t kPathsToLight = 8, kPathsToDark = 256;

bool is_even(const transport::Receiver& receiver) {
    return receiver.constant_response() && !receiver.is_body();
}
bool are_even(std::span<const transport::Receiver> receivers) {
    return std::ranges::all_of(receivers, is_even);
}

}  // namespace

std::unique_ptr<GuidedLight> GuidedLight::make(const Problem& problem, const transport::LightSampler& lights,
                                               const transport::PathTracer& tracer, math::KeyOf<Stream> key) {
    if (problem.max_reflections != transport::kUnlimited || !(surface_area_m2(problem.scene) > 0))
        return nullptr;
    return std::make_unique<GuidedLight>(problem.scene, problem.caster, lights, tracer, key, problem.channels,
                                         problem.monitor);
}

GuidedLight::GuidedLight(const Scene& scene, const rays::RayCaster& all,
                         const transport::LightSampler& lights, const transport::PathTracer& tracer,
                         math::KeyOf<Stream> key, const transport::Channels* channels, const Monitor& monitor)
    : caster(all),
      finds_all_by_rays(!has_light_for_light_paths_only(scene)),
      dark_key(key.derived(Stream::dark)),
      samples_together(std::max<std::uint64_t>(
          1, paths_at_once(scene, kSamplesTogether * kPathsPerSample) / kPathsPerSample)),
      direct(scene, all, lights),
      guess(scene, all, direct, tracer, {key.derived(Stream::guess)}, channels, monitor),
      residual(scene, all, lights, direct, tracer, guess, key.derived(Stream::pilot), monitor),
      points(guess, all, residual.area_m2()),
      gather(all, tracer, guess, residual),
      sides(scene, guess, all) {}

auto GuidedLight::divide(std::span<const transport::Receiver> receivers) const -> Divided {
    Divided divided;
    for (const transport::Receiver& receiver : receivers) {
        if (is_even(receiver)) {
            divided.even.push_back(receiver);
            continue;
        }
        if (!receiver.material() || receiver.is_bent()) {
            divided.general.push_back(receiver);
            continue;
        }
        const materials::SplitMaterial& parts = guess.material(*receiver.material());
        if (parts.diffuse_reflectance.max() > 0)
            divided.even.push_back(receiver.with_material(parts.diffuse));
        if (parts.gloss) divided.general.push_back(receiver.with_material(*parts.gloss));
    }
    return divided;
}

std::size_t GuidedLight::put_dark_last(std::vector<transport::Receiver>& receivers,
                                       const Monitor& monitor) const {
    if (!finds_all_by_rays) return 0;
    const auto finds_light = [&](std::size_t j, std::uint64_t paths) {
        for (std::uint64_t i = 0; i < paths; ++i) {
            if (gather.traced(receivers[j], math::SampleStream(dark_key.derived(j), i, 2)).whole.max() > 0)
                return true;
        }
        return false;
    };
    // Some of each sixteen neighbours first: where these are lit, and those of the neighbours are, all are.
    const std::size_t tiles = (receivers.size() + kPacketWidth - 1) / kPacketWidth;
    const auto for_tiles = [&](const auto& look) {
        const auto look_at_part = [&](std::size_t begin, std::size_t end) {
            monitor.require_more();
            for (std::size_t t = begin; t < end; ++t)
                look(t, t * kPacketWidth, std::min((t + 1) * kPacketWidth, receivers.size()));
        };
        parallel_for_parts(tiles, look_at_part, 16);
    };
    std::vector<std::uint8_t> has_dark(tiles), is_dark(receivers.size());
    for_tiles([&](std::size_t t, std::size_t first, std::size_t last) {
        for (std::size_t j = first; j < last; j += 5)
            has_dark[t] = has_dark[t] != 0 || !finds_light(j, kPathsToLight) ? 1 : 0;
    });
    for_tiles([&](std::size_t t, std::size_t first, std::size_t last) {
        constexpr std::size_t around = 2;
        const auto begin = has_dark.begin() + static_cast<std::ptrdiff_t>(t - std::min(t, around));
        const auto end = has_dark.begin() + static_cast<std::ptrdiff_t>(std::min(tiles, t + around + 1));
        if (std::find(begin, end, 1) == end) return;
        for (std::size_t j = first; j < last; ++j)
            is_dark[j] = is_even(receivers[j]) && !finds_light(j, kPathsToDark) ? 1 : 0;
    });
    const auto count = static_cast<std::size_t>(std::ranges::count(is_dark, 1));
    if (count == 0 || 2 * count > receivers.size()) return 0;
    std::vector<transport::Receiver> sorted;
    for (const bool dark : {false, true}) {
        for (std::size_t j = 0; j < receivers.size(); ++j) {
            if ((is_dark[j] != 0) == dark) sorted.push_back(receivers[j]);
        }
    }
    receivers = std::move(sorted);
    return count;
}

std::vector<PointTile> GuidedLight::tiles(std::span<const transport::Receiver> receivers,
                                          std::size_t points_at_once) const {
    return tiles_of(receivers, std::vector<double>(receivers.size(), k_per_m2(points_at_once)), caster,
                    transport::kUnlimited, transport::VertexChoice::by_kernel);
}

GuidedReadings::GuidedReadings(const GuidedLight& light, std::span<const transport::Receiver> receivers,
                               std::size_t dark, const Monitor& monitor)
    : light_(light),
      divided_(are_even(receivers) ? GuidedLight::Divided{} : light.divide(receivers)),
      even_(are_even(receivers) ? receivers : divided_.even),
      lit_(even_.size() - dark),
      tiles_(light.tiles(even_.first(lit_), kPoints)),
      general_tiles_(light.tiles(divided_.general, kPoints)),
      groups_(groups_of(tiles_, kGroupExtent * light.caster.half_extent_m())),
      general_groups_(groups_of(general_tiles_, kGroupExtent * light.caster.half_extent_m())),
      monitor_(monitor) {
    make_sources();
}

void GuidedReadings::make_sources() {
    std::vector<CertainSides::Group> receivers;
    for (const Group& group : groups_) {
        const std::size_t first = group.first * kPacketWidth,
                          last = std::min(group.last * kPacketWidth, lit_);
        receivers.push_back(even_.subspan(first, last - first));
    }
    std::vector<Sights> sights = light_.sides.find(receivers);
    known_.resize(lit_);
    if (light_.guess.channels()) known_shares_.resize(lit_);
    sources_.reserve(groups_.size());
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        monitor_.require_more();
        const CertainLight certain(light_.guess, sights[g]);
        double certain_lx = 0;
        for (std::size_t t = groups_[g].first; t < groups_[g].last; ++t) {
            const auto lx = certain.illuminances_lx(tiles_[t]);
            for (std::size_t i = 0; i < tiles_[t].receivers.size(); ++i) {
                const auto received = [&](const CertainLight::Illuminances& own) {
                    return Rgb{{own[0][i], own[1][i], own[2][i]}};
                };
                const Rgb response = tiles_[t].response_of(i);
                certain_lx += received(lx[0]).luminance() / static_cast<double>(receivers[g].size());
                known_[t * kPacketWidth + i] = received(lx[0]) * response;
                for (std::size_t c = 1; c < lx.size(); ++c)
                    known_shares_[t * kPacketWidth + i].push_back(received(lx[c]) * response);
            }
        }
        sources_.push_back({light_.points.uncertain_sides(groups_[g].spread, sights[g], certain_lx, kPoints),
                            std::move(sights[g])});
    }
}

void GuidedReadings::add_known(std::span<Rgb> readings, std::span<Rgb> parts) const {
    for (std::size_t j = 0; j < known_.size(); ++j) readings[even_[j].reading()] += known_[j];
    for (std::size_t j = 0; j < known_shares_.size(); ++j)
        light_.guess.channels()->add(std::span<const Rgb>(known_shares_[j]), Rgb::grey(1),
                                     even_[j].reflections(), even_[j].reading(), parts);
}

auto GuidedReadings::groups_of(std::span<const PointTile> tiles, double largest_extent_m)
    -> std::vector<Group> {
    constexpr double parallel = 0.95;
    const auto is_like_first_of = [&](const PointTile& group, const PointTile& tile) {
        const transport::Receiver& first = group.receivers[0];
        return std::ranges::all_of(tile.receivers, [&](const transport::Receiver& receiver) {
            return dot(receiver.normal(), first.normal()) > parallel &&
                   length(receiver.position() - first.position()) < largest_extent_m;
        });
    };
    std::vector<Group> groups;
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        const PointTile* const first = groups.empty() ? nullptr : &tiles[groups.back().first];
        const bool is_near = first && is_like_first_of(*first, *first) && is_like_first_of(*first, tiles[t]);
        if (!is_near) groups.push_back({t, t, {}});
        groups.back().last = t + 1;
    }
    for (Group& group : groups) {
        const PointTile& first = tiles[group.first];
        const std::size_t count = group.last - group.first;
        // If receivers differ, points are chosen for each of them. A receiver that is left out would get the
        // light near to it from few points, with large weights.
        const std::size_t spread = is_like_first_of(first, first)
                                       ? std::clamp(count, kSpread, std::size_t{kPacketWidth})
                                       : first.receivers.size();
        for (std::size_t i = 0; i < spread; ++i) {
            const auto& receivers = tiles[group.first + i * count / spread].receivers;
            group.spread.push_back(receivers[(2 * i + 1) * receivers.size() / (2 * spread)]);
        }
    }
    return groups;
}

void GuidedReadings::collect(const Batch& batch, Tally& sums) const {
    gather(batch, sums);
    gather_general(batch, sums);
    gather_dark(batch, sums);
    connect_residual(batch, sums);
}

double GuidedReadings::rays_per_sample() const {
    // Rays of packets take less time than others.
    constexpr double of_path = 25, of_even = 3, of_general = 12;
    return of_path * static_cast<double>(kPathsPerSample) + of_even * static_cast<double>(even_.size()) +
           of_general * static_cast<double>(divided_.general.size());
}

double GuidedReadings::cost_per_sample(double stands_for) const {
    constexpr double of_path = 80, of_even = 5, of_general = 15;
    return of_path * static_cast<double>(kPathsPerSample) +
           stands_for * (of_even * static_cast<double>(even_.size()) +
                         of_general * static_cast<double>(divided_.general.size()));
}

void GuidedReadings::gather_general(const Batch& batch, Tally& sums) const {
    for (std::size_t t = 0; t < general_tiles_.size(); ++t) {
        monitor_.require_more();
        const math::RandomKey key = batch.key.derived(BatchStream::general_rays).derived(t);
        for (std::uint64_t i = batch.first; i < batch.first + batch.count; ++i)
            light_.gather.add_general_round(general_tiles_[t], key, i, sums);
        sums.rays += batch.count * general_tiles_[t].receivers.size();
    }
}

void GuidedReadings::gather_dark(const Batch& batch, Tally& sums) const {
    for (std::size_t j = lit_; j < even_.size(); ++j) {
        monitor_.require_more();
        const Batch own = batch.of_packet(j / kPacketWidth);
        const math::RandomKey key = batch.key.derived(BatchStream::dark).derived(j);
        for (std::uint64_t i = own.first; i < own.first + own.count; ++i)
            light_.gather.add(light_.gather.traced(even_[j], math::SampleStream(key, i, 2)), even_[j], sums);
        sums.rays += own.count;
    }
}

void GuidedReadings::gather(const Batch& batch, Tally& sums) const {
    for (std::size_t t = 0, group = 0; t < tiles_.size(); ++t) {
        monitor_.require_more();
        if (t == groups_[group].last) ++group;
        const PointTile& tile = tiles_[t];
        const Batch own = batch.of_packet(t);
        if (own.count == 0) continue;
        const auto random = math::SampleStream(batch.key.derived(BatchStream::shift), t, 0).next_two();
        std::array<std::array<double, 2>, kPacketWidth> shifts;
        for (std::size_t i = 0; i < kPacketWidth; ++i) shifts[i] = gather_shift(random, i);
        const GatherLanes lanes(tile, shifts);
        const auto points = gather_points(batch.key.derived(BatchStream::guess_rays), own.first, own.count);
        const Sources& sources = sources_[group];
        GuessGather::Sums tile_sums;
        std::vector<EmittingPoint> connected;
        for (std::uint64_t i = 0; i < own.count; ++i) {
            light_.gather.add_round(tile, lanes, points[i],
                                    batch.key.derived(BatchStream::continued_rays).derived(t), own.first + i,
                                    {sources.sights, sources.points.split}, tile_sums);
            light_.points.select(sources.points,
                                 {fraction(points[i][0] + random[0]), fraction(points[i][1] + random[1])},
                                 connected);
        }
        connect_points(light_.caster, tile, connected, sums, light_.guess.channels());
        light_.gather.flush(tile, tile_sums, 1, sums);
        sums.rays += own.count * tile.receivers.size();
    }
}

void GuidedReadings::connect_residual(const Batch& batch, Tally& sums) const {
    const std::uint64_t end = batch.first + batch.count;
    for (std::uint64_t first = batch.first; first < end; first += light_.samples_together) {
        const std::uint64_t last = std::min(end, first + light_.samples_together);
        std::vector<transport::LightVertex> nodes = light_.residual.trace(
            {batch.key.derived(BatchStream::residual)}, first * kPathsPerSample, last * kPathsPerSample);
        for (transport::LightVertex& node : nodes) node.flux_lm *= 1. / static_cast<double>(kPathsPerSample);
        const NearNodePool pool(nodes, light_.caster.center());
        const math::RandomKey key = batch.key.derived(BatchStream::residual_selection).derived(first);
        const Batch part{batch.key, first, last - first, batch.paces};
        connect(pool, tiles_, groups_, key.derived(0), part, sums);
        connect(pool, general_tiles_, general_groups_, key.derived(1), {part.key, part.first, part.count},
                sums);
    }
}

void GuidedReadings::connect(const NearNodePool& pool, std::span<const PointTile> tiles,
                             std::span<const Group> groups, math::RandomKey key, const Batch& batch,
                             Tally& sums) const {
    for (const Group& group : groups) {
        std::optional<KernelChoice::Sums> near;
        for (std::size_t t = group.first; t < group.last; ++t) {
            const std::uint64_t taken = batch.of_packet(t).count;
            if (taken == 0) continue;
            if (!near) near = pool.sums_for(group.spread, light_.k_per_m2(kPoints));
            std::vector<transport::LightVertex> nodes =
                pool.select(*near, kVerticesPerSample * taken, math::SampleStream(key, t, 0).next());
            const double share = static_cast<double>(taken) / static_cast<double>(batch.count);
            for (transport::LightVertex& node : nodes) node.flux_lm *= share;
            Connections(light_.caster, tiles.subspan(t, 1), monitor_, light_.guess.channels())
                .collect(nodes, sums);
        }
    }
}

}  // namespace stilb::estimators
