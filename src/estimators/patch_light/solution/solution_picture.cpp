#include "estimators/patch_light/solution/solution_picture.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/parallel.h"
#include "estimators/camera_paths.h"
#include "estimators/limits.h"
#include "estimators/patch_light/patch_transport.h"
#include "estimators/patch_light/solution/light_vertices.h"
#include "estimators/patch_light/solution/reflection_table.h"
#include "materials/shaded_surface.h"
#include "math/zernike.h"

namespace stilb::estimators {
namespace {

/// With more lights, so many are chosen at each point.
constexpr std::size_t kMostLights = 16;

class SolutionPicture final : public Estimator {
  public:
    SolutionPicture(const Problem& problem, PatchSolution solution)
        : solution_(std::move(solution)),
          lights_(problem.scene, problem.caster),
          tracing_(problem, lights_),
          caster_(solution_.patches),
          vertices_(problem.scene, solution_.patches, solution_.degree, solution_.lit_vertices) {
        for (const auto& named : problem.scene.materials) {
            tables_.push_back(reflects_nothing(named.material)
                                  ? ReflectionTable{}
                                  : make_reflection_table(named.material, solution_.degree));
        }
        towards_camera_.resize(vertices_.count());
        parallel_for_parts(vertices_.count(), [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                towards_camera_[i] = reflected(static_cast<std::uint32_t>(i));
        });
    }

    // There are no readings.
    std::string_view technique() const override { return "solution"; }
    void run_batch(const Batch&, Tally&) const override {}
    std::span<const Rgb> known_part() const override { return {}; }
    std::span<const std::optional<Vec3>> sight_ends() const override { return {}; }
    std::uint64_t batch_granularity() const override { return 1; }
    double rays_per_sample() const override { return 1; }

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<SolutionPass>(*this, pass);
    }
    std::vector<std::string> warnings() const override { return solution_warnings(tracing_.scene); }

  private:
    class SolutionPass final : public PicturePass {
      public:
        SolutionPass(const SolutionPicture& picture, const Pass& pass) : picture_(picture), pass_(pass) {}
        void sample(const PixelBlock& block, Tally& sums) const override {
            picture_.sample(block, pass_, sums);
        }

      private:
        const SolutionPicture& picture_;
        Pass pass_;
    };

    /// The light of a vertex towards the camera. A vertex just behind the outline of a curved surface sends
    /// it along its surface; one that faces away, which only a mirror or glass can show, along its normal.
    Rgb reflected(std::uint32_t vertex) const {
        const ReflectionTable& table = tables_[index_of(vertices_.material(vertex))];
        constexpr double behind_outline = -0.3;
        Vec3 out = vertices_.frame(vertex).to_local(
            normalized(tracing_.view.position() - vertices_.position(vertex)));
        if (out.z < behind_outline) out = {0, 0, 1};
        std::array<FloatRgb, math::ZernikeBasis::kMostCount> factors;
        const std::span<FloatRgb> used(factors.data(), vertices_.terms_of(vertex));
        interpolate_factors(table, {out.x, out.y, std::max(out.z, 0.0)}, used);
        Rgb luminance;
        for (std::size_t k = 0; k < used.size(); ++k)
            luminance += to_rgb(solution_.terms[0][vertices_.first_term(vertex) + k]) * to_rgb(used[k]);
        for (double& band : luminance.band) band = std::max(band, 0.0);
        return luminance;
    }

    void sample(const PixelBlock& block, const Pass& pass, Tally& sums) const {
        CameraPaths started = tracing_.start_paths(pixels_of(block), pass);
        std::vector<transport::Path*> standing;
        std::vector<ViewedHit> points;
        for (transport::Path& path : started.paths) {
            if (!tracing_.tracer.follow_to_scattering(path)) continue;
            standing.push_back(&path);
            points.push_back({path.hit, path.outgoing});
        }
        const auto locations = find_patch_locations(caster_, points);
        for (std::size_t i = 0; i < standing.size(); ++i) {
            transport::Path& path = *standing[i];
            if (locations[i])
                path.luminance_cd_m2 += path.throughput * indirect(*locations[i], pass.replicate);
        }
        add_direct(standing);
        started.add_to(sums);
    }

    Rgb indirect(const PatchLocation& seen, std::uint64_t replicate) const {
        const std::uint32_t patch = solution_.patches.patch_of(seen.side);
        const auto& [b0, b1, b2] = seen.barycentric;
        const std::array weights{b0, b1, b2};
        Rgb sum;
        double weight = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t number = vertices_.number_of(solution_.patches.corners[patch][c], seen.side);
            if (number == LightVertices::kDark) continue;
            sum += towards_camera_[number] *
                   (weights[c] * double{to_float(solution_.replicates[replicate][number])});
            weight += weights[c];
        }
        return weight > 0 ? sum * (1 / weight) : Rgb{};
    }

    /// Direct light at the ends of paths, one sample of each light, or of some where there are many.
    void add_direct(std::span<transport::Path* const> paths) const {
        std::vector<rays::Segment> segments;
        std::vector<Reflected> all;
        const std::size_t lights = std::min(lights_.count(), kMostLights);
        for (std::size_t light = 0; light < lights; ++light) {
            for (transport::Path* const path : paths) {
                const auto incident = sample_light(light, *path);
                if (!incident || dot(incident->direction, path->hit.normal) <= 0) continue;
                const Rgb luminance = reflected(*path, *incident);
                if (!(luminance.max() > 0)) continue;
                segments.push_back({path->hit.lifted, incident->source_point});
                all.push_back({path, path->throughput * luminance});
            }
        }
        std::vector<Rgb> transmittances(segments.size());
        tracing_.caster.transmittances(segments, rays::Coherence::coherent, transmittances);
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i].path->luminance_cd_m2 += all[i].luminance_cd_m2 * transmittances[i];
    }

    std::optional<transport::IncidentLight> sample_light(std::size_t number, transport::Path& path) const {
        if (lights_.count() <= kMostLights)
            return lights_.sample_incident(number, path.hit, path.stream.next_two());
        auto incident = lights_.sample_one_light(path.hit, path.stream);
        if (incident) incident->normal_illuminance_lx *= 1. / kMostLights;
        return incident;
    }

    /// Without shadows.
    Rgb reflected(const transport::Path& path, const transport::IncidentLight& light) const {
        const Material& material = tracing_.scene.material(path.hit.material);
        const materials::ShadedSurface surface(material, path.hit.normal, path.hit.shading_normal);
        const Vec3 in = surface.frame().to_local(light.direction);
        const Vec3 out = surface.frame().to_local(path.outgoing);
        return surface.brdf_per_sr(in, out) * in.z * light.normal_illuminance_lx;
    }

    struct Reflected {
        transport::Path* path;
        Rgb luminance_cd_m2;  ///< if nothing lies in between
    };

    PatchSolution solution_;
    transport::LightSampler lights_;
    PictureTracing tracing_;
    patches::PatchCaster caster_;
    LightVertices vertices_;
    std::vector<ReflectionTable> tables_;  ///< per material of the scene
    std::vector<Rgb> towards_camera_;      ///< per vertex [cd/m2]
};

}  // namespace

std::unique_ptr<Estimator> make_solution_picture(const Problem& problem, PatchSolution solution) {
    return std::make_unique<SolutionPicture>(problem, std::move(solution));
}

}  // namespace stilb::estimators
