// Direct simulation: particles.h describes the light of the patches, patch_readings.h readings and
// pictures of it. A sample is a particle. Each batch of readings makes a map of its own; a pass
// over a picture is the map of some particles.
#include "estimators/patch_light/particles/particles.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "estimators/estimator_list.h"
#include "estimators/limits.h"
#include "estimators/patch_light/patch_readings.h"
#include "patches/visibility/item_buffer.h"
#include "transport/weights.h"

namespace stilb::estimators {

IlluminationMap::IlluminationMap(const PatchTransport& transport)
    : transport_(transport), flux_lm_(2 * transport.patches.count()) {}

void IlluminationMap::add(math::RandomKey key, std::uint64_t first, std::uint64_t count) {
    particles_ += count;
    if (transport_.lights.count() == 0) return;
    std::vector<Particle> together;
    for (std::uint64_t i = first; i < first + count; ++i) {
        together.push_back(leave_light(math::SampleStream(key, i)));
        if (together.size() == kPacketWidth || i + 1 == first + count) walk(together);
    }
}

IlluminationMap::Particle IlluminationMap::leave_light(math::SampleStream stream) const {
    const transport::EmittedParticle emitted = transport_.lights.sample_emission(stream);
    return {stream, emitted.origin, emitted.direction, emitted.flux_lm};
}

/// Particles that share a packet of rays, until the last one ends.
void IlluminationMap::walk(std::vector<Particle>& particles) {
    while (!particles.empty()) {
        RayPacket packet;
        LaneMask lanes{};
        for (std::size_t lane = 0; lane < particles.size(); ++lane) {
            packet.set(lane, particles[lane].origin - transport_.patches.center, particles[lane].direction,
                       std::numeric_limits<float>::infinity());
            lanes[lane] = -1;
        }
        const patches::PatchHits hits = transport_.patch_caster.closest(packet, lanes);
        rays_ += particles.size();
        std::size_t alive = 0;
        for (std::size_t lane = 0; lane < particles.size(); ++lane) {
            if (hits.sides[lane] == patches::kNoSide ||
                !land(particles[lane], hits.sides[lane], hits.barycentric(lane)))
                continue;
            particles[alive++] = particles[lane];
        }
        particles.erase(particles.begin() + static_cast<std::ptrdiff_t>(alive), particles.end());
    }
}

/// Counts the particle; returns whether it survives.
bool IlluminationMap::land(Particle& particle, std::uint32_t side, const math::Barycentric& barycentric) {
    add_to(flux_lm_[side], particle.flux_lm);
    const patches::Patches& patches = transport_.patches;
    const Rgb reflectance = std::numbers::pi * to_rgb(transport_.constant_brdf[side]);
    const double survival = transport::survival_probability(particle.flux_lm, reflectance);
    if (particle.stream.next() >= survival) return false;
    const patches::Viewpoint viewpoint = viewpoint_on(patches, side, barycentric);
    const auto [u1, u2] = particle.stream.next_two();
    particle.origin = viewpoint.position;
    particle.direction = viewpoint.frame.to_world(math::sample_cosine_hemisphere(u1, u2).direction);
    particle.flux_lm *= reflectance * (1 / survival);
    return true;
}

std::vector<FloatRgb> IlluminationMap::reflected_cd_m2() const {
    const patches::Patches& patches = transport_.patches;
    std::vector<FloatRgb> reflected(flux_lm_.size());
    for (std::uint32_t side = 0; side < reflected.size(); ++side) {
        const std::uint32_t patch = patches.patch_of(side);
        const double per_m2 = 1 / (double{patches.areas_m2[patch]} * static_cast<double>(particles_));
        reflected[side] =
            to_float_rgb(to_rgb(transport_.constant_brdf[side]) * to_rgb(flux_lm_[side]) * per_m2);
    }
    return reflected;
}

namespace {

constexpr std::string_view kParticles = "particles";
/// Particles for each evaluation of the map by a reading.
constexpr std::uint64_t kParticlesPerEvaluation = 64;
constexpr std::uint64_t kLeastParticles = 4096;
constexpr double kRaysPerParticle = 5;

/// All lights emit particles.
PatchTransport particle_transport(const Problem& problem) {
    require_diffuse(problem.scene, kParticles);
    require_all_reflections(problem.max_reflections, kParticles);
    PatchOptions options = problem.patches;
    options.first_shot.variant = FirstShotVariant::none;
    return {problem.scene, problem.caster, options, problem.monitor};
}

class Particles final : public Estimator {
  public:
    explicit Particles(const Problem& problem)
        : transport_(particle_transport(problem)),
          readings_(transport_, problem.measurands, kParticlesPerEvaluation * kRaysPerParticle,
                    problem.monitor) {
        if (problem.camera) tracing_.emplace(problem, transport_.lights);
    }

    std::string_view technique() const override { return kParticles; }
    void run_batch(const Batch& batch, Tally& sums) const override {
        IlluminationMap map(transport_);
        map.add(batch.key.derived(BatchStream::particles), batch.first, batch.count);
        const ReflectedSides light(map.reflected_cd_m2());
        const std::uint64_t first = batch.first / kParticlesPerEvaluation,
                            evaluations = batch.count / kParticlesPerEvaluation;
        Tally seen(sums.sum.size());
        for (std::uint64_t i = first; i < first + evaluations; ++i) {
            readings_.add(light, {batch.key.derived(BatchStream::patch_readings)}, i, seen);
        }
        for (std::size_t j = 0; j < seen.sum.size(); ++j)
            sums.add(j, seen.sum[j] * double{kParticlesPerEvaluation});
        std::ranges::fill(seen.sum, Rgb{});
        std::ranges::fill(seen.largest, 0);
        sums += seen;
        sums.rays += map.rays();
    }

    std::span<const Rgb> known_part() const override { return readings_.known_part(); }
    std::span<const std::optional<Vec3>> sight_ends() const override { return readings_.sight_ends(); }
    std::uint64_t batch_granularity() const override { return kLeastParticles; }
    double rays_per_sample() const override {
        constexpr double evaluations = 2. / kParticlesPerEvaluation;
        return kRaysPerParticle + evaluations * static_cast<double>(known_part().size());
    }

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        const math::RandomKey key = pass.key.derived(PassStream::particles);
        std::array<std::vector<FloatRgb>, kMaps> maps;
        parallel_for(kMaps, [&](std::uint64_t i) {
            IlluminationMap map(transport_);
            map.add(key, (pass.index * kMaps + i) * particles_, particles_);
            maps[i] = map.reflected_cd_m2();
        });
        std::vector<FloatRgb> mean(maps[0].size());
        for (const auto& map : maps) {
            for (std::size_t side = 0; side < mean.size(); ++side)
                add_to(mean[side], to_rgb(map[side]) * (1. / kMaps));
        }
        return std::make_unique<PatchPass>(*tracing_, transport_, pass, mean);
    }
    std::vector<std::string> warnings() const override { return {}; }
    std::optional<PatchReport> patch_report() const override { return transport_.report(); }

  private:
    /// Particle groups of a pass, each a task of its own.
    static constexpr std::uint64_t kMaps = 4;

    PatchTransport transport_;
    PatchReadings readings_;
    std::optional<PictureTracing> tracing_;
    /// Particles of a map for pictures.
    std::uint64_t particles_ = std::max<std::uint64_t>(kLeastParticles, transport_.patches.count());
};

}  // namespace

std::unique_ptr<Estimator> make_particles(const Problem& problem) {
    return std::make_unique<Particles>(problem);
}

}  // namespace stilb::estimators
