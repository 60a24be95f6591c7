#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "cli/progress.h"

namespace stilb::cli {
namespace {

using namespace std::chrono_literals;

TEST(LoadingProgress, IsShownFromOneSecondOn) {
    testing::internal::CaptureStderr();
    {
        const LoadingProgress progress(ShowProgress::everywhere);
        progress.monitor().report("reading room.obj", 0.25);
        std::this_thread::sleep_for(1200ms);
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "1.0 s  reading room.obj, 25 %\n");
}

TEST(LoadingProgress, IsNotShownBefore) {
    testing::internal::CaptureStderr();
    {
        const LoadingProgress progress(ShowProgress::everywhere);
        progress.monitor().report("reading room.obj", 0.25);
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(LoadingProgress, IsNeverShownWhereItIsNotWanted) {
    testing::internal::CaptureStderr();
    {
        const LoadingProgress progress(ShowProgress::never);
        progress.monitor().report("reading room.obj", 0.25);
        std::this_thread::sleep_for(1100ms);
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace stilb::cli
