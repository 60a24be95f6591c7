#include "estimators/patch_light/radiosity/radiosity_solution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "estimators/patch_light/radiosity/patch_shots.h"

namespace stilb::estimators {
namespace {

constexpr std::size_t kMostAtATime = 256;
/// Of the sides that have something to send: few, so that those which shoot together hardly light one
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

    RadiositySolution run() {
        double left = look();
        const double enough = kUnshotShare * left;
        const std::uint64_t most = kMostShotsOfASide * unshot_.size();
        while (left > enough) {
            if (done_ > most) {
                throw InputError(fmt::format(
                    "method radiosity finds no end after {} shots: surfaces that reflect (nearly) "
                    "all light keep it for ever. Reflectances are below 1.",
                    done_));
            }
            shoot();
            left = look();
        }
        return {ReflectedSides(std::move(reflected_)), done_, done_ * shots_.rays_per_shot()};
    }

  private:
    struct Candidate {
        double unshot_lm = 0;
        std::uint32_t side = 0;
        auto operator<=>(const Candidate&) const = default;
    };

    /// Finds who has something to send; returns how much all have [lm].
    double look() {
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
            const FloatRgb& brdf = transport_.constant_brdf[transport_.patches.patch_of(to)];
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

}  // namespace

RadiositySolution solve_radiosity(const PatchTransport& transport) { return Shooting(transport).run(); }

}  // namespace stilb::estimators
