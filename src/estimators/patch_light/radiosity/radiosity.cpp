// Radiosity: radiosity.h describes the light of the patches, patch_readings.h readings and pictures of it.
//
// The light of the patches is deterministic. Its error is the discretisation: light that varies over a patch,
// and form factors from its middle. Samples are rays from the points to the patches: the standard errors of
// readings and pictures come from them alone.
#include "estimators/patch_light/radiosity/radiosity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "estimators/estimator_list.h"
#include "estimators/limits.h"
#include "estimators/patch_light/patch_readings.h"
#include "estimators/patch_light/radiosity/patch_shots.h"
#include "stilb/error.h"

namespace stilb::estimators {
namespace {

constexpr std::size_t kMostAtATime = 256;
/// The share of the sides with unshot flux that shoot together: few, so that they hardly illuminate one
/// another.
constexpr std::size_t kPartAtATime = 32;
constexpr std::uint64_t kMostShotsOfASide = 1000;

double magnitude(const FloatRgb& light) {
    return Rgb{{std::abs(light[0]), std::abs(light[1]), std::abs(light[2])}}.luminance();
}

ShootingOptions shooting_options(const PatchOptions& options) {
    ShootingOptions shooting = options.first_shot.shooting;
    shooting.resolution = options.shot_resolution;
    return shooting;
}

class Shooting {
  public:
    explicit Shooting(const PatchTransport& transport)
        : transport_(transport),
          shots_(transport.patch_caster, shooting_options(transport.options)),
          overshoot_(2 / (1 + std::sqrt(1 - std::pow(std::min(transport.mean_reflectance, 0.999), 2)))),
          reflected_(transport.first_reflection.size()),
          unshot_(transport.first_reflection) {
        for (std::size_t patch = 0; patch < transport.patches.count(); ++patch) {
            add_to(unshot_[patch], to_rgb(transport.emission[patch]));
        }
    }

    RadiositySolution run(const Monitor& monitor) {
        const double all = find_unshot(), enough = kUnshotShare * all;
        const std::uint64_t most = kMostShotsOfASide * unshot_.size();
        double left = all;
        while (left > enough) {
            if (done_ > most) {
                throw InputError(fmt::format(
                    "method radiosity did not converge after {} shots: reflectances close to 1 prevent it. "
                    "Lower them, or use method auto.",
                    done_));
            }
            // The unshot flux falls about exponentially.
            const double share = std::clamp(std::log(all / left) / std::log(1 / kUnshotShare), 0.0, 1.0);
            monitor.report("shooting", share);
            monitor.require_time("shooting", share);
            shoot();
            left = find_unshot();
        }
        return {ReflectedSides(std::move(reflected_)), done_, done_ * shots_.rays_per_shot()};
    }

  private:
    struct Candidate {
        double unshot_lm = 0;
        std::uint32_t side = 0;
        auto operator<=>(const Candidate&) const = default;
    };

    /// Finds the sides with unshot flux; returns its total [lm].
    double find_unshot() {
        double sum_lm = 0;
        candidates_.clear();
        for (std::uint32_t side = 0; side < unshot_.size(); ++side) {
            const double unshot_lm = std::numbers::pi * area_m2(side) * magnitude(unshot_[side]);
            if (!(unshot_lm > 0)) continue;
            candidates_.push_back({unshot_lm, side});
            sum_lm += unshot_lm;
        }
        return sum_lm;
    }

    void shoot() {
        const std::size_t count = std::clamp<std::size_t>(candidates_.size() / kPartAtATime, 1, kMostAtATime);
        const auto end = candidates_.begin() + static_cast<std::ptrdiff_t>(count);
        std::ranges::partial_sort(candidates_, end, std::greater<>());
        std::vector<std::uint32_t> senders;
        std::transform(candidates_.begin(), end, std::back_inserter(senders),
                       [](const Candidate& c) { return c.side; });
        const auto factors = shots_.from(senders);
        for (std::size_t i = 0; i < count; ++i) send(senders[i], factors[i]);
        done_ += count;
    }

    void send(std::uint32_t from, const std::vector<FormFactor>& factors) {
        const Rgb sent_cd_m2 = overshoot_ * to_rgb(unshot_[from]);
        add_to(unshot_[from], -1 * sent_cd_m2);
        const Rgb sent_lm = std::numbers::pi * area_m2(from) * sent_cd_m2;
        for (const auto& [to, share] : factors) {
            const FloatRgb& brdf = transport_.constant_brdf[to];
            const Rgb reflected = to_rgb(brdf) * sent_lm * (double{share} / area_m2(to));
            add_to(reflected_[to], reflected);
            add_to(unshot_[to], reflected);
        }
    }

    double area_m2(std::uint32_t side) const {
        return double{transport_.patches.areas_m2[transport_.patches.patch_of(side)]};
    }

    const PatchTransport& transport_;
    PatchShots shots_;
    double overshoot_;
    std::vector<FloatRgb> reflected_;  ///< [cd/m2], of every side, without first shot
    std::vector<FloatRgb> unshot_;     ///< [cd/m2], of every side
    std::vector<Candidate> candidates_;
    std::uint64_t done_ = 0;
};

constexpr std::string_view kRadiosity = "radiosity";

PatchTransport radiosity_transport(const Problem& problem) {
    require_diffuse(problem.scene, kRadiosity);
    require_no_light_from_outside(problem.scene, kRadiosity);
    require_all_reflections(problem.max_reflections, kRadiosity);
    const FirstShotVariant variant = problem.patches.first_shot.variant.value_or(kUsualFirstShot);
    require_first_shot_of_points(problem.scene, variant, kRadiosity);
    if (variant == FirstShotVariant::on_the_fly) {
        throw InputError(
            fmt::format("first shot \"{}\": method radiosity needs the light of small lights as a mean over "
                        "each patch. Use "
                        "first shot \"incoming\".",
                        name_of(variant)));
    }
    return {problem.scene, problem.caster, problem.patches, problem.monitor};
}

class Radiosity final : public Estimator {
  public:
    explicit Radiosity(const Problem& problem)
        : transport_(radiosity_transport(problem)),
          solution_(solve_radiosity(transport_, problem.monitor)),
          readings_(transport_, problem.measurands, 0, problem.monitor) {
        if (!problem.camera) return;
        tracing_.emplace(problem, transport_.lights);
        sides_cd_m2_ =
            VisibleSides(transport_, tracing_->view.position()).mean_cd_m2(solution_.light.cd_m2(), 1);
    }

    std::string_view technique() const override { return kRadiosity; }
    void run_batch(const Batch& batch, Tally& sums) const override {
        for (std::uint64_t i = batch.first; i < batch.first + batch.count; ++i) {
            readings_.add(solution_.light, {batch.key.derived(BatchStream::patch_readings)}, i, sums);
        }
    }
    std::span<const Rgb> known_part() const override { return readings_.known_part(); }
    std::span<const std::optional<Vec3>> sight_ends() const override { return readings_.sight_ends(); }
    std::uint64_t batch_granularity() const override { return 1; }
    std::uint64_t first_check() const override { return 16; }
    double rays_per_sample() const override { return 4 * static_cast<double>(known_part().size()); }

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<PatchPass>(*tracing_, transport_, pass, sides_cd_m2_);
    }
    std::vector<std::string> warnings() const override { return {}; }
    std::optional<PatchReport> patch_report() const override { return transport_.report(); }

  private:
    PatchTransport transport_;
    RadiositySolution solution_;
    PatchReadings readings_;
    std::optional<PictureTracing> tracing_;
    std::vector<FloatRgb> sides_cd_m2_;  ///< towards the camera
};

}  // namespace

RadiositySolution solve_radiosity(const PatchTransport& transport, const Monitor& monitor) {
    return Shooting(transport).run(monitor);
}

std::unique_ptr<Estimator> make_radiosity(const Problem& problem) {
    return std::make_unique<Radiosity>(problem);
}

}  // namespace stilb::estimators
