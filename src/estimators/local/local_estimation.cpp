// Local estimation: illuminance at all points from one set of light paths, by bounded connections with
// compensation (theory T.1b)
//
//   E(x) = E_direct + sum over light vertices of W f_r w G + integral of L_r (1 - w) s_x dw
//
// with w = k / (k + s G) of weights.h. Double local estimation: luminance, by the same sums with the
// response of the sub-points that are seen (receiver.h, theory T.2).
//
//   local         k = infinity: the estimator as published [LocalEstimation (5)]. Rays from the point bring
//                 in only light by mirrors and glass. Infinite variance where light vertices come arbitrarily
//                 near to a point: in corners.
//   double-local  the same for luminance [LocalEstimation (8) to (10)]; local at illuminance readings.
//   balanced      (of method auto) k and the number of gathering rays by plan_splits(), vertices from a
//                 NodePool, or a guess of the light (guided_light.h). Unbiased and of finite variance, except
//                 for light that only light paths can find (it met a mirror or glass first): w = 1.
//
// Pictures: double local estimation of sub-points that each pass draws anew. A pass traces light paths of its
// own for the whole picture. Each packet of 4 x 4 pixels selects its own few of their vertices, and packets
// have another offset in every pass: errors of neighbouring packets are nearly independent, and no structure
// of the light paths shows in the picture.
//
// Not found: light that leaves a point-like source, meets a mirror or glass first and comes to the receiver
// by a mirror or glass last; the run warns of it.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>

#include "estimators/estimator_list.h"
#include "estimators/limits.h"
#include "estimators/local/connection.h"
#include "estimators/local/direct_plan.h"
#include "estimators/local/gather.h"
#include "estimators/local/local_picture.h"
#include "estimators/local/node_pool.h"
#include "estimators/local/split_plan.h"

namespace stilb::estimators {
namespace {

/// Vertices are connected to the points after so many light paths per selected one (below).
constexpr std::uint64_t kPathBlock = 512;
/// Selected light paths for each sample of direct light, where nothing plans them, and at most.
constexpr std::uint64_t kPathsPerDirectSample = 2, kMostPathsPerDirectSample = 32;
/// Samples of direct light for each sample with a guess: in penumbrae the rest has less noise.
constexpr std::uint64_t kDirectWithGuess = 2;
/// Light paths for each ray that `local` sends out where there are mirrors or glass.
constexpr std::uint64_t kPathsPerSpecularRay = 4;
/// Selected light paths of a replicate before the first error estimate: few of them may all miss rare light.
constexpr std::uint64_t kSelectedBeforeCheck = 256;
/// The vertices of one in so many light paths are connected to the points by `auto`: a light path costs as
/// much as some 50 shadow rays, so careful selection gains more with more points; the square root balances
/// the cost and the variance of both.
std::uint64_t paths_per_selected(std::size_t points) {
    std::uint64_t light_paths = 1;
    while (light_paths < 64 && 80 * light_paths * light_paths <= points) light_paths *= 2;
    return light_paths;
}
/// The largest number of selected light paths for each gathering ray. The more there are, the longer a run
/// takes to its first result, which needs a ray from every point: with many points there are fewer, for a
/// first result after some seconds.
std::uint64_t most_selected_per_ray(std::size_t points) {
    constexpr std::uint64_t most = 64, least = 4, connections = 1u << 19;
    return std::clamp<std::uint64_t>(std::bit_floor(connections / std::max<std::size_t>(points, 1)), least,
                                     most);
}

/// Illuminance at points and luminance along lines of sight.
class LocalReadings {
  public:
    /// `guide`: may be null.
    LocalReadings(const LocalTransport& transport, const Problem& problem, const GuidedLight* guide)
        : transport_(transport),
          channels_(problem.channels),
          seen_(receive(problem.measurands, guide)),
          stands_for_(problem.stands_for),
          paths_per_selected_(transport.split == Split::balanced ? paths_per_selected(all_receivers()) : 1),
          selected_per_ray_(most_selected_per_ray(all_receivers())),
          guided_(guided_readings(guide)),
          plans_(plans(problem)),
          tiles_(tiles_of(connected_receivers(), constants_per_m2(plans_.of_receivers), transport_.caster,
                          transport_.max_reflections)),
          connections_(transport_.caster, tiles_, transport_.monitor, channels_),
          gather_(transport_.caster, transport_.tracer, tiles_, plans_.of_receivers, transport_.monitor,
                  channels_) {
        if (guided_) guided_->add_known(seen_.known_part, seen_.known_parts);
    }

    void run_batch(const Batch& batch, Tally& sums) const {
        if (guided_) {
            guided_->collect(batch, sums);
            add_direct_light(batch, sums);
            add_faint_branches(batch, sums);
            return;
        }
        const std::uint64_t end = batch.first + batch.count;
        const std::uint64_t block = paths_at_once(transport_.scene, kPathBlock * paths_per_selected_);
        for (std::uint64_t first = batch.first; first < end; first += block) {
            connections_.collect(connected_vertices(batch.key, first, std::min(end, first + block)), sums);
        }
        add_direct_light(batch, sums);
        if (transport_.gathers) gather_.collect(batch, sums);
        add_faint_branches(batch, sums);
    }

    std::span<const Rgb> known_part() const { return seen_.known_part; }
    std::span<const Rgb> known_parts() const { return seen_.known_parts; }
    std::span<const std::optional<Vec3>> sight_ends() const { return seen_.ends; }
    bool is_met_by_chance(const rays::Hit& place) const {
        return guided_ && guided_->is_met_by_chance(place);
    }
    std::vector<double> expected_largest() const {
        std::vector<double> all(seen_.known_part.size());
        for (std::size_t j = 0; j < plans_.of_receivers.size(); ++j) {
            double& largest = all[seen_.receivers[j].reading()];
            const SplitPlan& plan = plans_.of_receivers[j];
            largest = std::max(largest, plan.largest_of_rays * static_cast<double>(plan.paths_per_ray));
        }
        return all;
    }
    /// With a guess, for readings at points: packets of their receivers.
    std::vector<std::uint32_t> packets() const {
        const std::size_t count = seen_.known_part.size();
        if (!guided_ || !guided_->can_have_paces() || !seen_.faint.empty() || seen_.receivers.size() != count)
            return {};
        constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> packets(count, none);
        for (std::size_t j = 0; j < count; ++j) {
            std::uint32_t& packet = packets[seen_.receivers[j].reading()];
            if (packet != none) return {};
            packet = static_cast<std::uint32_t>(j / kPacketWidth);
        }
        return packets;
    }
    std::uint64_t batch_granularity() const {
        return guided_ ? GuidedReadings::kGranularity : selected_per_ray_ * paths_per_selected_;
    }
    std::uint64_t first_check() const {
        return guided_ ? 4 * GuidedReadings::kGranularity : kSelectedBeforeCheck * paths_per_selected_;
    }
    double rays_per_sample() const {
        if (guided_) return guided_->rays_per_sample();
        constexpr double path_cost = 50;
        return path_cost +
               2.0 * static_cast<double>(seen_.receivers.size()) / static_cast<double>(paths_per_selected_);
    }
    double cost_per_sample() const {
        constexpr double of_shadow_ray = 1. / 3;
        double direct = 0;
        for_each_open_tile([&](const auto& tile, const auto& remainder, std::size_t t) {
            direct += of_shadow_ray * kDirectRayCost * stands_for_ * remainder.rays(tile.size()) /
                      static_cast<double>(light_paths_per_direct_sample(t));
        });
        if (guided_)
            return static_cast<double>(kDirectWithGuess) * direct + guided_->cost_per_sample(stands_for_);
        return direct + of_shadow_ray * plans_.cost_per_path;
    }

  private:
    /// The number of receivers of the whole problem, of which this may be a part.
    std::size_t all_receivers() const {
        return static_cast<std::size_t>(
            std::lround(stands_for_ * static_cast<double>(seen_.receivers.size())));
    }
    std::uint64_t light_paths_per_direct_sample(std::size_t tile) const {
        if (guided_) return 1;
        const std::uint64_t selected =
            plans_.paths_per_direct.empty() ? kPathsPerDirectSample : plans_.paths_per_direct[tile];
        return selected * paths_per_selected_;
    }

    std::vector<transport::LightVertex> connected_vertices(math::KeyOf<BatchStream> key, std::uint64_t first,
                                                           std::uint64_t end) const {
        std::vector<transport::LightVertex> nodes =
            transport_.trace_light_paths(key.derived(BatchStream::light_paths), first, end);
        if (paths_per_selected_ == 1) return nodes;
        const double u = math::SampleStream(key.derived(BatchStream::selection).derived(first), 0).next();
        return NodePool(nodes).select(nodes.size() / paths_per_selected_ + 1, u);
    }

    /// Receivers, faint branches and known parts of the readings.
    struct Reception {
        std::vector<transport::Receiver> receivers;
        std::size_t dark = 0;  ///< receivers at the end (GuidedLight::put_dark_last())
        struct Faint {
            std::uint32_t reading = 0;
            transport::FaintRay branch;
        };
        std::vector<Faint> faint;
        std::vector<Rgb> known_part, known_parts;
        std::vector<std::optional<Vec3>> ends;  ///< of lines of sight
        transport::DirectLight::Prepared direct;
    };
    Reception receive(std::span<const Measurand> measurands, const GuidedLight* guide) const {
        Reception seen;
        seen.known_part.resize(measurands.size());
        if (channels_) seen.known_parts.resize(channels_->count() * measurands.size());
        seen.ends.resize(measurands.size());
        for (std::uint32_t reading = 0; reading < measurands.size(); ++reading) {
            const Measurand& measurand = measurands[reading];
            if (auto receiver = transport::receiver_of_illuminance(reading, measurand, transport_.caster)) {
                seen.receivers.push_back(*receiver);
                continue;
            }
            const transport::VisibleSurfaces sight =
                trace_line_of_sight(measurand, transport_.scene, transport_.caster, transport_.lights,
                                    transport_.max_reflections);
            seen.ends[reading] = sight.end;
            transport::LightParts parts = sight.parts;
            seen.known_part[reading] = sight.emission_cd_m2;
            for (const transport::FaintRay& branch : sight.faint) {
                seen.faint.push_back({reading, branch});
                if (transport_.lights.has_light_from_outside() &&
                    !transport_.caster.closest(branch.origin, branch.direction)) {
                    transport::add_part(
                        branch.transmission * transport_.lights.outside_luminance(branch.direction),
                        transport_.lights.light_from_outside(), branch.reflections, seen.known_part[reading],
                        &parts);
                }
            }
            if (channels_) channels_->add(parts, Rgb::grey(1), 0, reading, seen.known_parts);
            for (const transport::SubPoint& sub_point : sight.sub_points) {
                if (sub_point.reflections == transport_.max_reflections) continue;
                seen.receivers.emplace_back(reading, sub_point,
                                            transport_.scene.material(sub_point.surface.material));
            }
        }
        seen.receivers = sorted_receivers(std::move(seen.receivers));
        if (guide) seen.dark = guide->put_dark_last(seen.receivers, transport_.monitor);
        using transport::PartsOfLight;
        seen.direct = transport_.direct.prepare(seen.receivers, transport_.monitor,
                                                channels_ ? PartsOfLight::all : PartsOfLight::none);
        for (std::size_t j = 0; j < seen.receivers.size(); ++j) {
            const transport::Receiver& receiver = seen.receivers[j];
            seen.known_part[receiver.reading()] += seen.direct.known[j];
            if (channels_)
                channels_->add(seen.direct.parts[j], Rgb::grey(1), receiver.reflections(), receiver.reading(),
                               seen.known_parts);
        }
        return seen;
    }

    void add_direct_light(const Batch& batch, Tally& sums) const {
        const math::RandomKey key = batch.key.derived(BatchStream::direct);
        for_each_open_tile([&](const auto& tile, const auto& remainder, std::size_t t) {
            transport_.monitor.require_more();
            const std::uint64_t light_paths = light_paths_per_direct_sample(t);
            const Batch own = batch.of_packet(t);
            const std::uint64_t repeated = guided_ ? kDirectWithGuess : 1;
            const double weight = static_cast<double>(light_paths) / static_cast<double>(repeated);
            const std::uint64_t end = repeated * ((own.first + own.count) / light_paths);
            for (std::uint64_t i = repeated * (own.first / light_paths); i < end; ++i) {
                std::vector<math::SampleStream> streams = streams_of(key, t, tile.size(), i);
                std::array<transport::LightParts, kPacketWidth> parts;
                transport::DirectLight::TileLight light{{}, channels_ ? &parts : nullptr};
                transport_.direct.add_sample(tile, remainder, streams, light);
                for (std::size_t j = 0; j < tile.size(); ++j) {
                    sums.add_direct(tile[j].reading(), weight * light[j]);
                    if (channels_)
                        channels_->add(parts[j], Rgb::grey(weight), tile[j].reflections(), tile[j].reading(),
                                       sums.parts);
                }
            }
        });
    }

    /// Sample `index` of a tile's receivers.
    static std::vector<math::SampleStream> streams_of(math::RandomKey key, std::size_t tile,
                                                      std::size_t receivers, std::uint64_t index) {
        std::vector<math::SampleStream> streams;
        streams.reserve(receivers);
        for (std::size_t j = 0; j < receivers; ++j)
            streams.emplace_back(key.derived(tile * kPacketWidth + j), index);
        return streams;
    }

    /// Calls visit(tile, remainder, number) for tiles of receivers whose direct light has to be sampled.
    template <typename Visit>
    void for_each_open_tile(const Visit& visit) const {
        const std::span<const transport::Receiver> receivers = seen_.receivers;
        for (std::size_t t = 0; t < seen_.direct.remainders.size(); ++t) {
            const std::size_t first = t * kPacketWidth;
            if (seen_.direct.remainders[t].is_empty()) continue;
            visit(receivers.subspan(first, std::min<std::size_t>(kPacketWidth, receivers.size() - first)),
                  seen_.direct.remainders[t], t);
        }
    }

    /// These branches carry so little light that one path for each granule of light paths suffices, or for
    /// some of the samples with a guess.
    void add_faint_branches(const Batch& batch, Tally& sums) const {
        const math::RandomKey key = batch.key.derived(BatchStream::faint);
        constexpr double guided_share = 0.25;
        const std::uint64_t light_paths = batch_granularity();
        const double weight = static_cast<double>(light_paths) / (guided_ ? guided_share : 1);
        for (std::size_t j = 0; j < seen_.faint.size(); ++j) {
            transport_.monitor.require_more();
            const auto& [reading, branch] = seen_.faint[j];
            const auto hit = transport_.caster.closest(branch.origin, branch.direction);
            if (!hit) continue;  // in the known part
            for (std::uint64_t i = batch.first / light_paths; i < (batch.first + batch.count) / light_paths;
                 ++i) {
                math::SampleStream stream(key.derived(j), i);
                if (guided_ && stream.next() >= guided_share) continue;
                transport::LightParts parts;
                const Rgb luminance = transport_.tracer.luminance(
                    *hit, branch.direction, transport_.max_reflections - branch.reflections, stream,
                    channels_ ? &parts : nullptr);
                sums.add(reading, weight * branch.transmission * luminance);
                if (channels_)
                    channels_->add(parts, weight * branch.transmission, branch.reflections, reading,
                                   sums.parts);
            }
        }
    }

    std::optional<GuidedReadings> guided_readings(const GuidedLight* guide) const {
        if (!guide || seen_.receivers.empty()) return std::nullopt;
        return std::optional<GuidedReadings>(std::in_place, *guide, seen_.receivers, seen_.dark,
                                             transport_.monitor);
    }

    /// Those of connections of light paths: a guess has receivers of its own.
    std::span<const transport::Receiver> connected_receivers() const {
        return guided_ ? std::span<const transport::Receiver>() : seen_.receivers;
    }

    SplitPlans plans(const Problem& problem) const {
        if (connected_receivers().empty()) return {};
        if (transport_.split == Split::none) {
            return {std::vector<SplitPlan>(seen_.receivers.size(),
                                           {std::numeric_limits<double>::infinity(), kPathsPerSpecularRay})};
        }
        const math::KeyOf key = problem.preparation_key;
        const std::uint64_t pilot_paths = paths_at_once(transport_.scene, kPilotPaths);
        const std::vector<transport::LightVertex> nodes =
            transport_.trace_light_paths(key.derived(PreparationStream::light_paths), 0, pilot_paths);
        const DirectPilot of_direct = pilot_direct(key.derived(PreparationStream::direct));
        const std::vector<double> alike(problem.weights.empty() ? of_direct.direct.size() : 0, 1.0);
        const std::span<const double> weights = problem.weights.empty() ? alike : problem.weights;
        const PilotLight pilot{nodes,
                               pilot_paths,
                               of_direct.direct,
                               surface_area_m2(transport_.scene),
                               transport_.max_reflections,
                               paths_per_selected_,
                               selected_per_ray_,
                               stands_for_};
        SplitPlans plans = plan_splits(transport_.caster, transport_.tracer, seen_.receivers, weights, pilot,
                                       key.derived(PreparationStream::plan), problem.monitor);
        plans.paths_per_direct = plan_direct(seen_.receivers, seen_.direct.remainders, weights, of_direct,
                                             plans, std::min(kMostPathsPerDirectSample, selected_per_ray_));
        for (SplitPlan& plan : plans.of_receivers) plan.paths_per_ray *= paths_per_selected_;
        return plans;
    }

    DirectPilot pilot_direct(math::RandomKey key) const {
        // Few samples of a sky with a sun, or of lamps in a gloss, may be wrong by a factor.
        constexpr std::size_t in_all = 1u << 14;
        const auto samples =
            static_cast<int>(std::clamp<std::size_t>(in_all / (seen_.receivers.size() + 1), 4, 64));
        DirectPilot pilot{{}, std::vector<double>(seen_.receivers.size()), samples};
        for (const Rgb& known : seen_.known_part) pilot.direct.push_back(known.luminance());
        for_each_open_tile([&](const auto& tile, const auto& remainder, std::size_t t) {
            std::array<double, kPacketWidth> sums{}, squares{};
            for (int i = 0; i < samples; ++i) {
                std::vector<math::SampleStream> streams =
                    streams_of(key, t, tile.size(), static_cast<std::uint64_t>(i));
                transport::DirectLight::TileLight light{};
                transport_.direct.add_sample(tile, remainder, streams, light);
                for (std::size_t j = 0; j < tile.size(); ++j) {
                    const double sample = light[j].luminance();
                    sums[j] += sample, squares[j] += sample * sample;
                }
            }
            for (std::size_t j = 0; j < tile.size(); ++j) {
                pilot.direct[tile[j].reading()] += sums[j] / samples;
                pilot.variances[t * kPacketWidth + j] =
                    std::max(squares[j] - sums[j] * sums[j] / samples, 0.0) / (samples - 1);
            }
        });
        return pilot;
    }

    static std::vector<double> constants_per_m2(std::span<const SplitPlan> plans) {
        std::vector<double> constants;
        for (const SplitPlan& plan : plans) constants.push_back(plan.k_per_m2);
        return constants;
    }

    const LocalTransport& transport_;
    const transport::Channels* channels_;  ///< null where there are none
    Reception seen_;
    double stands_for_;
    std::uint64_t paths_per_selected_, selected_per_ray_;
    std::optional<GuidedReadings> guided_;
    SplitPlans plans_;
    std::vector<PointTile> tiles_;
    Connections connections_;
    Gather gather_;
};

/// A scene with its guess of the light, if it has one. Pilots and the run share it.
struct LocalScene {
    LocalScene(const Problem& problem, Split split) : transport(problem, split) {}
    void make_guide(const Problem& problem) {
        guide = GuidedLight::make(problem, transport.lights, transport.tracer,
                                  {problem.preparation_key.derived(PreparationStream::guess)});
    }

    LocalTransport transport;
    std::unique_ptr<const GuidedLight> guide;
};

class LocalEstimation final : public Estimator {
  public:
    /// `technique`: of estimation without a guess.
    LocalEstimation(const Problem& problem, std::shared_ptr<const LocalScene> scene,
                    std::string_view technique)
        : scene_(std::move(scene)),
          technique_(scene_->guide ? "guided" : technique),
          readings_(scene_->transport, problem, scene_->guide.get()) {
        if (problem.camera)
            picture_ = scene_->guide ? make_guided_picture(scene_->transport, problem, *scene_->guide)
                                     : make_local_picture(scene_->transport, problem);
    }

    std::string_view technique() const override { return technique_; }
    void run_batch(const Batch& batch, Tally& sums) const override { readings_.run_batch(batch, sums); }
    std::span<const Rgb> known_part() const override { return readings_.known_part(); }
    std::span<const Rgb> known_parts() const override { return readings_.known_parts(); }
    std::span<const std::optional<Vec3>> sight_ends() const override { return readings_.sight_ends(); }
    std::vector<double> expected_largest() const override { return readings_.expected_largest(); }
    bool is_met_by_chance(const rays::Hit& place) const override { return readings_.is_met_by_chance(place); }
    std::vector<std::uint32_t> packets() const override { return readings_.packets(); }
    std::uint64_t batch_granularity() const override { return readings_.batch_granularity(); }
    std::uint64_t first_check() const override { return readings_.first_check(); }
    double rays_per_sample() const override { return readings_.rays_per_sample(); }
    double cost_per_sample() const override { return readings_.cost_per_sample(); }
    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return picture_->start(pass);
    }
    std::vector<std::string> warnings() const override { return local_warnings(scene_->transport.scene); }

  private:
    std::shared_ptr<const LocalScene> scene_;
    std::string_view technique_;
    LocalReadings readings_;
    std::unique_ptr<const LocalPicture> picture_;
};

constexpr std::string_view kLightPaths = "light-paths";

std::unique_ptr<Estimator> make(const Problem& problem, Split split, std::string_view technique) {
    return std::make_unique<LocalEstimation>(problem, std::make_shared<const LocalScene>(problem, split),
                                             technique);
}

}  // namespace

std::unique_ptr<Estimator> make_local(const Problem& problem) { return make(problem, Split::none, "local"); }

std::unique_ptr<Estimator> make_double_local(const Problem& problem) {
    return make(problem, Split::none, "double-local");
}

std::unique_ptr<Estimator> make_balanced(const Problem& problem) {
    return make(problem, Split::balanced, kLightPaths);
}

EstimatorMaker with_guess(const Problem& problem) {
    const auto scene = std::make_shared<LocalScene>(problem, Split::balanced);
    scene->make_guide(problem);
    return
        [scene](const Problem& part) { return std::make_unique<LocalEstimation>(part, scene, kLightPaths); };
}

std::unique_ptr<Estimator> make_guided(const Problem& problem) { return with_guess(problem)(problem); }

}  // namespace stilb::estimators
