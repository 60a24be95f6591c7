// Runs that another run continues, and parts of runs: they have the bits of a run in one go.
#include "run/plan.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "estimators/estimator_list.h"
#include "run/run.h"
#include "stilb/error.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

struct PlanCase {
    const char* method;
    int points;  ///< a side of the grid
    std::uint64_t paths;
    double error = 0;  ///< that takes more than one look at the errors
};
void PrintTo(const PlanCase& c, std::ostream* out) { *out << c.method << " " << c.points; }

Scene lit_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {3, 3, 3}}, diffuse(0.5));
    add_object(scene, Box{{1.7, 0.6, 0.001}, {2.5, 1.4, 0.7}}, diffuse(0.5));
    add_area_light(scene, Rectangle{{1.1, 1.1, 2.99}, {0, 0.8, 0}, {0.8, 0, 0}}, Rgb::grey(5000));
    return scene;
}

Sensor floor_grid(int side) {
    return {"grid", Grid{{0.5, 0.5, 0.8}, {2, 0, 0}, {0, 2, 0}, {side, side}, Vec3{0, 0, 1}}};
}

std::string bytes_of(const RunState& state) {
    ByteWriter bytes;
    state.write(bytes);
    return bytes.take();
}

RunState state_of(const std::string& bytes) {
    const std::string name = "run";
    ByteReader reader(bytes, 0, name, "Run again.");
    RunState state = RunState::read(reader);
    reader.expect_end();
    return state;
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
    Scene scene_ = lit_room();
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
        RunState part = state_of(bytes_of({whole.plan, {}}));
        measure_part(scene_, {&sensor_, 1}, options_, {number, 3}, part);
        merged.merge(state_of(bytes_of(part)));
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
    state = state_of(bytes_of(state));
    EXPECT_EQ(numbers_of(run(rough, &state)), numbers_of(first)) << "nothing is left to do";
    EXPECT_EQ(numbers_of(run(exact, &state)), numbers_of(expected));
    EXPECT_EQ(bytes_of(state), bytes_of(in_one_go));
}

/// Interrupts after so many reports.
class Impatience final : public ProgressSink {
  public:
    explicit Impatience(int reports) : left_(reports) {}
    void report(const Progress&) override { interrupt = --left_ <= 0; }
    std::atomic<bool> interrupt = false;

  private:
    int left_;
};

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
    const Scene scene = lit_room();
    const Sensor sensor = floor_grid(2), other = floor_grid(3);
    RunState state;
    const RunOptions options = options_of("light-paths", 1 << 15);
    measure(scene, {&sensor, 1}, options, nullptr, nullptr, &state);
    RunState of_other_seed = state;
    of_other_seed.plan.seed = 8;
    EXPECT_THROW(of_other_seed.merge(state), std::invalid_argument);
    RunState twice = state;
    EXPECT_THROW(twice.merge(state), std::invalid_argument);
    RunState elsewhere = state;
    EXPECT_THROW(measure(scene, {&other, 1}, options, nullptr, nullptr, &elsewhere), std::invalid_argument);
    RunState part{state.plan, {}};
    EXPECT_THROW(measure_part(scene, {&sensor, 1}, options_of("auto", {}), {0, 2}, part), InputError);
    const std::string bytes = bytes_of(state);
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, bytes.size() / 2, bytes.size() - 1})
        EXPECT_THROW(state_of(bytes.substr(0, size)), InputError) << size;
}

TEST(RunState, OfAGridIsCompleteFromThePacesOn) {
    const Scene scene = lit_room();
    const Sensor sensor = floor_grid(8);
    RunState state;
    RunOptions options = options_of("guided", 8);
    measure(scene, {&sensor, 1}, options, nullptr, nullptr, &state);
    EXPECT_FALSE(state.plan.is_complete());
    RunState part{state.plan, {}};
    EXPECT_THROW(measure_part(scene, {&sensor, 1}, options, {0, 2}, part), std::invalid_argument);
    options.paths = 8 * 16;
    measure(scene, {&sensor, 1}, options, nullptr, nullptr, &state);
    EXPECT_TRUE(state.plan.is_complete());
    EXPECT_EQ(state.plan.paces.size(), 8u);
}

}  // namespace
}  // namespace stilb::run
