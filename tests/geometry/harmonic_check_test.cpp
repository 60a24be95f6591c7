// A small part of verify_harmonics (tests/long).
#include "support/harmonic_check.h"

#include <gtest/gtest.h>

namespace stilb::geometry {
namespace {

struct Shape {
    int degree;
    double falloff, ratio;
};

TEST(HarmonicCheck, RootsAndCellsMissNoRay) {
    constexpr std::uint64_t rays = 700;
    std::uint64_t seed = 1, missed_by_march = 0;
    for (const Shape& shape : {Shape{2, 0, 0.2}, {8, 0, 0.3}, {16, 2, 0.1}, {24, 2.5, 0.3}, {20, 0, 0.6}}) {
        const CheckedSurface surface(strong_surface(shape.degree, shape.falloff, shape.ratio,
                                                    static_cast<std::uint64_t>(shape.degree)));
        for (const RayKind kind : kRayKinds) {
            const Tallies found = surface.check(kind, rays, 4, ++seed);
            EXPECT_EQ(found.roots.missed, 0) << shape.degree << ' ' << name_of(kind);
            EXPECT_EQ(found.cells.missed, 0) << shape.degree << ' ' << name_of(kind);
            EXPECT_EQ(found.roots.wrong, 0) << shape.degree << ' ' << name_of(kind);
            EXPECT_EQ(found.cells.wrong, 0) << shape.degree << ' ' << name_of(kind);
            EXPECT_EQ(found.march.wrong, 0) << shape.degree << ' ' << name_of(kind);
            EXPECT_GT(found.roots.hits, rays / 3) << shape.degree << ' ' << name_of(kind);
            EXPECT_EQ(found.classifications.wrong, 0) << shape.degree << ' ' << name_of(kind);
            EXPECT_GT(found.classifications.told, rays) << shape.degree << ' ' << name_of(kind);
            missed_by_march += found.march.missed;
        }
    }
    EXPECT_GT(missed_by_march, 0);
}

}  // namespace
}  // namespace stilb::geometry
