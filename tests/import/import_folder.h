// Folders of tests that write files, and comparisons of what scenes measure.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "io/scene/scene_file.h"
#include "io/text/table.h"
#include "run/run.h"
#include "support/test_folder.h"

namespace stilb::io {

/// A folder that ends with the test.
class ImportFolderTest : public testing::Test {
  protected:
    std::filesystem::path write(const std::string& name, const std::string& content) const {
        return folder.write(name, content);
    }

    const TestFolder folder;
};

inline std::vector<run::Reading> readings_of(const SceneFile& file, std::uint64_t seed = 1) {
    RunOptions options;
    options.paths = 8192;
    options.seed = seed;
    options.threads = 1;
    return run::measure(file.scene, file.sensors, options).sensors.at(0).readings;
}

/// The same light within the intervals of both.
inline void expect_same_light(const SceneFile& a, const SceneFile& b) {
    const auto of_a = readings_of(a, 1), of_b = readings_of(b, 2);
    ASSERT_EQ(of_a.size(), of_b.size());
    for (std::size_t i = 0; i < of_a.size(); ++i) {
        const auto &x = of_a[i].estimate, &y = of_b[i].estimate;
        const double error = std::hypot(x.upper - x.lower, y.upper - y.lower);
        EXPECT_NEAR(x.value, y.value, error);
        EXPECT_LT(error, 0.05 * x.value);
    }
}

/// The same digits, but for rounding.
inline void expect_same_readings(const SceneFile& a, const SceneFile& b) {
    const auto of_a = readings_of(a), of_b = readings_of(b);
    ASSERT_EQ(of_a.size(), of_b.size());
    for (std::size_t i = 0; i < of_a.size(); ++i)
        EXPECT_NEAR(of_a[i].estimate.value, of_b[i].estimate.value, 1e-6 * of_a[i].estimate.value);
}

}  // namespace stilb::io
