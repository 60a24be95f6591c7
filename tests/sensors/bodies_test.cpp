// Small bodies: their sensitivities are means over their surfaces, directions are drawn in proportion, and
// those on a surface start on its right side.
#include "sensors/bodies.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "rays/ray_caster.h"
#include "sensors/place.h"
#include "support/quadrature.h"
#include "support/scene_builder.h"

namespace stilb::sensors {
namespace {

constexpr Vec3 kUp{0, 0, 1};

Vec3 spherical(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

template <typename Function>
double integral_over_sphere(const Function& f) {
    return integrate(0, kPi, 64, [&](double theta) {
        return std::sin(theta) *
               integrate(0, 2 * kPi, 64, [&](double phi) { return f(spherical(theta, phi)); });
    });
}

BodyPoint body_of(const Measurand& measurand) { return std::get<BodyPoint>(measurand); }

/// s of a direction in the world.
double sensitivity(const BodyPoint& body, const Vec3& direction) {
    return body.sensitivity->of(Frame::of_surface(body.axis).to_local(direction));
}

const Vec3 kFacing = normalized(Vec3{1, -2, 0});
const Vec3 kTilted = normalized(Vec3{1, -2, 3});

std::array<BodyPoint, 4> bodies() {
    const std::vector<Vec3> at{{1, 2, 3}};
    return {body_of(Cylindrical{at}.measurand(0)), body_of(Semicylindrical{at, kFacing}.measurand(0)),
            body_of(Hemispherical{at, kTilted}.measurand(0)), body_of(Spherical{at}.measurand(0))};
}

/// The mean of cos+ over the normals of the body's surface: what the derivation starts from.
double mean_cosine(std::size_t body, const Vec3& direction) {
    const auto cosine = [&](const Vec3& normal) { return std::max(0.0, dot(normal, direction)); };
    const double facing = std::atan2(kFacing.y, kFacing.x);
    constexpr int parts = 512;  // cos+ has a kink
    if (body < 2) {
        const double half = body == 0 ? kPi : kPi / 2;
        return integrate(facing - half, facing + half, parts,
                         [&](double phi) {
                             return cosine({std::cos(phi), std::sin(phi), 0});
                         }) /
               (2 * half);
    }
    const Frame frame = Frame::around(kTilted);
    const double end = body == 2 ? kPi / 2 : kPi;
    const double sum = integrate(0, end, parts / 4, [&](double theta) {
        return std::sin(theta) * integrate(0, 2 * kPi, parts / 4, [&](double phi) {
                   return cosine(frame.to_world(spherical(theta, phi)));
               });
    });
    return sum / (2 * kPi * (1 - std::cos(end)));
}

TEST(Bodies, AreSensitiveAsTheMeanOverTheirSurface) {
    for (std::size_t b = 0; b < 4; ++b) {
        for (const Vec3& direction :
             {kUp, -kUp, kFacing, -kFacing, kTilted, -kTilted, spherical(0.7, 2), spherical(2.1, 4.4)}) {
            EXPECT_NEAR(sensitivity(bodies()[b], direction), mean_cosine(b, direction), 2e-5)
                << "body " << b << ", direction " << direction.x << " " << direction.y << " " << direction.z;
        }
    }
}

TEST(Bodies, ReadPiTimesAUniformLuminance) {
    for (const BodyPoint& body : bodies()) {
        EXPECT_NEAR(integral_over_sphere([&](const Vec3& d) { return body.sensitivity->of(d); }), kPi, 1e-5);
    }
}

TEST(Bodies, DrawDirectionsInProportionToTheirSensitivity) {
    // Functions of the direction that tell apart any two of the densities, and the axes of each.
    const std::array<double (*)(const Vec3&), 6> functions{
        [](const Vec3& d) { return d.x; },       [](const Vec3& d) { return d.y; },
        [](const Vec3& d) { return d.z; },       [](const Vec3& d) { return d.x * d.x - d.y * d.z; },
        [](const Vec3& d) { return d.z * d.z; }, [](const Vec3& d) { return std::exp(d.x + 2 * d.y - d.z); }};
    constexpr int n = 1000;
    const double tolerance = std::pow(n, -4. / 3);  // of midpoints where directions go by cube roots
    for (const BodyPoint& body : bodies()) {
        std::array<double, functions.size()> means{};
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const Vec3 d = body.sensitivity->sample((i + 0.5) / n, (j + 0.5) / n);
                ASSERT_NEAR(length(d), 1, 1e-14);
                ASSERT_GT(body.sensitivity->of(d), 0);
                for (std::size_t f = 0; f < functions.size(); ++f) means[f] += functions[f](d) / (n * n);
            }
        }
        for (std::size_t f = 0; f < functions.size(); ++f) {
            const double expected = integral_over_sphere(
                [&](const Vec3& d) { return functions[f](d) * body.sensitivity->of(d) / kPi; });
            EXPECT_NEAR(means[f], expected, tolerance) << f;
        }
    }
}

TEST(Bodies, DrawUnitDirectionsAtTheEndsToo) {
    constexpr double last = 0x1.fffffffffffffp-1;
    for (const BodyPoint& body : bodies()) {
        for (const double u1 : {0.0, 1e-300, 1e-16, 0.5, last}) {
            for (const double u2 : {0.0, 1e-300, 0.5, last}) {
                EXPECT_NEAR(length(body.sensitivity->sample(u1, u2)), 1, 1e-14) << u1 << " " << u2;
            }
        }
    }
}

TEST(Semicylindrical, FacesAHorizontalDirection) {
    Semicylindrical level{{{0, 0, 0}}, normalized(Vec3{3, 4, 1e-9})};
    EXPECT_FALSE(level.settle(GivenKeys({})));
    EXPECT_EQ(level.direction, (Vec3{0.6, 0.8, 0}));
    Semicylindrical tilted{{{0, 0, 0}}, normalized(Vec3{3, 4, 0.1})};
    const auto fault = tilted.settle(GivenKeys({}));
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->key, "direction");
}

/// A room with a floor whose front looks down.
Scene room() {
    Scene scene;
    add_object(scene, Rectangle{{0, 0, 0}, {0, 4, 0}, {4, 0, 0}}, diffuse(0.5));
    add_object(scene, Rectangle{{0, 0, 0}, {0, 4, 0}, {0, 0, 3}}, diffuse(0.5));  // front to +x
    add_object(scene, Rectangle{{4, 0, 0}, {0, 4, 0}, {0, 0, 3}}, diffuse(0.5));  // front to +x: outside
    return scene;
}

TEST(Bodies, StandFree) {
    const Scene scene = room();
    const rays::RayCaster caster(scene);
    for (const BodyPoint& body : bodies()) {
        EXPECT_FALSE(place_of(body, caster).surface);
        EXPECT_EQ(place_of(body, caster).lifted, body.position);
    }
}

TEST(Bodies, OnASurfaceAreWhereTheirAxisPoints) {
    const Scene scene = room();
    const rays::RayCaster caster(scene);
    const auto height = [&](const Measurand& body) { return place_of(body_of(body), caster).lifted.z; };
    const std::vector<Vec3> on_floor{{1, 2, 0}};
    EXPECT_GT(height(Cylindrical{on_floor}.measurand(0)), 0);
    EXPECT_GT(height(Spherical{on_floor}.measurand(0)), 0);
    EXPECT_GT(height(Hemispherical{on_floor, kTilted}.measurand(0)), 0);
    EXPECT_LT(height(Hemispherical{on_floor, -kTilted}.measurand(0)), 0);
    // Semicylinders point along the floor: the side is its front's.
    EXPECT_LT(height(Semicylindrical{on_floor, kFacing}.measurand(0)), 0);
    EXPECT_LT(std::abs(height(Cylindrical{on_floor}.measurand(0))), 1e-4);
}

TEST(Bodies, WithAnAxisInTheSurfaceAreOnItsFront) {
    const Scene scene = room();
    const rays::RayCaster caster(scene);
    for (const double x : {0.0, 4.0}) {
        const BodyPoint body = body_of(Cylindrical{{{x, 2, 1.5}}}.measurand(0));
        ASSERT_TRUE(place_of(body, caster).surface) << x;
        EXPECT_EQ(place_of(body, caster).surface->normal, (Vec3{1, 0, 0})) << x;
        EXPECT_GT(place_of(body, caster).lifted.x, x);
    }
}

}  // namespace
}  // namespace stilb::sensors
