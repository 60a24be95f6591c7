#include "report/plan_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/scene_builder.h"

namespace stilb::report {
namespace {

constexpr double kLeast_m = 0.06;  // pieces of edges are shorter

/// The length of all lines together.
double total_m(const std::vector<PlanLine>& lines) {
    double sum = 0;
    for (const auto& [from, to] : lines) sum += std::hypot(to.x - from.x, to.y - from.y);
    return sum;
}

/// Those whose ends both lie in a rectangle.
std::vector<PlanLine> within(const std::vector<PlanLine>& lines, double x0, double y0, double x1, double y1) {
    std::vector<PlanLine> found;
    std::ranges::copy_if(lines, std::back_inserter(found), [&](const PlanLine& line) {
        return std::ranges::all_of(line, [&](const PlanPoint& p) {
            return p.x > x0 - 1e-9 && p.x < x1 + 1e-9 && p.y > y0 - 1e-9 && p.y < y1 + 1e-9;
        });
    });
    return found;
}

PlanLines lines_of(const Scene& scene) {
    const rays::RayCaster caster(scene);
    return plan_lines(scene, caster, usual_plan_height(scene::bounds_of(scene)));
}

Scene room() {
    Scene scene;
    add_object(scene, inward({{0, 0, 0}, {5, 4, 3}}), diffuse(0.5));
    return scene;
}

TEST(PlanLines, CutWallsAndSeeTables) {
    Scene scene = room();
    add_object(scene, Box{{1, 1, 0.7}, {2.5, 1.8, 0.75}}, diffuse(0.5));
    const PlanLines lines = lines_of(scene);
    EXPECT_NEAR(lines.height_m, 1.2, 1e-12);
    EXPECT_NEAR(total_m(lines.cut), 2 * (5 + 4), 1e-6);
    // Top and bottom of the table have the same edges from above; the floor's lie under the walls.
    const auto table = within(lines.seen, 1, 1, 2.5, 1.8);
    EXPECT_NEAR(total_m(table), 2 * 2 * (1.5 + 0.8), kLeast_m);
    EXPECT_NEAR(total_m(lines.seen) - total_m(table), 2 * (5 + 4), kLeast_m);
}

TEST(PlanLines, LeaveOutWhatIsHiddenAboveOrTooSmall) {
    Scene scene = room();
    const double bare_m = total_m(lines_of(scene).seen);
    add_object(scene, Rectangle{{1, 1, 0.75}, {2, 0, 0}, {0, 1, 0}}, diffuse(0.5));
    add_object(scene, Box{{1.5, 1.3, 0.0}, {2.0, 1.7, 0.5}}, diffuse(0.5));    // under the table
    add_object(scene, Box{{3.5, 2.5, 1.5}, {4.5, 3.5, 2.0}}, diffuse(0.5));    // above the section
    add_object(scene, Box{{4.0, 1.0, 0.0}, {4.02, 1.02, 0.1}}, diffuse(0.5));  // 2 cm
    add_area_light(scene, Rectangle{{3.2, 0.5, 1.0}, {0, 0.6, 0}, {0.6, 0, 0}}, Rgb::grey(1000));
    EXPECT_NEAR(total_m(lines_of(scene).seen) - bare_m, 2 * (2 + 1), kLeast_m);
    EXPECT_NEAR(total_m(lines_of(scene).cut), 2 * (5 + 4), 1e-6);
}

TEST(PlanLines, HideThePartOfAnEdgeUnderATable) {
    Scene scene = room();
    const double bare_m = total_m(lines_of(scene).seen);
    add_object(scene, Rectangle{{1, 1, 0.75}, {2, 0, 0}, {0, 1, 0}}, diffuse(0.5));
    add_object(scene, Rectangle{{2, 1.25, 0.3}, {2, 0, 0}, {0, 0.5, 0}}, diffuse(0.5));  // half under it
    EXPECT_NEAR(total_m(lines_of(scene).seen) - bare_m, 2 * (2 + 1) + 2 * 1 + 0.5, 3 * kLeast_m);
}

TEST(PlanLines, ShowCurvedBodiesAsCircles) {
    Scene scene = room();
    const PlanLines bare = lines_of(scene);
    add_object(scene, Sphere{{2, 2, 0.5}, 0.3}, diffuse(0.5));
    add_object(scene, Disk{{4, 1, 0.7}, {0, 0, 1}, 0.4}, diffuse(0.5));
    add_object(scene, Sphere{{1, 3, 1.0}, 0.5}, diffuse(0.5));  // cut 0.2 m above its middle
    const PlanLines lines = lines_of(scene);
    EXPECT_NEAR(total_m(within(lines.seen, 1.6, 1.6, 2.4, 2.4)), 2 * kPi * 0.3, 0.03);
    EXPECT_NEAR(total_m(within(lines.seen, 3.5, 0.5, 4.5, 1.5)), 2 * kPi * 0.4, 0.03);
    EXPECT_NEAR(total_m(lines.cut) - total_m(bare.cut), 2 * kPi * std::sqrt(0.25 - 0.04), 0.03);
}

TEST(PlanLines, OutlinesAreConvexHulls) {
    const auto corners = outline_from_above(Box{{1, 2, 3}, {2, 4, 5}});
    ASSERT_EQ(corners.size(), 4u);
    double doubled = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const PlanPoint &a = corners[i], &b = corners[(i + 1) % 4];
        doubled += a.x * b.y - b.x * a.y;
    }
    EXPECT_NEAR(doubled / 2, 2, 1e-12);
}

}  // namespace
}  // namespace stilb::report
