// Direct simulation for readings and pictures: illumination_map.h has how the patches are lit,
// patch_readings.h what is made of it. A sample is a particle. Each batch makes a map of its own.
#include "estimators/patch_light/particles/particles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "estimators/limits.h"
#include "estimators/patch_light/particles/illumination_map.h"
#include "estimators/patch_light/patch_picture.h"
#include "estimators/patch_light/patch_readings.h"
#include "estimators/patch_light/reflected_sides.h"

namespace stilb::estimators {
namespace {

constexpr std::string_view kName = "particles";
/// Particles for each look from a reading at the map.
constexpr std::uint64_t kParticlesPerLook = 64;
constexpr std::uint64_t kLeastParticles = 4096;

enum Purpose : std::uint64_t { kWalks = kPixels + 1, kLooks };

/// All lights shine by particles.
PatchTransport transport_for(const Scene& scene, const rays::RayCaster& caster, PatchOptions options,
                             int max_reflections) {
    require_diffuse(scene, kName);
    require_all_reflections(max_reflections, kName);
    options.first_shot.variant = FirstShotVariant::none;
    return {scene, caster, options};
}

class Particles final : public Estimator {
  public:
    explicit Particles(const EstimatorInput& input)
        : transport_(transport_for(input.scene, input.caster, input.patches, input.max_reflections)),
          readings_(transport_, input.measurands) {}

    void run_batch(const Batch& batch, ReadingSums& sums) const override {
        IlluminationMap map(transport_);
        map.add(batch.key.derived(kWalks), batch.first, batch.count);
        const ReflectedSides light(map.reflected_cd_m2());
        const std::uint64_t first = batch.first / kParticlesPerLook, looks = batch.count / kParticlesPerLook;
        ReadingSums seen(sums.sum.size());
        for (std::uint64_t i = first; i < first + looks; ++i) {
            readings_.add(light, batch.key.derived(kLooks), i, seen);
        }
        for (std::size_t j = 0; j < seen.sum.size(); ++j)
            sums.add(j, seen.sum[j] * double{kParticlesPerLook});
        sums.invalid += seen.invalid;
        sums.rays += map.rays();
    }

    std::span<const Rgb> known_part() const override { return readings_.known_part(); }
    std::uint64_t batch_granularity() const override { return kLeastParticles; }
    double rays_per_sample() const override {
        constexpr double reflections = 5, looks = 2. / kParticlesPerLook;
        return reflections + looks * static_cast<double>(known_part().size());
    }
    std::vector<std::string> warnings() const override { return {}; }
    std::optional<PatchReport> patch_report() const override { return transport_.report(); }

  private:
    PatchTransport transport_;
    PatchReadings readings_;
};

/// A pass is the map of some particles.
class ParticlesPicture final : public PictureEstimator {
  public:
    explicit ParticlesPicture(const PictureInput& input)
        : tracing_(input),
          transport_(transport_for(input.scene, input.caster, input.patches, input.max_reflections)) {}

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        const math::RandomKey key = pass.key.derived(kWalks);
        std::array<std::vector<FloatRgb>, kMaps> maps;
        tbb::parallel_for(std::uint64_t{0}, kMaps, [&](std::uint64_t i) {
            IlluminationMap map(transport_);
            map.add(key, (pass.index * kMaps + i) * particles_, particles_);
            maps[i] = map.reflected_cd_m2();
        });
        std::vector<FloatRgb> mean(maps[0].size());
        for (const auto& map : maps) {
            for (std::size_t side = 0; side < mean.size(); ++side)
                add_to(mean[side], to_rgb(map[side]) * (1. / kMaps));
        }
        return std::make_unique<PatchPass>(tracing_, transport_, pass, mean);
    }
    std::vector<std::string> warnings() const override { return {}; }
    std::optional<PatchReport> patch_report() const override { return transport_.report(); }

  private:
    /// Of a pass, each a task of its own.
    static constexpr std::uint64_t kMaps = 4;

    PictureTracing tracing_;
    PatchTransport transport_;
    std::uint64_t particles_ = std::max<std::uint64_t>(kLeastParticles, transport_.patches.count());
};

}  // namespace

std::unique_ptr<Estimator> make_particles_estimator(const EstimatorInput& input) {
    return std::make_unique<Particles>(input);
}

std::unique_ptr<PictureEstimator> make_particles_picture(const PictureInput& input) {
    return std::make_unique<ParticlesPicture>(input);
}

}  // namespace stilb::estimators
