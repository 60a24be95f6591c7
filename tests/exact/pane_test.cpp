#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "exact/closed_rooms.h"
#include "materials/thin_dielectric.h"

namespace stilb::exact {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(ThinDielectric, LetsThroughWhatTextbooksSay) {
    // Clear glass of index n along the normal: 2 n / (n^2 + 1), all reflections counted.
    EXPECT_NEAR(pane_transmittance({1.5, 1}, 0), 3 / 3.25, 1e-14);
    EXPECT_NEAR(pane_transmittance({1.52, 0.96}, 0), 0.8815, 5e-5);
    EXPECT_NEAR(pane_transmittance({1.52, 0.96}, 60 * kDegree), 0.8015, 5e-5);
    EXPECT_EQ(pane_transmittance({1.52, 0}, 0.3), 0);
}

TEST(ThinDielectric, LosesOnlyTheLightPolarisedAcrossAtBrewstersAngle) {
    const double n = 1.6, face = std::pow((n * n - 1) / (n * n + 1), 2);
    EXPECT_NEAR(pane_transmittance({n, 1}, std::atan(n)), (1 + (1 - face) / (1 + face)) / 2, 1e-13);
}

TEST(ThinDielectric, IsSmoothAtTheNormalAndDarkAlongTheSurface) {
    EXPECT_NEAR(pane_transmittance({1.52, 0.9}, 0.99e-8), pane_transmittance({1.52, 0.9}, 1.01e-8), 1e-12);
    EXPECT_LT(pane_transmittance({1.52, 1}, 89.999 * kDegree), 1e-3);
}

TEST(ThinDielectric, RefusesArgumentsOutsideItsDomain) {
    EXPECT_THROW(pane_transmittance({1, 1}, 0), std::domain_error);
    EXPECT_THROW(pane_transmittance({1.5, 1.1}, 0), std::domain_error);
    EXPECT_THROW(pane_transmittance({1.5, 1}, 90 * kDegree), std::domain_error);
    EXPECT_THROW(pane_transmittance({1.5, 1}, -0.1), std::domain_error);
}

}  // namespace
}  // namespace stilb::exact
