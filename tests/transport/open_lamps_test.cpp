#include "transport/direct/open_lamps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace stilb::transport {
namespace {

/// Each lamp is taken once on average, whatever its light: by all of them or by some.
TEST(OpenLamps, StandForAll) {
    for (const std::size_t count : {1, 31, 32, 33, 64, 1000}) {
        OpenLamps lamps;
        for (std::size_t i = 0; i < count; ++i)
            lamps.add(i, i % 9 == 0 ? 1e6 : 1e-6 * (1. + static_cast<double>(i % 5)));
        lamps.finish();
        ASSERT_EQ(lamps.choices(), std::min<std::size_t>(count, OpenLamps::kChosen));
        constexpr int firsts = 20'000;
        std::vector<double> times(count);
        for (int f = 0; f < firsts; ++f) {
            for (std::size_t i = 0; i < lamps.choices(); ++i) {
                const auto [lamp, factor] = lamps.choose(i, (f + 0.5) / firsts);
                times[lamp] += factor / firsts;
            }
        }
        for (std::size_t i = 0; i < count; ++i) EXPECT_NEAR(times[i], 1, 0.02) << i << " of " << count;
    }
}

}  // namespace
}  // namespace stilb::transport
