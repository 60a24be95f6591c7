#include "run/solve.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

#include "base/error.h"
#include "estimators/estimator.h"
#include "estimators/limits.h"
#include "estimators/patch_light/incoming_light.h"
#include "run/clock.h"
#include "run/remaining_time.h"
#include "run/threads.h"
#include "statistics/interval.h"
#include "statistics/stopping.h"

namespace stilb::run {
namespace {

/// Each has its own light in the file.
constexpr std::size_t kReplicates = 8;
/// Of each walk, before the first look at the errors.
constexpr std::uint64_t kFirstLook = 16;
/// Between two looks at the clock.
constexpr std::uint64_t kStepsAtOnce = 4;

/// Independent walks, each with its own sums.
class Walks {
  public:
    Walks(const estimators::PatchTransport& transport, const estimators::TermLayout& layout,
          std::uint64_t seed)
        : transport_(transport), layout_(layout), walks_(kReplicates) {
        const std::uint64_t dark = first_steps(transport);
        tbb::parallel_for(std::size_t{0}, kReplicates, [&](std::size_t w) {
            walks_[w] = std::make_unique<Walk>(transport, layout, math::RandomKey{seed}.derived(w));
            for (std::uint64_t i = 0; i < dark; ++i) walks_[w]->iteration.step();
        });
    }

    void advance(std::uint64_t steps) {
        tbb::parallel_for(std::size_t{0}, kReplicates, [&](std::size_t w) {
            for (std::uint64_t i = 0; i < steps; ++i) {
                walks_[w]->iteration.step();
                walks_[w]->sums.add(walks_[w]->iteration);
            }
        });
    }

    /// Of each.
    std::uint64_t steps() const { return walks_[0]->sums.steps(); }

    std::vector<std::uint32_t> lit_sides() const {
        std::vector<std::uint32_t> sides;
        std::ranges::copy_if(layout_.sides(), std::back_inserter(sides), [&](std::uint32_t side) {
            return std::ranges::any_of(
                walks_, [&](const auto& walk) { return walk->sums.mean_illuminance_lx(side).max() > 0; });
        });
        return sides;
    }

    /// Of the sides' illuminances, first shot included, by how much of the flux they get: sides that hardly
    /// any light comes to, in cracks and where things touch, must not decide.
    double attained_error() const {
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
    std::vector<std::unique_ptr<Walk>> walks_;
};

/// Steps until a stop rule says so; keeps stop_reason and attained_error of the result.
class SolveSchedule {
  public:
    SolveSchedule(const RunOptions& options, const Clock& clock, ProgressSink* progress,
                  const std::atomic<bool>* interrupt)
        : options_(options), clock_(clock), progress_(progress), interrupt_(interrupt) {
        if (options.paths) last_step_ = (*options.paths + kReplicates - 1) / kReplicates;
    }

    void proceed(Walks& walks, SolveResult& result) {
        result.attained_error = std::numeric_limits<double>::infinity();
        for (;;) {
            const std::uint64_t look = std::min(last_step_, statistics::next_look(walks.steps(), kFirstLook));
            const auto reason = advance_to(look, walks, result.attained_error);
            result.attained_error = walks.attained_error();
            const bool reached = options_.error && result.attained_error <= *options_.error;
            if (!reached && !reason && look < last_step_) continue;
            result.stop_reason =
                reached ? StopReason::target_reached : reason.value_or(StopReason::paths_done);
            return;
        }
    }

  private:
    /// Why it got no farther, if it did not.
    std::optional<StopReason> advance_to(std::uint64_t look, Walks& walks, double last_error) {
        while (walks.steps() < look) {
            if (walks.steps() > 0 && interrupt_ && *interrupt_) return StopReason::interrupted;
            const std::uint64_t next = std::min(kStepsAtOnce, look - walks.steps());
            if (is_time_over(walks.steps(), next)) return StopReason::time_over;
            walks.advance(next);
            report(walks.steps(), last_error);
        }
        return std::nullopt;
    }

    /// A first round is always made: there is no result without one.
    bool is_time_over(std::uint64_t steps, std::uint64_t next) const {
        if (!options_.time_s || steps == 0) return false;
        const double share = static_cast<double>(next) / static_cast<double>(steps);
        return clock_.elapsed_s() * (1 + share) > *options_.time_s;
    }

    void report(std::uint64_t steps, double last_error) const {
        if (!progress_) return;
        const double elapsed_s = clock_.elapsed_s();
        const double done = static_cast<double>(steps) / static_cast<double>(last_step_);
        progress_->report({elapsed_s, remaining_time_s(options_, elapsed_s, last_error, done), last_error,
                           steps * kReplicates});
    }

    const RunOptions& options_;
    const Clock& clock_;
    ProgressSink* progress_;
    const std::atomic<bool>* interrupt_;
    std::uint64_t last_step_ = std::numeric_limits<std::uint64_t>::max() / kReplicates;
};

RunOptions with_target(RunOptions options) {
    constexpr double default_time_s = 60;
    if (!options.error && !options.time_s && !options.paths) options.time_s = default_time_s;
    return options;
}

void require_storable(const Scene& scene, const RunOptions& options, int degree) {
    estimators::require_all_reflections(options.bounces.value_or(transport::kUnlimited), "ray-bundle");
    if (degree < 0 || degree > math::ZernikeBasis::kMostDegree) {
        throw InputError(
            fmt::format("degree {}: from 0 to {} is needed", degree, math::ZernikeBasis::kMostDegree));
    }
    const estimators::FirstShotVariant variant =
        options.patches.first_shot.variant.value_or(estimators::kUsualFirstShot);
    estimators::require_first_shot_of_points(scene, variant != estimators::FirstShotVariant::none,
                                             "ray-bundle");
    if (variant == estimators::FirstShotVariant::incoming || variant == estimators::FirstShotVariant::none)
        return;
    throw InputError(fmt::format(
        "--first-shot {}: a solution is for all eyes, and keeps what arrives. Allowed: incoming, none.",
        name_of(variant)));
}

}  // namespace

SolveResult solve(const Scene& scene, const RunOptions& asked_options, int degree, ProgressSink* progress,
                  const std::atomic<bool>* interrupt) {
    require_valid(asked_options);
    require_storable(scene, asked_options, degree);
    const RunOptions options = with_target(asked_options);
    const Clock clock;
    const rays::RayCaster caster(scene);
    Threads threads(options.threads);
    SolveResult result;
    threads.arena.execute([&] {
        const estimators::PatchTransport transport(scene, caster, options.patches);
        const estimators::TermLayout layout(transport, degree, reflecting_sides(transport));
        Walks walks(transport, layout, options.seed);
        SolveSchedule(options, clock, progress, interrupt).proceed(walks, result);
        result.steps = walks.steps() * kReplicates;
        result.patches = transport.report();
        estimators::PatchSolution& solution = result.solution;
        solution.patches = transport.patches;
        if (const auto* incoming = transport.first_shot.incoming()) solution.factors = incoming->factors();
        solution.degree = degree;
        solution.lit_sides = walks.lit_sides();
        solution.replicates = walks.terms_of(solution.lit_sides);
    });
    result.seed = options.seed;
    result.converged = result.stop_reason != StopReason::interrupted &&
                       (!options.error || result.stop_reason == StopReason::target_reached);
    result.warnings = estimators::patch_warnings(scene, "ray-bundle");
    result.elapsed_s = clock.elapsed_s();
    return result;
}

}  // namespace stilb::run
