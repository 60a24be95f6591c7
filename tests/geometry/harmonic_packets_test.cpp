// What single precision tells of rays and cells, against double precision.
#include <gtest/gtest.h>

#include <limits>

#include "rays/embree_geometry.h"
#include "support/harmonic_shapes.h"

namespace stilb::geometry {
namespace {

Harmonics body_at(const Vec3& center, double scale) {
    Harmonics body(strong_surface(12, 1, 0.4, 3));
    body.center = center;
    body.scale = scale;
    body.axes = Frame::around(normalized(Vec3{1, -2, 3}));
    return body;
}

/// Sixteen rays through a box, of which some end and some start in it.
RayPacket rays_through(const Bounds& box, double away, Numbers& numbers) {
    const Vec3 extent = box.max - box.min;
    RayPacket rays;
    for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
        const Vec3 at =
            box.min + Vec3{numbers.next() * extent.x, numbers.next() * extent.y, numbers.next() * extent.z};
        const Vec3 direction = numbers.direction(), origin = at - away * direction;
        const double where = numbers.next();
        rays.set(lane, origin, direction,
                 where > 0.8 ? static_cast<float>(away) : std::numeric_limits<float>::infinity());
        rays.start[lane] = where < 0.2 ? static_cast<float>(away) : 0;
    }
    return rays;
}

rays::RayInterval interval_of(const RayPacket& rays, std::size_t lane) {
    return {{rays.origin_x[lane], rays.origin_y[lane], rays.origin_z[lane]},
            {rays.direction_x[lane], rays.direction_y[lane], rays.direction_z[lane]},
            rays.start[lane],
            rays.end[lane]};
}

bool is_met_anywhere(const rays::CurvedSurface& surface, const rays::RayInterval& ray) {
    for (std::size_t part = 0; part < surface.part_count(); ++part) {
        if (surface.intersect(part, ray) < kInfinity) return true;
    }
    return false;
}

struct Told {
    int missed = 0, met = 0, unclear = 0;
};

/// Expects what is told to be true.
Told told_of(const Harmonics& body, double away, int packets) {
    const auto surface = rays::curved_surface(body, {});
    Numbers numbers(4);
    Told told;
    for (int n = 0; n < packets; ++n) {
        const auto part =
            static_cast<std::size_t>(numbers.next() * static_cast<double>(surface->part_count()));
        const RayPacket rays = rays_through(surface->bounds_of(part), away, numbers);
        const LaneClassifications classifications = surface->classifications(part, rays);
        for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
            const rays::RayInterval ray = interval_of(rays, lane);
            const bool is_met = surface->intersect(part, ray) < kInfinity;
            if (classifications[lane] == Classification::misses) {
                ++told.missed;
                EXPECT_FALSE(is_met) << n << ' ' << lane;
            } else if (classifications[lane] == Classification::meets) {
                ++told.met;
                EXPECT_TRUE(is_met || is_met_anywhere(*surface, ray)) << n << ' ' << lane;
            } else {
                ++told.unclear;
            }
        }
    }
    return told;
}

TEST(HarmonicClassifications, AreTrueAndMostlyThere) {
    constexpr int packets = 6000;
    for (const double away : {0.0, 3.0, 20.0}) {
        const Told told = told_of(body_at({}, 1), away, packets);
        EXPECT_GT(told.missed, 8 * packets) << away;
        EXPECT_GT(told.met, packets / 2) << away;
        EXPECT_LT(told.unclear, 3 * packets) << away;
    }
}

TEST(HarmonicClassifications, AreTrueOfSmallBodiesFarAway) {
    constexpr int packets = 4000;
    EXPECT_GT(told_of(body_at({4, -7, 30}, 0.3), 1, packets).missed, 8 * packets);
    const Told told = told_of(body_at({400, -7000, 30}, 0.05), 100, packets);
    EXPECT_EQ(told.met, 0);
    EXPECT_GT(told.unclear, 0);
}

}  // namespace
}  // namespace stilb::geometry
