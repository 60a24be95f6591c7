#include "run/solve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "base/parallel.h"
#include "estimators/limits.h"
#include "estimators/patch_light/incoming_light.h"
#include "estimators/patch_light/solution/contact_refinement.h"
#include "estimators/patch_light/solution/group_sources.h"
#include "estimators/patch_light/solution/light_gather.h"
#include "run/schedule.h"
#include "run/solution_errors.h"
#include "run/streams.h"
#include "scene/light_groups.h"
#include "scene/sealed_sides.h"
#include "statistics/interval.h"
#include "stilb/error.h"
#include "transport/receiver.h"

namespace stilb::run {

SolutionState SolutionState::read(ByteReader& bytes) {
    SolutionState state;
    state.bytes_ = bytes.take_list<std::string>("the solution");
    return state;
}

namespace {

constexpr const char* kMethod = "ray-bundle";
/// The number of replicates of the gathering; the file has the light of each.
constexpr std::size_t kSolutionReplicates = 8;
/// Each has all groups of lights in memory.
constexpr std::size_t kWalks = 2;
/// Steps of the gathering before the first error estimate.
constexpr std::uint64_t kFirstCheck = 16;
constexpr std::uint64_t kStepsAtOnce = 4;

/// Counted steps of the walks before it is known which sides of patches light reaches at all.
constexpr std::uint64_t kStepsToFindLight = 16;

/// Walks, and the gathering of their light at the vertices.
class Walks final : public Work {
  public:
    Walks(const estimators::PatchTransport& transport, int degree, const LightGroups& groups,
          std::uint64_t seed, const Monitor& monitor, SolutionSink* sink)
        : transport_(transport),
          groups_(groups),
          sources_(transport, groups),
          monitor_(monitor),
          sink_(sink) {
        const math::KeyOf key = key_of_seed(seed);
        const std::uint64_t dark = first_steps(transport);
        Stage stage(monitor, "first steps", kWalks * (dark + kStepsToFindLight));
        for (std::size_t w = 0; w < kWalks; ++w)
            walks_.emplace_back(
                transport, sources_.sources(),
                math::KeyOf<estimators::BundleIteration::Stream>{key.derived(RunStream::walks).derived(w)});
        sums_.emplace(transport, estimators::TermLayout(transport, degree, reflecting_sides(transport)),
                      groups.count());
        for (std::uint64_t i = 0; i < dark + kStepsToFindLight; ++i) {
            parallel_for(walks_.size(), [&](std::size_t w) {
                walks_[w].step();
                stage.advance();
            });
            if (i >= dark) add_walks();
        }
        const estimators::SideLight light = light_of_sides();
        sums_.emplace(sums_->of_sides(sides_with(light)));
        fine_ = patches_near_contacts(transport, light, kMostFinePatches, monitor);
        gather_.emplace(transport, *sums_, kSolutionReplicates, light.is_lit, fine_, groups,
                        key.derived(RunStream::gathering), monitor);
        if (sink_) sink_->prepare(transport.caster, gather_->solution());
    }

    /// Steps of each replicate.
    std::uint64_t samples() const override { return gather_->steps(); }
    std::uint64_t samples_in_all() const override { return samples() * kSolutionReplicates; }
    std::uint64_t samples_for(std::uint64_t paths) const override {
        return std::max((paths + kSolutionReplicates - 1) / kSolutionReplicates,
                        estimators::LightGather::kFirstSteps);
    }
    std::uint64_t most_samples() const override {
        return std::numeric_limits<std::uint32_t>::max() / kSolutionReplicates;
    }
    std::uint64_t next_check() const override { return statistics::next_check(samples(), kFirstCheck); }
    bool is_at_check() const override {
        return samples() > 0 && statistics::next_check(samples() - 1, kFirstCheck) == samples();
    }
    std::uint64_t most_at_once() const override { return kStepsAtOnce; }
    bool has_result() const override { return samples() >= estimators::LightGather::kFirstSteps; }

    /// Walks and gathering step at the same time; what is gathered has the walks' light of the step before. A
    /// step is not interrupted: another run continues whole steps.
    void advance(std::uint64_t steps) override {
        for (std::uint64_t i = 0; i < steps; ++i) {
            monitor_.require_more();
            parallel_for(walks_.size() + 1, [&](std::size_t task) {
                task < walks_.size() ? walks_[task].step() : gather_->step();
            });
            add_walks();
        }
    }

    double attained_error() const override {
        return attained_errors(fine_.patches, gather_->illuminances()).all;
    }
    bool is_beyond_reach(double error) const override {
        return attained_errors(fine_.patches, gather_->illuminances()).bias > error;
    }

    void show() override {
        if (!sink_ || !has_result() || !sink_->wants_solution()) return;
        RunSummary so_far;
        so_far.samples = samples_in_all();
        so_far.attained_error = attained_error();
        sink_->show(solution(), so_far);
    }

    std::string bytes() const {
        ByteWriter bytes;
        for (const estimators::BundleIteration& walk : walks_) walk.write(bytes);
        sums_->write(bytes);
        gather_->write(bytes);
        return bytes.take();
    }
    void read(ByteReader bytes) {
        for (estimators::BundleIteration& walk : walks_) walk.read(bytes);
        sums_->read(bytes);
        gather_->read(bytes);
        bytes.expect_end();
    }

    /// At the end: the memory of the walks is free for it.
    estimators::PatchSolution last_solution() {
        walks_.clear();
        sums_.reset();
        return solution();
    }

  private:
    estimators::PatchSolution solution() const {
        return rounded_to_errors(gather_->solution(), transport_.scene);
    }

    void add_walks() {
        std::vector<const estimators::BundleIteration*> walks;
        for (const estimators::BundleIteration& walk : walks_) walks.push_back(&walk);
        sums_->add(walks);
    }

    estimators::SideLight light_of_sides() const {
        const patches::Patches& patches = transport_.patches;
        estimators::SideLight light{std::vector<bool>(2 * patches.count()),
                                    std::vector<double>(2 * patches.count())};
        for (std::uint32_t patch = 0; patch < patches.count(); ++patch)
            light.is_lit[patch] = estimators::to_rgb(transport_.emission[patch]).max() > 0;
        const std::vector<bool> is_sealed = sealed_sides(transport_.scene);
        for (const std::uint32_t side : sums_->layout().sides()) {
            const ObjectId object = patches.object_of(patches.patch_of(side));
            if (is_sealed[ObjectSide{object, patches.is_front(side)}.number()]) continue;
            const Rgb received_lx = illuminance_lx(side);
            light.lx[side] = received_lx.luminance();
            light.is_lit[side] = light.is_lit[side] || received_lx.max() > 0;
        }
        return light;
    }

    /// The sides with terms that light reaches.
    std::vector<std::uint32_t> sides_with(const estimators::SideLight& light) const {
        std::vector<std::uint32_t> sides;
        std::ranges::copy_if(sums_->layout().sides(), std::back_inserter(sides),
                             [&](std::uint32_t side) { return light.is_lit[side]; });
        return sides;
    }

    Rgb illuminance_lx(std::uint32_t side) const {
        Rgb by_walks;
        for (std::size_t g = 0; g < groups_.count(); ++g)
            by_walks += estimators::to_rgb(sums_->sums_of(g, side)[0]);
        const double scale = std::sqrt(kPi) / static_cast<double>(sums_->steps());
        const estimators::IncomingFirstShot* const first_shot = transport_.first_shot.incoming();
        return by_walks * scale + (first_shot ? first_shot->illuminance_lx(side) : Rgb());
    }

    const estimators::PatchTransport& transport_;
    const LightGroups& groups_;
    estimators::GroupSources sources_;
    std::optional<estimators::TermSums> sums_;
    const Monitor& monitor_;
    SolutionSink* sink_;
    std::vector<estimators::BundleIteration> walks_;
    patches::FinePatches fine_;
    std::optional<estimators::LightGather> gather_;
};

/// Runs the walks, from the state on where there is one, and leaves the state as it is then.
void run_from(SolutionState* state, Walks& walks, Session& session, RunSummary& result) {
    if (!state) return session.run(walks, result);
    static const std::string name = "the state of the solution";
    if (state->has_begun()) walks.read({state->bytes(), 0, name, "Solve the scene again."});
    state->follow([&walks] { return walks.bytes(); });
    try {
        session.run(walks, result);
    } catch (...) {
        state->end();
        throw;
    }
    state->end();
}

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
    estimators::require_first_shot_of_points(scene, variant, kMethod);
    if (variant == estimators::FirstShotVariant::incoming || variant == estimators::FirstShotVariant::none)
        return;
    throw InputError(
        fmt::format("first shot \"{}\": a solution is view-independent and stores incident light. Allowed: "
                    "incoming, none.",
                    name_of(variant)));
}

}  // namespace

SolveResult solve(const PreparedScene& prepared, const RunOptions& asked_options, int degree,
                  ProgressSink* progress, const std::atomic<bool>* interrupt, SolutionSink* sink,
                  SolutionState* state) {
    const Scene& scene = prepared.scene();
    require_valid(asked_options);
    require_storable(scene, asked_options, degree);
    RunOptions options = with_solution_target(asked_options);
    options.method = kMethod;
    Session session(prepared, {}, asked_options, options, progress, interrupt);
    std::vector<Warning> of_scene = session.scene_warnings({});
    if (!options.patch_m) options.patch_m = patches::patch_size_m(scene, kSolutionPatches);
    SolveResult result;
    result.technique = kMethod;
    session.on_threads([&] {
        const Monitor& monitor = session.monitor();
        const estimators::PatchTransport transport(scene, session.caster(),
                                                   {options.patches, options.patch_m}, monitor);
        const LightGroups groups = scene::light_groups(scene);
        Walks walks(transport, degree, groups, options.seed, monitor, sink);
        run_from(state, walks, session, result);
        result.patches = transport.report();
        result.solution = walks.last_solution();
    });
    result.replicates = static_cast<int>(kSolutionReplicates);
    add_warnings(WarningKind::method, estimators::solution_warnings(scene), result.warnings);
    std::ranges::move(of_scene, std::back_inserter(result.warnings));
    session.finish(result);
    return result;
}

}  // namespace stilb::run
