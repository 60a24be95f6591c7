// The rules by which runs end, with work whose error and speed are made up.
#include "run/schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "stilb/error.h"

namespace stilb::run {
namespace {

/// Two replicates, looks after 4, 8, 16 ... samples, and an error of 1 / sqrt(samples).
class MadeUpWork final : public Work {
  public:
    std::uint64_t samples() const override { return samples_; }
    std::uint64_t samples_in_all() const override { return 2 * samples_; }
    std::uint64_t samples_for(std::uint64_t paths) const override { return (paths + 1) / 2; }
    std::uint64_t most_samples() const override { return 1000; }
    bool has_result() const override { return samples_ >= least; }
    std::uint64_t next_check() const override {
        std::uint64_t look = 4;
        while (look <= samples_) look *= 2;
        return look;
    }
    std::uint64_t most_at_once() const override { return 3; }
    void advance(std::uint64_t count) override {
        if (sleep_per_sample_s > 0) {
            std::this_thread::sleep_for(
                std::chrono::duration<double>(sleep_per_sample_s * static_cast<double>(count)));
        }
        if (samples_ + count >= cancelled_at) {
            if (flag) *flag = true;
            throw Cancelled("by the monitor");
        }
        counts.push_back(count);
        samples_ += count;
    }
    double attained_error() const override {
        ++looks;
        return 1 / std::sqrt(static_cast<double>(samples_));
    }
    void show() override { ++shown; }

    std::uint64_t least = 1;
    double sleep_per_sample_s = 0;
    /// The monitor ends the work before so many samples: by an interruption where there is a flag, else by
    /// the time limit.
    std::uint64_t cancelled_at = ~std::uint64_t{0};
    std::atomic<bool>* flag = nullptr;
    std::vector<std::uint64_t> counts;
    mutable int looks = 0;
    int shown = 0;

  private:
    std::uint64_t samples_ = 0;
};

class Recorder final : public ProgressSink {
  public:
    void report(const Progress& progress) override { reports.push_back(progress); }
    std::vector<Progress> reports;
};

struct Trial {
    RunOptions options;
    MadeUpWork work;
    Recorder recorder;
    std::atomic<bool> interrupt = false;
    Clock clock;

    Schedule::Ending end() { return Schedule(options, clock, &recorder, &interrupt).run(work); }
};

TEST(Schedule, DoesThePathsAskedForInPiecesThatEndAtLooks) {
    Trial run;
    run.options.paths = 21;
    const Schedule::Ending ending = run.end();
    EXPECT_EQ(ending.reason, StopReason::paths_done);
    EXPECT_EQ(run.work.counts, (std::vector<std::uint64_t>{3, 1, 3, 1, 3}));  // looks at 4, 8 and 11
    EXPECT_EQ(run.work.looks, 3);
    EXPECT_DOUBLE_EQ(ending.attained_error, 1 / std::sqrt(11.));
    EXPECT_EQ(run.work.shown, 5);
}

TEST(Schedule, StopsAtTheErrorAskedForAtALook) {
    Trial run;
    run.options.error = 0.26;  // reached after 15 samples: seen at 16
    const Schedule::Ending ending = run.end();
    EXPECT_EQ(ending.reason, StopReason::target_reached);
    EXPECT_EQ(run.work.samples(), 16U);
    EXPECT_EQ(ending.attained_error, 0.25);
}

TEST(Schedule, StopsWhereThereCannotBeMore) {
    Trial run;
    run.options.error = 1e-6;
    EXPECT_EQ(run.end().reason, StopReason::paths_done);
    EXPECT_EQ(run.work.samples(), run.work.most_samples());
}

TEST(Schedule, BeginsTheFirstPieceEvenWhereItMayTakeTooLong) {
    Trial run;
    run.options.time_s = 1e-9;
    run.work.least = 2;
    const Schedule::Ending ending = run.end();
    EXPECT_EQ(ending.reason, StopReason::time_over);
    EXPECT_EQ(run.work.samples(), 3U);  // the first piece
    EXPECT_DOUBLE_EQ(ending.attained_error, 1 / std::sqrt(3.));
}

/// It foresees how long the next piece takes, and does not begin it.
TEST(Schedule, EndsBeforeTheTimeRatherThanAfter) {
    Trial run;
    run.options.time_s = 0.5;
    run.work.sleep_per_sample_s = 0.02;
    EXPECT_EQ(run.end().reason, StopReason::time_over);
    EXPECT_GE(run.work.samples(), 1U);
    EXPECT_LE(run.work.samples(), 25U);
}

/// The message of the exception that ends a run without a result.
std::string message_of(Trial& run) {
    try {
        run.end();
    } catch (const Cancelled& cancelled) {
        return cancelled.what();
    }
    return "";
}

TEST(Schedule, SaysWhereThereIsNoResultYet) {
    Trial interrupted;
    interrupted.interrupt = true;
    EXPECT_TRUE(message_of(interrupted).starts_with("interrupted after")) << message_of(interrupted);
    EXPECT_EQ(interrupted.work.samples(), 0U);

    Trial late;
    late.work.least = 4;
    late.work.cancelled_at = 4;
    const std::string message = message_of(late);
    EXPECT_TRUE(message.starts_with("time limit reached after")) << message;
    EXPECT_NE(message.find("no result yet"), std::string::npos) << message;
    EXPECT_EQ(late.work.samples(), 3U);
}

TEST(Schedule, KeepsTheTimeInTheMiddleOfAPiece) {
    Trial run;
    run.work.cancelled_at = 8;
    EXPECT_EQ(run.end().reason, StopReason::time_over);
    EXPECT_EQ(run.work.samples(), 7U);
}

TEST(Schedule, EndsInTheMiddleOfAPieceThatIsInterrupted) {
    Trial run;
    run.work.flag = &run.interrupt;
    run.work.cancelled_at = 8;
    const Schedule::Ending ending = run.end();
    EXPECT_EQ(ending.reason, StopReason::interrupted);
    EXPECT_EQ(run.work.samples(), 7U);
    EXPECT_DOUBLE_EQ(ending.attained_error, 1 / std::sqrt(7.));
}

TEST(Schedule, ReportsTheErrorOfTheLastLook) {
    Trial run;
    run.options.paths = 16;
    run.end();
    ASSERT_EQ(run.recorder.reports.size(), 4U);  // after 3, 4, 7 and 8 samples
    EXPECT_TRUE(std::isinf(run.recorder.reports[0].attained_error));
    EXPECT_EQ(run.recorder.reports[1].attained_error, 0.5);
    EXPECT_EQ(run.recorder.reports[2].attained_error, 0.5);
    EXPECT_EQ(run.recorder.reports[2].samples, 14U);
    EXPECT_EQ(run.recorder.reports[3].remaining_s, 0);
}

TEST(RemainingTime, IsThatOfTheFirstTarget) {
    RunOptions options;
    EXPECT_TRUE(std::isinf(remaining_time_s(options, 2, 0.1, 0.5)));
    options.error = 0.05;
    EXPECT_NEAR(remaining_time_s(options, 2, 0.1, 0.5), 6, 1e-9);  // four times the samples
    options.paths = 100;
    EXPECT_NEAR(remaining_time_s(options, 2, 0.1, 0.5), 2, 1e-9);
    options.time_s = 3;
    EXPECT_NEAR(remaining_time_s(options, 2, 0.1, 0.5), 1, 1e-9);
}

}  // namespace
}  // namespace stilb::run
