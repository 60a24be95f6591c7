#include <gtest/gtest.h>

#include "lights/luminaire.h"

namespace stilb::lights {
namespace {

void expect_near(const Vec3& actual, const Vec3& expected) {
    EXPECT_LT(length(actual - expected), 1e-12) << actual.x << ' ' << actual.y << ' ' << actual.z;
}

TEST(LuminaireFrame, HangsWithC0AlongX) {
    const LuminaireFrame frame = aim_luminaire({0, 0, -1}, 0);
    expect_near(frame.c0, {1, 0, 0});
    expect_near(frame.c90, {0, 1, 0});
    expect_near(frame.nadir, {0, 0, -1});
}

TEST(LuminaireFrame, SpinsCounterclockwiseSeenFromBehind) {
    const LuminaireFrame down = aim_luminaire({0, 0, -1}, 90);
    expect_near(down.c0, {0, 1, 0});
    expect_near(down.c90, {-1, 0, 0});
    // Aimed along +y and seen from behind, x is to the right and z up: C0 turns from right to up.
    const LuminaireFrame level = aim_luminaire({0, 1, 0}, 90);
    expect_near(level.c0, {0, 0, 1});
    expect_near(level.c90, {-1, 0, 0});
}

TEST(LuminaireFrame, TurnsTheShortestWay) {
    // From -z to +x is a quarter turn about y, which takes x to z and leaves y.
    const LuminaireFrame to_x = aim_luminaire({1, 0, 0}, 0);
    expect_near(to_x.c0, {0, 0, 1});
    expect_near(to_x.c90, {0, 1, 0});
    const LuminaireFrame to_y = aim_luminaire({0, 1, 0}, 0);
    expect_near(to_y.c0, {1, 0, 0});
    expect_near(to_y.c90, {0, 0, 1});
}

TEST(LuminaireFrame, StaysOrthonormalAndLeftHanded) {
    const Vec3 aims[] = {{1, 2, 3}, {-1, 0.5, -4}, {0, 0, 1}, {1e-9, 2e-9, 1}, {-1e-17, 0, 1}, {1e-9, 0, -1}};
    for (const Vec3& aim : aims) {
        const LuminaireFrame f = aim_luminaire(normalized(aim), 30);
        EXPECT_NEAR(length(f.c0), 1, 1e-12);
        EXPECT_NEAR(length(f.c90), 1, 1e-12);
        EXPECT_NEAR(dot(f.c0, f.c90), 0, 1e-12);
        expect_near(cross(f.c0, f.c90), -f.nadir);
    }
}

TEST(LuminaireFrame, PointsUpByAHalfTurnAboutX) {
    const LuminaireFrame up = aim_luminaire({0, 0, 1}, 0);
    expect_near(up.c0, {1, 0, 0});
    expect_near(up.c90, {0, -1, 0});
}

}  // namespace
}  // namespace stilb::lights
