#include "run/solve.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>

#include "base/parallel.h"
#include "estimators/limits.h"
#include "estimators/patch_light/incoming_light.h"
#include "run/schedule.h"
#include "statistics/interval.h"
#include "stilb/error.h"
#include "transport/receiver.h"

namespace stilb::run {
namespace {

constexpr const char* kMethod = "ray-bundle";
/// The number of replicates; each has its own light in the file.
constexpr std::size_t kSolutionReplicates = 8;
/// Steps of each walk before the first error estimate.
constexpr std::uint64_t kFirstCheck = 16;
constexpr std::uint64_t kStepsAtOnce = 4;

/// Independent walks, each with its own sums.
class Walks final : public Work {
  public:
    Walks(const estimators::PatchTransport& transport, const estimators::TermLayout& layout,
          std::uint64_t seed, const Monitor& monitor)
        : transport_(transport), layout_(layout), monitor_(monitor), walks_(kSolutionReplicates) {
        const std::uint64_t dark = first_steps(transport);
        Stage stage(monitor, "first steps", kSolutionReplicates * dark);
        parallel_for(kSolutionReplicates, [&](std::size_t w) {
            walks_[w] = std::make_unique<Walk>(transport, layout, math::RandomKey{seed}.derived(w));
            for (std::uint64_t i = 0; i < dark; ++i) {
                walks_[w]->iteration.step();
                stage.advance();
            }
        });
    }

    /// Steps of each walk.
    std::uint64_t samples() const override { return walks_[0]->sums.steps(); }
    std::uint64_t samples_in_all() const override {
        std::uint64_t all = 0;
        for (const auto& walk : walks_) all += walk->sums.steps();
        return all;
    }
    std::uint64_t samples_for(std::uint64_t paths) const override {
        return (paths + kSolutionReplicates - 1) / kSolutionReplicates;
    }
    std::uint64_t most_samples() const override {
        return std::numeric_limits<std::uint64_t>::max() / kSolutionReplicates;
    }
    std::uint64_t next_check() const override { return statistics::next_check(samples(), kFirstCheck); }
    std::uint64_t most_at_once() const override { return kStepsAtOnce; }

    bool has_result() const override {
        return std::ranges::all_of(walks_, [](const auto& walk) { return walk->sums.steps() > 0; });
    }

    /// Where the run is ended, some walks may have made more steps than others.
    void advance(std::uint64_t steps) override {
        parallel_for(kSolutionReplicates, [&](std::size_t w) {
            for (std::uint64_t i = 0; i < steps; ++i) {
                monitor_.require_more();
                walks_[w]->iteration.step();
                walks_[w]->sums.add(walks_[w]->iteration);
            }
        });
    }

    std::vector<std::uint32_t> lit_sides() const {
        std::vector<std::uint32_t> sides;
        std::ranges::copy_if(layout_.sides(), std::back_inserter(sides), [&](std::uint32_t side) {
            return std::ranges::any_of(
                walks_, [&](const auto& walk) { return walk->sums.mean_illuminance_lx(side).max() > 0; });
        });
        return sides;
    }

    /// The errors of the sides' illuminances, first shot included, weighted by flux: sides with hardly
    /// any light, in cracks and where things touch, must not decide.
    double attained_error() const override {
        const std::vector<std::uint32_t> sides = lit_sides();
        if (sides.empty()) return 0;
        const estimators::IncomingFirstShot* const first_shot = transport_.first_shot.incoming();
        std::vector<double> means;
        for (const auto& walk : walks_) {
            for (const std::uint32_t side : sides) {
                Rgb illuminance_lx = walk->sums.mean_illuminance_lx(side);
                if (first_shot) illuminance_lx += first_shot->illuminance_lx(side);
                means.push_back(illuminance_lx.luminance());
            }
        }
        const std::vector<statistics::Estimate> estimates =
            statistics::estimate_readings({means, sides.size()}, statistics::kStoppedConfidence);
        std::vector<double> flux_lm;
        for (std::size_t i = 0; i < sides.size(); ++i) {
            const std::uint32_t patch = transport_.patches.patch_of(sides[i]);
            flux_lm.push_back(estimates[i].value * double{transport_.patches.areas_m2[patch]});
        }
        return stilb::statistics::attained_error(estimates, flux_lm);
    }

    /// The terms of the sides, replicate by replicate.
    std::vector<std::vector<estimators::FloatRgb>> terms_of(std::span<const std::uint32_t> sides) const {
        std::vector<std::vector<estimators::FloatRgb>> replicates;
        for (const auto& walk : walks_) {
            const std::vector<estimators::FloatRgb> all = walk->sums.mean();
            std::vector<estimators::FloatRgb>& terms = replicates.emplace_back();
            for (const std::uint32_t side : sides) {
                const estimators::FloatRgb* const first = &all[layout_.first_of(side)];
                terms.insert(terms.end(), first, first + layout_.count_of(side));
            }
        }
        return replicates;
    }

  private:
    struct Walk {
        Walk(const estimators::PatchTransport& transport, const estimators::TermLayout& layout,
             math::RandomKey key)
            : iteration(transport, key), sums(transport, layout) {}
        estimators::BundleIteration iteration;
        estimators::TermSums sums;
    };

    const estimators::PatchTransport& transport_;
    const estimators::TermLayout& layout_;
    const Monitor& monitor_;
    std::vector<std::unique_ptr<Walk>> walks_;
};

RunOptions with_solution_target(RunOptions options) {
    constexpr double default_time_s = 60;
    if (!options.error && !options.time_s && !options.paths) options.time_s = default_time_s;
    return options;
}

void require_storable(const Scene& scene, const RunOptions& options, int degree) {
    estimators::require_all_reflections(options.bounces.value_or(transport::kUnlimited), kMethod);
    if (degree < 0 || degree > math::ZernikeBasis::kMostDegree) {
        throw InputError(
            fmt::format("degree {}: from 0 to {} is needed", degree, math::ZernikeBasis::kMostDegree));
    }
    const estimators::FirstShotVariant variant =
        options.patches.first_shot.variant.value_or(estimators::kUsualFirstShot);
    estimators::require_first_shot_of_points(scene, variant != estimators::FirstShotVariant::none, kMethod);
    if (variant == estimators::FirstShotVariant::incoming || variant == estimators::FirstShotVariant::none)
        return;
    throw InputError(
        fmt::format("first shot \"{}\": a solution is view-independent and stores incident light. Allowed: "
                    "incoming, none.",
                    name_of(variant)));
}

}  // namespace

SolveResult solve(const Scene& scene, const RunOptions& asked_options, int degree, ProgressSink* progress,
                  const std::atomic<bool>* interrupt) {
    require_valid(asked_options);
    require_storable(scene, asked_options, degree);
    RunOptions options = with_solution_target(asked_options);
    options.method = kMethod;
    Session session(scene, asked_options, options, progress, interrupt);
    std::vector<std::string> of_scene = session.scene_warnings({});
    SolveResult result;
    session.on_threads([&] {
        const Monitor& monitor = session.monitor();
        const estimators::PatchTransport transport(scene, session.caster(), options.patches, monitor);
        const estimators::TermLayout layout(transport, degree, reflecting_sides(transport));
        Walks walks(transport, layout, options.seed, monitor);
        session.run(walks, result);
        result.patches = transport.report();
        estimators::PatchSolution& solution = result.solution;
        solution.patches = transport.patches;
        if (const auto* incoming = transport.first_shot.incoming()) solution.factors = incoming->factors();
        solution.degree = degree;
        solution.lit_sides = walks.lit_sides();
        solution.replicates = walks.terms_of(solution.lit_sides);
    });
    result.replicates = static_cast<int>(kSolutionReplicates);
    result.warnings = estimators::patch_warnings(scene, kMethod);
    std::ranges::move(of_scene, std::back_inserter(result.warnings));
    session.finish(result);
    return result;
}

}  // namespace stilb::run
