// Rays near the rim of a small hole between large triangles meet them where they are, in scenes of few
// triangles and of many.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "materials/black.h"
#include "rays/few_triangles.h"
#include "rays/ray_caster.h"
#include "scene/fine_things.h"
#include "support/scene_builder.h"

namespace stilb::rays {
namespace {

/// Half the side of the hole and of the wall around it; exact in single precision.
constexpr double kHole_m = 0x1p-11, kWall_m = 4;

/// A wall of four rectangles around a hole in its middle, and small things far from it.
Scene wall_with_hole(int others) {
    Scene scene;
    const auto add = [&](double y, double z, double width, double height) {
        add_object(scene, Rectangle{{0, y, z}, {0, width, 0}, {0, 0, height}}, Black{});
    };
    const double beside = kWall_m - kHole_m;
    add(-kWall_m, -kWall_m, beside, 2 * kWall_m);
    add(kHole_m, -kWall_m, beside, 2 * kWall_m);
    add(-kHole_m, -kWall_m, 2 * kHole_m, beside);
    add(-kHole_m, kHole_m, 2 * kHole_m, beside);
    add_object(scene, Rectangle{{4, -4, -4}, {0, 8, 0}, {0, 0, 8}}, Black{});
    add_object(scene, Rectangle{{-4, -4, -4}, {0, 8, 0}, {0, 0, 8}}, Black{});
    for (int i = 0; i < others; ++i)
        add_object(scene, Rectangle{{3, 0.05 * i, 3}, {0, 0.04, 0}, {0.04, 0, 0}}, Black{});
    return scene;
}

struct GrazingRay {
    Ray ray;
    bool passes;  ///< by the ray that is traced, in single precision
};

/// Towards points within 2 micrometres of the rim.
std::vector<GrazingRay> grazing_rays(const Vec3& origin, const Vec3& center) {
    constexpr int count = 100'000;
    constexpr double near_m = 2e-6;
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> even(-1, 1);
    std::vector<GrazingRay> rays;
    for (int i = 0; i < count; ++i) {
        const double across = (i % 2 == 0 ? 1 : -1) * kHole_m + near_m * even(generator),
                     along = kHole_m * even(generator);
        const Vec3 end = i % 4 < 2 ? Vec3{0, across, along} : Vec3{0, along, across};
        const Vec3 direction = normalized(end - origin);
        RayPacket packet;
        packet.set(0, origin - center, direction, 1);
        const double t = -(packet.origin_x[0] + center.x) / packet.direction_x[0];
        const double y = packet.origin_y[0] + center.y + t * packet.direction_y[0],
                     z = packet.origin_z[0] + center.z + t * packet.direction_z[0];
        rays.push_back({{origin, direction}, std::abs(y) < kHole_m && std::abs(z) < kHole_m});
    }
    return rays;
}

bool is_at_wall(const std::optional<Hit>& hit) { return hit && std::abs(hit->position.x) < 1e-3; }

TEST(GrazedEdges, FirstHitsAreWhereTrianglesAre) {
    const Vec3 origin{1e-3, 0, 0};
    for (const int others : {0, static_cast<int>(FewTriangles::kMost / 2)}) {
        const Scene scene = wall_with_hole(others);
        const RayCaster caster(scene);
        std::vector<Ray> rays;
        const std::vector<GrazingRay> grazing = grazing_rays(origin, caster.center());
        for (const GrazingRay& ray : grazing) rays.push_back(ray.ray);
        for (const Coherence coherence : {Coherence::scattered, Coherence::coherent}) {
            std::vector<std::optional<Hit>> hits(rays.size());
            caster.closest(rays, coherence, hits);
            int wrong = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                wrong += is_at_wall(hits[i]) == grazing[i].passes;
                wrong += is_at_wall(caster.closest(rays[i].origin, rays[i].direction)) == grazing[i].passes;
            }
            EXPECT_EQ(wrong, 0) << others << " others";
        }
    }
}

/// Where the rim is fine beside the scene and near to a measured point, so are shadow rays.
TEST(GrazedEdges, ShadowRaysPassAFineHole) {
    const Vec3 origin{1e-3, 0, 0};
    const std::vector<Vec3> measured{origin};
    for (const int others : {0, static_cast<int>(FewTriangles::kMost / 2)}) {
        const Scene scene = wall_with_hole(others);
        ASSERT_TRUE(scene::sees_fine_things(scene, measured));
        const RayCaster caster(scene, Monitor::none(), measured);
        std::vector<Segment> segments;
        const std::vector<GrazingRay> grazing = grazing_rays(origin, caster.center());
        // The segment of a packet is its direction, which is rounded: to a length of 1, as that of the rays.
        for (const GrazingRay& ray : grazing)
            segments.push_back({ray.ray.origin, ray.ray.origin + ray.ray.direction});
        std::vector<Rgb> transmittances(segments.size());
        caster.transmittances(segments, Coherence::coherent, transmittances);
        int wrong = 0;
        for (std::size_t i = 0; i < segments.size(); ++i) {
            wrong += (transmittances[i].max() > 0) != grazing[i].passes;
            wrong += caster.occluded(segments[i].from, segments[i].to) == grazing[i].passes;
        }
        // By the rounding of directions, which is not that of the rays for which `passes` is found.
        EXPECT_LT(wrong, 100) << others << " others";
    }
}

}  // namespace
}  // namespace stilb::rays
