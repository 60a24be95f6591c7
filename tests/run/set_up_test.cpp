// What is done before the first sample: it reports progress, and user and time limit can end it.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <thread>

#include "base/monitor.h"
#include "run/run.h"
#include "run/solve.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

Scene bare_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, diffuse(0.7));
    for (const double x : {1., 2., 3.}) add_point_light(scene, {x, 1.5, 2}, Rgb::grey(100));
    return scene;
}

const Sensor& floor_point() {
    static const Sensor sensor = point_sensor({{{1, 1.3, 0}, {0, 0, 1}}});
    return sensor;
}

Sensor view() {
    return {"camera",
            Camera{{0.3, 0.3, 1.5}, {2.3, 1.3, 0.7}, {0, 0, 1}, 70, {64, 48}, Projection::perspective}};
}

RunOptions options_for(const std::string& method) {
    RunOptions options;
    options.method = method;
    options.patch_m = 0.5;
    options.patches.resolution = 64;
    options.patches.shot_resolution = 32;
    if (method == "path") options.patches.first_shot.variant = estimators::FirstShotVariant::incoming;
    options.paths = 64;
    return options;
}

class Watcher final : public PictureSink {
  public:
    std::function<void(const SetUp&)> on_set_up = [](const SetUp&) {};

    void report_set_up(const SetUp& set_up) override {
        stages.insert(std::string(set_up.stage));
        EXPECT_GE(set_up.share, 0);
        EXPECT_LE(set_up.share, 1);
        EXPECT_EQ(samples, 0U);
        on_set_up(set_up);
    }
    void report(const Progress& progress) override { samples = progress.samples; }
    bool wants_picture() override { return false; }
    void show(const Pixels&) override {}

    std::set<std::string> stages;
    std::uint64_t samples = 0;
};

/// A method, and a stage of its set-up.
using StageOfMethod = std::pair<const char*, const char*>;

class SetUpStage : public testing::TestWithParam<StageOfMethod> {};

/// The message of Cancelled, which the action must throw.
std::string cancelled(const std::function<void()>& action) {
    try {
        action();
    } catch (const Cancelled& what) {
        return what.what();
    }
    return "not cancelled";
}

TEST_P(SetUpStage, ReadingsReportItAndCanBeCancelledInIt) {
    const auto& [method, stage] = GetParam();
    Watcher watcher;
    std::atomic<bool> interrupt = false;
    EXPECT_NO_THROW(measure(bare_room(), {&floor_point(), 1}, options_for(method), &watcher, &interrupt));
    EXPECT_TRUE(watcher.stages.contains(stage)) << method;

    Watcher canceller;
    canceller.on_set_up = [&](const ProgressSink::SetUp& set_up) {
        if (set_up.stage == stage) interrupt = true;
    };
    const std::string message = cancelled([&] {
        measure(bare_room(), {&floor_point(), 1}, options_for(method), &canceller, &interrupt);
    });
    EXPECT_NE(message.find("interrupted during set-up"), std::string::npos) << message;
    EXPECT_NE(message.find("no result"), std::string::npos) << message;
    EXPECT_EQ(canceller.samples, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Stages, SetUpStage,
    testing::Values(StageOfMethod{"radiosity", "patches"}, StageOfMethod{"radiosity", "first shot"},
                    StageOfMethod{"radiosity", "shooting"}, StageOfMethod{"ray-bundle", "first shot"},
                    StageOfMethod{"path", "first shot"}, StageOfMethod{"particles", "patches"}));

TEST(SetUpOfPictures, CanBeCancelled) {
    for (const char* method : {"auto", "radiosity", "ray-bundle"}) {
        std::atomic<bool> interrupt = false;
        Watcher watcher;
        watcher.on_set_up = [&](const ProgressSink::SetUp&) { interrupt = true; };
        EXPECT_NE(cancelled([&] {
                      render(bare_room(), view(), options_for(method), &watcher, &interrupt);
                  }).find("interrupted"),
                  std::string::npos)
            << method;
    }
}

TEST(SetUpOfSolutions, CanBeCancelled) {
    std::atomic<bool> interrupt = false;
    Watcher watcher;
    watcher.on_set_up = [&](const ProgressSink::SetUp& set_up) {
        if (set_up.stage == "first steps") interrupt = true;
    };
    const std::string message =
        cancelled([&] { solve(bare_room(), options_for("ray-bundle"), 2, &watcher, &interrupt); });
    EXPECT_NE(message.find("first steps"), std::string::npos) << message;
}

/// Lets the time run out at a stage.
Watcher sleeper(const char* stage, double until_s) {
    Watcher watcher;
    watcher.on_set_up = [=](const ProgressSink::SetUp& set_up) {
        if (set_up.stage != stage || set_up.elapsed_s > until_s) return;
        std::this_thread::sleep_for(std::chrono::duration<double>(until_s - set_up.elapsed_s + 0.01));
    };
    return watcher;
}

/// Where a stage does not say how far it is, the message still says what was reached, and what to do.
TEST(Monitor, SaysWhatEndsASetUp) {
    std::atomic<bool> interrupt = true;
    const Monitor interrupted(&interrupt, std::nullopt, {});
    EXPECT_EQ(cancelled([&] { interrupted.require_more(); }),
              "interrupted during set-up: there is no result yet");
    const Monitor late(nullptr, Monitor::Clock::now(), {});
    const std::string message = cancelled([&] { late.require_more(); });
    EXPECT_TRUE(message.starts_with("time limit reached during set-up after")) << message;
    EXPECT_NE(message.find("there is no result yet. Allow more time, or"), std::string::npos) << message;
    const Monitor patient(nullptr, std::nullopt, {});
    EXPECT_NO_THROW(patient.require_more());
}

TEST(TimeLimit, EndsTheSetUpWithoutAResult) {
    for (const auto& [method, stage] : {std::pair{"radiosity", "first shot"},
                                        {"ray-bundle", "first shot"},
                                        {"path", "first shot"},
                                        {"radiosity", "shooting"}}) {
        RunOptions options = options_for(method);
        options.time_s = 1;
        Watcher watcher = sleeper(stage, 1);
        const std::string message = cancelled([&] {
            measure(bare_room(), {&floor_point(), 1}, options, &watcher);
        });
        EXPECT_NE(message.find("time limit reached during set-up"), std::string::npos) << message;
        EXPECT_NE(message.find("Allow more time"), std::string::npos) << message;
    }
}

TEST(TimeLimit, ThatIsLongEnoughChangesNothing) {
    RunOptions options = options_for("radiosity");
    const RunResult unlimited = measure(bare_room(), {&floor_point(), 1}, options);
    options.time_s = 1e6;
    const RunResult limited = measure(bare_room(), {&floor_point(), 1}, options);
    EXPECT_EQ(limited.sensors[0].replicate_means, unlimited.sensors[0].replicate_means);
    EXPECT_EQ(limited.stop_reason, StopReason::paths_done);
    EXPECT_TRUE(limited.converged);
    EXPECT_EQ(limited.warnings, unlimited.warnings);
}

}  // namespace
}  // namespace stilb::run
