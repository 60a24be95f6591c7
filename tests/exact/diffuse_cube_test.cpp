#include "exact/diffuse_cube.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "exact/quadrature.h"

namespace stilb::exact {
namespace {

using test::integrate;

/// The absorbed light is the source's: an integral over one face, by symmetry a sixth of all.
TEST(DiffuseCube, AbsorbsTheFluxOfTheSource) {
    const DiffuseCube cube(4, 10000);
    const auto mean_lx = [&](const auto& illuminance_lx) {
        const auto along = [&](double x_m) {
            return integrate([&](double y_m) { return illuminance_lx(x_m, y_m); }, 0, 2, {}, 1);
        };
        return integrate(along, 0, 2, {}, 1) / 4;
    };
    for (const double reflectance : {0.0, 0.7}) {
        const auto illuminance_lx = [&](double x_m, double y_m) {
            const double direct_lx = cube.direct_illuminance_lx(x_m, y_m);
            return reflectance > 0 ? direct_lx + cube.indirect_illuminance_lx(reflectance, x_m, y_m)
                                   : direct_lx;
        };
        const double exact_lx = cube.mean_illuminance_lx(reflectance);
        EXPECT_NEAR(mean_lx(illuminance_lx), exact_lx, (reflectance > 0 ? 2e-4 : 1e-9) * exact_lx);
    }
}

/// After the first reflection the middle of a face has light of a known integral.
TEST(DiffuseCube, FirstReflectionIsTheIntegralOverTheFaces) {
    const DiffuseCube cube(2, 100);
    const double small = 1e-6;
    // From the middle of the floor: the ceiling, and four walls alike.
    const auto on_face = [&](const auto& value) {
        return integrate(
            [&](double x) { return integrate([&](double y) { return value(x, y); }, -1, 1, {}, 4); }, -1, 1,
            {}, 4);
    };
    const double ceiling = on_face([&](double x, double y) {
        const double squared = x * x + y * y + 4;
        return cube.direct_illuminance_lx(x, y) * 4 / (kPi * squared * squared);
    });
    const double wall = on_face([&](double x, double z) {  // at 1 m; z from its middle
        const double squared = 1 + x * x + (z + 1) * (z + 1);
        return cube.direct_illuminance_lx(x, z) * (z + 1) / (kPi * squared * squared);
    });
    EXPECT_NEAR(cube.indirect_illuminance_lx(small, 0, 0) / small, ceiling + 4 * wall,
                2e-4 * (ceiling + 4 * wall));
}

/// Values of uniform rasters of 8 to 64 cells, computed by another program and extrapolated (the last change
/// is below 1e-4): floor of a cube of 4 m, 10 klm.
TEST(DiffuseCube, AgreesWithFinerRasters) {
    const DiffuseCube cube(4, 10000);
    struct Known {
        double reflectance, x_m, y_m, lx;
    };
    for (const auto& [reflectance, x_m, y_m, lx] :
         {Known{0.2, 0, 0, 28.877}, Known{0.2, 1, 1, 27.302}, Known{0.2, 1.5, 1.5, 23.452},
          Known{0.5, 0, 0, 112.04}, Known{0.5, 1, 1, 107.785}, Known{0.8, 0, 0, 430.96},
          Known{0.8, -1, 1, 423.50}, Known{0.8, 1.5, -1.5, 403.10}, Known{0.8, 0, 1.9, 412.48}}) {
        EXPECT_NEAR(cube.indirect_illuminance_lx(reflectance, x_m, y_m), lx, 2e-4 * lx)
            << reflectance << " " << x_m << " " << y_m;
    }
}

TEST(DiffuseCube, RefusesWhatHasNoSolution) {
    EXPECT_THROW(DiffuseCube(0, 1), std::domain_error);
    EXPECT_THROW(DiffuseCube(1, -1), std::domain_error);
    const DiffuseCube cube(1, 1);
    EXPECT_THROW(cube.indirect_illuminance_lx(1, 0, 0), std::domain_error);
    EXPECT_THROW(cube.indirect_illuminance_lx(0.5, 0.6, 0), std::domain_error);
    EXPECT_THROW(cube.mean_illuminance_lx(-0.1), std::domain_error);
}

}  // namespace
}  // namespace stilb::exact
