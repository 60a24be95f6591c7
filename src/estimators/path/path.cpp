// Path tracing from every measuring point, with next-event estimation: the reference for local estimation.
//
//   E(x) = E_direct + integral over the hemisphere of L_r(y, y->x) cos(theta_x) dw        (theory 2, T.1b
//   with k = 0)
//
// by one cosine-distributed ray and the path that it begins, for each sample and point by itself; luminance
// by paths that begin along the line of sight, and pictures by one path from the camera for each sample of a
// pixel (path_tracer.h). Finite variance for bounded BRDFs. Not found: light that leaves a point-like source
// and meets a mirror or glass before anything else, except panes straight on. With first shot, which is only
// used on request, it is biased by the patches.

#include <fmt/format.h>

#include <algorithm>

#include "estimators/camera_paths.h"
#include "estimators/estimator_list.h"
#include "estimators/limits.h"
#include "estimators/patch_light/first_shot/first_shot.h"
#include "materials/diffuse.h"
#include "transport/direct/one_receiver.h"
#include "transport/light_path.h"
#include "transport/path_tracer.h"

namespace stilb::estimators {

namespace {

std::unique_ptr<const FirstShotPatches> patches_for(const Scene& scene, const rays::RayCaster& caster,
                                                    const PatchOptions& options, const Monitor& monitor) {
    if (options.first_shot.variant.value_or(FirstShotVariant::none) == FirstShotVariant::none) return nullptr;
    return std::make_unique<FirstShotPatches>(scene, caster, options, monitor);
}

std::vector<bool> replaced(const FirstShotPatches* patches) {
    std::vector<bool> lights;
    if (!patches) return lights;
    for (const FirstShotLight& light : patches->first_shot.lights()) lights.push_back(light.is_replaced);
    return lights;
}

bool has_panes(const Scene& scene) {
    return std::ranges::any_of(scene.materials,
                               [](const NamedMaterial& named) { return passes_straight(named.material); });
}

// Path tracing of a scene as it is, or with first shot: small lights replaced by their first
// reflection, which every surface on a path adds by the patch that represents it.

/// Keeps references to scene and caster. Not movable. Immutable.
struct FlattenedPaths {
    /// Patches exist only where the options select a variant of first shot.
    FlattenedPaths(const Scene& scene, const rays::RayCaster& caster, const PatchOptions& options,
                   const Monitor& monitor);
    FlattenedPaths(const FlattenedPaths&) = delete;
    FlattenedPaths& operator=(const FlattenedPaths&) = delete;

    std::vector<std::string> warnings() const;
    std::optional<PatchReport> report() const;

    const Scene& scene;
    std::unique_ptr<const FirstShotPatches> patches;  ///< null without first shot
    transport::LightSampler lights;                   ///< the lights that first shot does not replace
    transport::PathTracer tracer;
};

FlattenedPaths::FlattenedPaths(const Scene& all, const rays::RayCaster& caster, const PatchOptions& options,
                               const Monitor& monitor)
    : scene(all),
      patches(patches_for(scene, caster, options, monitor)),
      lights(scene, caster, replaced(patches.get())),
      tracer(scene, caster, lights, patches.get()) {}

std::vector<std::string> FlattenedPaths::warnings() const {
    std::vector<std::string> warnings = path_warnings(scene);
    if (!patches) return warnings;
    const FirstShotVariant variant = patches->first_shot.variant();
    warnings.push_back(fmt::format(
        "path tracing with first shot ({}) is biased by patches of {:.2g} m; the stated errors do not "
        "include this bias: halve the size of the patches to see how large it is.",
        name_of(variant), patches->size_m));
    if (variant != FirstShotVariant::on_the_fly && has_panes(scene)) {
        warnings.push_back(fmt::format(
            "first shot ({}) ends at panes: light of small lights that passes one before anything else is "
            "missing. Use first shot \"on-the-fly\".",
            name_of(variant)));
    }
    return warnings;
}

std::optional<PatchReport> FlattenedPaths::report() const {
    return patches ? std::optional{patches->report()} : std::nullopt;
}

/// Paths that are traced together: enough to fill packets until most of them have ended.
constexpr std::uint64_t kSideBySide = 256;

class PathPass final : public PicturePass {
  public:
    PathPass(const PictureTracing& tracing, const transport::PathTracer& tracer, const Pass& pass)
        : tracing_(tracing), tracer_(tracer), pass_(pass) {}

    void sample(const PixelBlock& block, Tally& sums) const override {
        tracing_.trace(pixels_of(block), pass_, tracer_, sums);
    }

  private:
    const PictureTracing& tracing_;
    const transport::PathTracer& tracer_;
    Pass pass_;
};

class PathEstimator final : public Estimator {
  public:
    explicit PathEstimator(const Problem& problem)
        : scene_(problem.scene),
          caster_(problem.caster),
          monitor_(problem.monitor),
          max_reflections_(problem.max_reflections),
          preparation_key_(problem.preparation_key),
          stands_for_(problem.stands_for),
          paths_(scene_, caster_, problem.patches, problem.monitor),
          channels_(paths_.patches ? nullptr : problem.channels),
          known_part_(problem.measurands.size()),
          known_parts_(channels_ ? channels_->count() * problem.measurands.size() : 0),
          sight_ends_(problem.measurands.size()) {
        for (std::uint32_t reading = 0; reading < problem.measurands.size(); ++reading) {
            add_reading(reading, problem.measurands[reading]);
        }
        if (problem.camera) tracing_.emplace(problem, paths_.lights, channels_);
    }

    std::string_view technique() const override { return "path"; }
    void run_batch(const Batch& batch, Tally& sums) const override {
        for_parts(points_.size() * batch.count, [&](std::uint64_t first, std::uint64_t end) {
            sample_illuminances(batch, first, end, sums);
        });
        for_parts(sights_.size() * batch.count, [&](std::uint64_t first, std::uint64_t end) {
            sample_luminances(batch, first, end, sums);
        });
    }

    std::span<const Rgb> known_part() const override { return known_part_; }
    std::span<const Rgb> known_parts() const override { return known_parts_; }
    std::span<const std::optional<Vec3>> sight_ends() const override { return sight_ends_; }
    bool is_met_by_chance(const rays::Hit& /*place*/) const override { return !paths_.patches; }
    std::uint64_t batch_granularity() const override { return 1; }
    /// Rare bright paths dominate the error.
    std::uint64_t first_check() const override { return 256; }
    double rays_per_sample() const override { return 10.0 * static_cast<double>(known_part_.size()); }
    double cost_per_sample() const override {
        // As light paths are long, these will be. Plain diffuse vertices are computed in packets.
        constexpr std::uint64_t light_paths = 64;
        constexpr double of_plain = 2, of_general = 8;
        double cost = of_plain;
        for (const transport::LightVertex& vertex : transport::trace_light_paths(
                 scene_, caster_, paths_.lights, max_reflections_,
                 preparation_key_.derived(PreparationStream::light_paths), 0, light_paths)) {
            const bool is_plain = vertex.material->is<Diffuse>() && vertex.shading_normal == vertex.normal;
            cost += (is_plain ? of_plain : of_general) / static_cast<double>(light_paths);
        }
        return cost * stands_for_ * static_cast<double>(known_part_.size());
    }
    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<PathPass>(*tracing_, paths_.tracer, pass);
    }
    std::vector<std::string> warnings() const override { return paths_.warnings(); }
    std::optional<PatchReport> patch_report() const override { return paths_.report(); }

  private:
    /// The first hit of a line of sight, and the direction from which it is seen.
    struct FirstHit {
        std::uint32_t reading = 0;
        rays::Hit hit;
        Vec3 direction;
    };

    /// The part of a reading without sampling: direct light of point-like sources at a point, emission
    /// along a line of sight.
    void add_reading(std::uint32_t reading, const Measurand& measurand) {
        transport::LightParts parts;
        add_reading(reading, measurand, parts);
        if (channels_) channels_->add(parts, Rgb::grey(1), 0, reading, known_parts_);
    }
    void add_reading(std::uint32_t reading, const Measurand& measurand, transport::LightParts& parts) {
        if (auto receiver = transport::receiver_of_illuminance(reading, measurand, caster_)) {
            points_.push_back(*receiver);
            known_part_[reading] = direct_from_points(points_.back(), caster_, paths_.lights, &parts);
            return;
        }
        const transport::VisibleSurfaces seen =
            trace_line_of_sight(measurand, scene_, caster_, paths_.lights, max_reflections_);
        sight_ends_[reading] = seen.end;
        if (!seen.first) {
            known_part_[reading] = seen.emission_cd_m2;
            parts = seen.parts;
            return;
        }
        const Vec3 direction = transport::viewing_direction(measurand);
        sights_.push_back({reading, *seen.first, direction});
        known_part_[reading] = paths_.lights.emitted_luminance(*seen.first, -direction, &parts);
    }

    /// Calls `sample(first, end)` for parts of all readings' samples: number n is sample n % count of reading
    /// n / count.
    template <typename Sample>
    void for_parts(std::uint64_t samples, const Sample& sample) const {
        for (std::uint64_t first = 0; first < samples; first += kSideBySide) {
            monitor_.require_more();
            sample(first, std::min(first + kSideBySide, samples));
        }
    }

    void sample_illuminances(const Batch& batch, std::uint64_t first, std::uint64_t end, Tally& sums) const {
        std::vector<rays::Ray> rays;
        std::vector<math::SampleStream> streams;
        struct Target {
            std::uint32_t reading = 0;
            Rgb weight;
        };
        std::vector<Target> targets;
        for (std::uint64_t n = first; n < end; ++n) {
            const transport::Receiver& point = points_[n / batch.count];
            math::SampleStream stream(batch.key.derived(BatchStream::camera_paths).derived(point.reading()),
                                      batch.first + n % batch.count);
            transport::LightParts parts;
            sums.add_direct(point.reading(), sample_direct_from_areas(point, caster_, paths_.lights, stream,
                                                                      channels_ ? &parts : nullptr));
            if (channels_) channels_->add(parts, Rgb::grey(1), 0, point.reading(), sums.parts);
            const auto [u1, u2] = stream.next_two();
            const auto sample = point.sample(u1, u2);
            if (!sample) continue;
            rays.push_back({point.lifted(), sample->direction});
            streams.push_back(stream);
            targets.push_back({point.reading(), sample->weight});
        }
        std::vector<std::optional<rays::Hit>> hits(rays.size());
        caster_.closest(rays, rays::Coherence::scattered, hits);
        std::vector<transport::Path> paths;
        std::vector<transport::LightParts> parts(channels_ ? rays.size() : 0);
        std::vector<Target> target_of_path;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (!hits[i]) continue;
            paths.push_back({*hits[i], -rays[i].direction, streams[i], max_reflections_});
            paths.back().previous_vertex = transport::kDirectIsKnown;
            if (channels_) paths.back().parts = &parts[i];
            target_of_path.push_back(targets[i]);
        }
        paths_.tracer.trace(paths, rays::Coherence::scattered);
        for (std::size_t i = 0; i < paths.size(); ++i) {
            const auto& [reading, weight] = target_of_path[i];
            sums.add(reading, weight * paths[i].luminance_cd_m2);
            if (channels_) channels_->add(*paths[i].parts, weight, 0, reading, sums.parts);
        }
    }

    void sample_luminances(const Batch& batch, std::uint64_t first, std::uint64_t end, Tally& sums) const {
        std::vector<transport::Path> paths;
        std::vector<transport::LightParts> parts(channels_ ? end - first : 0);
        for (std::uint64_t n = first; n < end; ++n) {
            const FirstHit& seen = sights_[n / batch.count];
            const math::SampleStream stream(
                batch.key.derived(BatchStream::camera_paths).derived(seen.reading),
                batch.first + n % batch.count);
            paths.push_back({seen.hit, -seen.direction, stream, max_reflections_});
            if (channels_) paths.back().parts = &parts[n - first];
        }
        paths_.tracer.trace(paths, rays::Coherence::coherent);
        for (std::uint64_t n = first; n < end; ++n) {
            const std::uint32_t reading = sights_[n / batch.count].reading;
            sums.add(reading, paths[n - first].luminance_cd_m2);
            if (channels_) channels_->add(parts[n - first], Rgb::grey(1), 0, reading, sums.parts);
        }
    }

    const Scene& scene_;
    const rays::RayCaster& caster_;
    const Monitor& monitor_;
    int max_reflections_;
    math::KeyOf<PreparationStream> preparation_key_;
    double stands_for_;
    FlattenedPaths paths_;
    const transport::Channels* channels_;
    std::vector<transport::Receiver> points_;
    std::vector<FirstHit> sights_;
    std::vector<Rgb> known_part_, known_parts_;
    std::vector<std::optional<Vec3>> sight_ends_;
    std::optional<PictureTracing> tracing_;
};

}  // namespace

std::unique_ptr<Estimator> make_path(const Problem& problem) {
    return std::make_unique<PathEstimator>(problem);
}

}  // namespace stilb::estimators
