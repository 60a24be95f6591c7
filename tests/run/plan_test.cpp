// Runs that another run continues, and parts of runs: they have the bits of a run in one go.
#include "run/plan.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "estimators/estimator_list.h"
#include "run/glare/glare.h"
#include "run/readings/campaign.h"
#include "run/readings/possible_light.h"
#include "run/run.h"
#include "stilb/error.h"
#include "support/continued_runs.h"

namespace stilb::run {
namespace {

struct PlanCase {
    const char* method;
    int points;  ///< a side of the grid
    std::uint64_t paths;
    double error = 0;  ///< that takes more than one look at the errors
};
void PrintTo(const PlanCase& c, std::ostream* out) { *out << c.method << " " << c.points; }

Sensor floor_grid(int side) {
    return {"grid", Grid{{0.5, 0.5, 0.8}, {2, 0, 0}, {0, 2, 0}, {side, side}, Vec3{0, 0, 1}}};
}

std::vector<double> numbers_of(const RunResult& result) {
    std::vector<double> numbers{static_cast<double>(result.samples), static_cast<double>(result.rays)};
    for (const Reading& reading : result.sensors.at(0).readings) {
        numbers.push_back(reading.estimate.value);
        numbers.push_back(reading.estimate.standard_error);
        for (const double band : reading.rgb.band) numbers.push_back(band);
    }
    return numbers;
}

RunOptions options_of(const char* method, std::optional<std::uint64_t> paths) {
    RunOptions options;
    options.method = method;
    options.paths = paths;
    if (estimators::find_estimator(method).lights_patches) options.patch_m = 1;
    return options;
}

class RunOfPlan : public testing::TestWithParam<PlanCase> {
  protected:
    Scene scene_ = room_with_box();
    Sensor sensor_ = floor_grid(GetParam().points);
    RunOptions options_ = options_of(GetParam().method, GetParam().paths);

    RunResult run(const RunOptions& options, RunState* state, ProgressSink* sink = nullptr,
                  const std::atomic<bool>* interrupt = nullptr) const {
        return measure(scene_, {&sensor_, 1}, options, sink, interrupt, state);
    }
};

TEST_P(RunOfPlan, HasTheSameBitsInParts) {
    RunState whole;
    const RunResult in_one_go = run(options_, &whole);
    ASSERT_TRUE(whole.plan.is_complete());
    RunState merged{whole.plan, {}};
    for (std::size_t number = 0; number < 3; ++number) {
        RunState part = read_state<RunState>(bytes_of(RunState{whole.plan, {}}));
        measure_part(scene_, {&sensor_, 1}, options_, {number, 3}, part);
        merged.merge(read_state<RunState>(bytes_of(part)));
    }
    EXPECT_EQ(bytes_of(merged), bytes_of(whole));
    EXPECT_EQ(numbers_of(run(options_, &merged)), numbers_of(in_one_go));
}

/// Without patches, whose own error would end the run.
class RunByError : public RunOfPlan {};

TEST_P(RunByError, HasTheSameBitsWhereItGoesOn) {
    RunOptions rough = options_, exact = options_;
    rough.paths.reset(), exact.paths.reset();
    rough.error = 0.9, exact.error = GetParam().error;
    RunState state, in_one_go;
    const RunResult first = run(rough, &state);
    const RunResult expected = run(exact, &in_one_go);
    ASSERT_LT(first.samples, expected.samples);
    state = read_state<RunState>(bytes_of(state));
    EXPECT_EQ(numbers_of(run(rough, &state)), numbers_of(first)) << "nothing is left to do";
    EXPECT_EQ(numbers_of(run(exact, &state)), numbers_of(expected));
    EXPECT_EQ(bytes_of(state), bytes_of(in_one_go));
}

TEST_P(RunOfPlan, HasTheSameBitsAfterAnInterruption) {
    RunState whole, state;
    const RunResult in_one_go = run(options_, &whole);
    Impatience impatience(2);
    const RunResult interrupted = run(options_, &state, &impatience, &impatience.interrupt);
    ASSERT_LT(interrupted.samples, in_one_go.samples);
    EXPECT_EQ(interrupted.stop_reason, StopReason::interrupted);
    EXPECT_EQ(numbers_of(run(options_, &state)), numbers_of(in_one_go));
    EXPECT_EQ(bytes_of(state), bytes_of(whole));
}

const PlanCase kAuto{"auto", 2, 1 << 16, 0.0008}, kLightPaths{"light-paths", 4, 1 << 16, 0.01},
    kGuided{"guided", 4, 1 << 10, 0.001}, kGrid{"guided", 12, 1 << 10, 0.003},
    kPath{"path", 3, 1 << 16, 0.0015};
INSTANTIATE_TEST_SUITE_P(Methods, RunOfPlan,
                         testing::Values(kAuto, kLightPaths, kGuided, kGrid, kPath,
                                         PlanCase{"ray-bundle", 3, 1 << 13},
                                         PlanCase{"particles", 3, 1 << 20},
                                         PlanCase{"radiosity", 3, 1 << 10}));
INSTANTIATE_TEST_SUITE_P(Methods, RunByError, testing::Values(kAuto, kLightPaths, kGuided, kGrid, kPath));

TEST(RunState, RefusesWhatDoesNotFit) {
    const Scene scene = room_with_box();
    const Sensor sensor = floor_grid(2), other = floor_grid(3);
    RunState state;
    const RunOptions options = options_of("light-paths", 1 << 15);
    measure(scene, {&sensor, 1}, options, nullptr, nullptr, &state);
    RunState of_other_plan = state;
    of_other_plan.plan.unit *= 2;
    EXPECT_THROW(of_other_plan.merge(state), std::invalid_argument);
    RunState twice = state;
    EXPECT_THROW(twice.merge(state), std::invalid_argument);
    RunState elsewhere = state;
    EXPECT_THROW(measure(scene, {&other, 1}, options, nullptr, nullptr, &elsewhere), std::invalid_argument);
    RunState part{state.plan, {}};
    EXPECT_THROW(measure_part(scene, {&sensor, 1}, options_of("auto", {}), {0, 2}, part), InputError);
    const std::string bytes = bytes_of(state);
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, bytes.size() / 2, bytes.size() - 1})
        EXPECT_THROW(read_state<RunState>(bytes.substr(0, size)), InputError) << size;
}

TEST(RunState, StaysWhereARunIsRefused) {
    const Scene scene = room_with_box();
    const Sensor sensor = floor_grid(2), other = floor_grid(3);
    RunState state;
    RunOptions options = options_of("light-paths", 1 << 15);
    measure(scene, {&sensor, 1}, options, nullptr, nullptr, &state);
    const std::string before = bytes_of(state);
    EXPECT_THROW(measure(scene, {&other, 1}, options, nullptr, nullptr, &state), std::invalid_argument);
    EXPECT_EQ(bytes_of(state), before);
    options.threads = -1;
    EXPECT_THROW(measure(scene, {&sensor, 1}, options, nullptr, nullptr, &state), InputError);
    EXPECT_EQ(bytes_of(state), before);
    // The sums of the last strand alone are of other readings.
    options.threads = 0;
    state.tallies.back().sum.pop_back();
    EXPECT_THROW(measure(scene, {&sensor, 1}, options, nullptr, nullptr, &state), std::invalid_argument);
}

/// A reading of about 1 lx; a run is interrupted after so many batches.
class Interrupted final : public estimators::Estimator {
  public:
    explicit Interrupted(int batches) : left_(batches) {}
    std::string_view technique() const override { return "made up"; }
    void run_batch(const estimators::Batch& batch, estimators::Tally& sums) const override {
        if (left_-- <= 0) throw Cancelled("interrupted");
        for (std::uint64_t i = batch.first; i < batch.first + batch.count; ++i)
            sums.add(0, Rgb::grey(0.5 + math::SampleStream(batch.key.key, i, 0).next()));
    }
    std::span<const Rgb> known_part() const override { return known_; }
    std::span<const std::optional<Vec3>> sight_ends() const override { return {}; }
    std::uint64_t batch_granularity() const override { return 1; }
    double rays_per_sample() const override { return 1; }
    std::vector<std::string> warnings() const override { return {}; }
    std::unique_ptr<const estimators::PicturePass> start(const estimators::Pass&) const override {
        return nullptr;
    }

  private:
    mutable std::atomic<int> left_;
    std::vector<Rgb> known_ = {Rgb{}};
};

/// A run that was interrupted in its first batch has begun some replicates: a result needs 8 of them, and
/// takes these alone, also where another run goes on with them.
TEST(RunState, MayLackReplicates) {
    const Scene scene = room_with_box();
    const rays::RayCaster caster(scene);
    const std::vector<Sensor> sensors{floor_grid(1)};
    const RunOptions options;
    const GlareViews glare(sensors, {scene, caster, 8, 1, Monitor::none()}, 32, {math::RandomKey{1}});
    const LightDivision together;
    for (const int begun : {0, 3, 7, 8, 31}) {
        const Interrupted method(begun);
        const PossibleLight possible(scene, caster, 8, method);
        RunState state{RunPlan::of(sensors, options, false), {}};
        Campaign first(method, sensors, glare, possible, 1, together, state, options, 0);
        EXPECT_THROW(first.advance(64), Cancelled);
        const Campaign other(method, sensors, glare, possible, 1, together, state, options, 0);
        for (const Campaign* campaign : {static_cast<const Campaign*>(&first), &other}) {
            EXPECT_EQ(campaign->has_result(), begun >= 8);
            EXPECT_EQ(campaign->replicates(), static_cast<std::size_t>(begun));
            if (begun < 8) continue;
            EXPECT_NEAR(campaign->estimates(sensors[0], 0, 0.95).readings[0].value, 1, 0.1);
        }
    }
}

/// Parts that ended at different numbers of paths: each strand is continued from where it is.
TEST(RunState, OfPartsThatEndElsewhereGoesOn) {
    const Scene scene = room_with_box();
    const Sensor sensor = floor_grid(2);
    RunOptions more = options_of("light-paths", 1 << 16), fewer = options_of("light-paths", 1 << 15);
    RunState whole;
    const RunResult in_one_go = measure(scene, {&sensor, 1}, more, nullptr, nullptr, &whole);
    RunState first{whole.plan, {}}, second{whole.plan, {}};
    measure_part(scene, {&sensor, 1}, fewer, {0, 2}, first);
    measure_part(scene, {&sensor, 1}, more, {1, 2}, second);
    first.merge(second);
    EXPECT_EQ(numbers_of(measure(scene, {&sensor, 1}, more, nullptr, nullptr, &first)),
              numbers_of(in_one_go));
    EXPECT_THROW(measure_part(scene, {&sensor, 1}, more, {2, 2}, second), InputError);
}

TEST(RunState, OfDamagedBytesIsRefused) {
    constexpr std::size_t most = std::size_t{1} << 20;  // kMostUnits
    const auto is_read = [](const RunPlan& plan) {
        try {
            read_state<RunState>(bytes_of(RunState{plan, {}}));
            return true;
        } catch (const InputError&) {
            return false;
        }
    };
    RunPlan plan;
    plan.technique = "path";
    for (const std::size_t count : {most - 1, most, most + 1, std::size_t{0}}) {
        const bool is_allowed = count > 0 && count <= most;
        plan.replicates = count, plan.strands = 1;
        EXPECT_EQ(is_read(plan), is_allowed) << count;
        plan.replicates = 1, plan.strands = count;
        EXPECT_EQ(is_read(plan), is_allowed) << count;
    }
    plan.replicates = 2, plan.strands = most / 2;
    EXPECT_TRUE(is_read(plan));
    plan.strands = most / 2 + 1;
    EXPECT_FALSE(is_read(plan));
    plan.strands = 1;
    plan.paces.assign(2, {{4, 1, 2}});
    EXPECT_TRUE(is_read(plan));
    plan.paces[1] = {{4, 0, 2}};
    EXPECT_FALSE(is_read(plan)) << "a pace that takes no samples";
    plan.paces.clear();
    plan.unit = 0;
    EXPECT_FALSE(is_read(plan));
}

TEST(RunState, OfAGridIsCompleteFromThePacesOn) {
    const Scene scene = room_with_box();
    const Sensor sensor = floor_grid(8);
    RunState state;
    RunOptions options = options_of("guided", 8);
    measure(scene, {&sensor, 1}, options, nullptr, nullptr, &state);
    EXPECT_FALSE(state.plan.is_complete());
    RunState part{state.plan, {}};
    measure_part(scene, {&sensor, 1}, options, {0, 2}, part);
    EXPECT_TRUE(part.plan.is_complete() && part.plan.paces.empty()) << "so few samples decide no paces";
    options.paths = 8 * 16;
    measure(scene, {&sensor, 1}, options, nullptr, nullptr, &state);
    EXPECT_TRUE(state.plan.is_complete());
    EXPECT_EQ(state.plan.paces.size(), 8u);
}

/// Parts that begin without a plan make the same one, each by itself, also where samples decide the paces.
TEST(RunState, OfPartsWithoutAPlanIsThatOfTheWhole) {
    const Scene scene = room_with_box();
    const Sensor sensor = floor_grid(8);
    const RunOptions options = options_of("guided", 8 * 32);
    RunState whole;
    measure(scene, {&sensor, 1}, options, nullptr, nullptr, &whole);
    ASSERT_FALSE(whole.plan.paces.empty());
    std::optional<RunState> merged;
    for (std::size_t number = 0; number < 5; ++number) {
        RunState part;
        measure_part(scene, {&sensor, 1}, options, {number, 5}, part);
        merged ? merged->merge(read_state<RunState>(bytes_of(part))) : void(merged = part);
    }
    EXPECT_EQ(bytes_of(*merged), bytes_of(whole));
}

/// The replicates of one seed are added to those of the other: means by samples, and the errors of as many.
TEST(RunState, OfSeveralSeedsHasTheirSamples) {
    const Scene scene = room_with_box();
    const Sensor sensor = floor_grid(2);
    std::vector<RunState> states(2);
    std::vector<RunResult> results;
    for (std::size_t i = 0; i < 2; ++i) {
        RunOptions options = options_of("light-paths", (i + 1) << 15);
        options.seed = i + 1;
        results.push_back(measure(scene, {&sensor, 1}, options, nullptr, nullptr, &states[i]));
    }
    RunState merged = states[0];
    merged.merge(states[1]);
    EXPECT_EQ(merged.seeds(), (std::vector<std::uint64_t>{1, 2}));
    merged = read_state<RunState>(bytes_of(merged));
    EXPECT_THROW(merged.merge(states[1]), std::invalid_argument) << "its seed is there";
    const RunResult of_both = result_of(scene, {&sensor, 1}, options_of("light-paths", 1 << 15), merged);
    EXPECT_EQ(of_both.samples, results[0].samples + results[1].samples);
    for (std::size_t j = 0; j < 4; ++j) {
        const double expected = (results[0].sensors[0].readings[j].estimate.value +
                                 2 * results[1].sensors[0].readings[j].estimate.value) /
                                3;
        EXPECT_NEAR(of_both.sensors[0].readings[j].estimate.value, expected, 1e-9 * expected);
    }
    EXPECT_THROW(measure(scene, {&sensor, 1}, options_of("light-paths", 1 << 17), nullptr, nullptr, &merged),
                 std::invalid_argument)
        << "no seed of its own goes on";
}

}  // namespace
}  // namespace stilb::run
