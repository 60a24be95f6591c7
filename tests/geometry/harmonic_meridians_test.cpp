#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geometry/harmonics/surface.h"
#include "support/harmonic_shapes.h"

namespace stilb::geometry {
namespace {

TEST(HarmonicMeridians, HaveTheSeriesValues) {
    for (const int degree : {0, 1, 2, 9, 40}) {
        const HarmonicSurface surface = rough_surface(degree, 4);
        for (std::size_t i = 0; i < 3; ++i) {
            const MeridianSeries series(surface.radius(), i);
            const std::vector<double> s{-3, -1, -0.3, 0, 1e-9, 0.2, 0.7, 1, 20};
            std::vector<double> values(s.size());
            for (const double t : {-1., -0.4, 0., 1e-12, 0.6, 1.}) {
                for (const double z : {-1., 0.5, 1.}) {
                    series.evaluate(s, t, z, values);
                    for (std::size_t n = 0; n < s.size(); ++n) {
                        std::array<double, 3> x{};
                        x[i] = s[n], x[(i + 1) % 3] = t, x[(i + 2) % 3] = z;
                        const double expected = surface.radius().at(normalized({x[0], x[1], x[2]}));
                        EXPECT_NEAR(values[n], expected, 1e-12) << degree << ' ' << i << ' ' << s[n];
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace stilb::geometry
