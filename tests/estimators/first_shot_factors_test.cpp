// What light samples shoot: all of their light arrives, each patch gets its own, and shadows stay dark.
#include <gtest/gtest.h>

#include <cmath>

#include "estimators/first_shot_rooms.h"
#include "estimators/patch_light/first_shot/factors.h"
#include "exact/configuration_factors.h"
#include "stilb/error.h"

namespace stilb::estimators {
namespace {

/// Intensity (1 + cos gamma)^2, of a luminaire turned in no particular way.
PhotometricSolid downlight() {
    PhotometricSolid::Grid grid{.planes_deg = {0}, .polar_deg = {}, .intensity_cd = {}};
    for (int gamma = 0; gamma <= 180; gamma += 5) {
        grid.polar_deg.push_back(gamma);
        grid.intensity_cd.push_back(100 * std::pow(1 + std::cos(gamma * kPi / 180), 2));
    }
    return PhotometricSolid(grid);
}

/// Every kind of light that is replaced, flush with a ceiling, in a corner, free and round.
Scene room_of_lights() {
    Scene scene;
    add_object(scene, inward({{0, 0, 0}, {5, 4, 3}}), diffuse(0.5));
    add_object(scene, Box{{0.5, 0.4, 0}, {1.4, 1.1, 1.2}}, diffuse(0.5));
    add_object(scene, Rectangle{{2, 1.5, 0.75}, {1.6, 0, 0}, {0, 0.8, 0}}, diffuse(0.5));
    add_point_light(scene, {2.3, 1.9, 1.6}, {{100, 80, 30}});
    add_luminaire(scene, {1, 3, 2.5}, downlight(), normalized(Vec3{0.2, -0.3, -1}), 30, {{1, 0.9, 0.7}});
    add_area_light(scene, Rectangle{{2, 1, 3}, {0, 0.6, 0}, {0.6, 0, 0}}, {{1000, 900, 500}});
    add_area_light(scene, Rectangle{{5, 4, 2.2}, {0, -0.5, 0}, {0, 0, 0.4}}, Rgb::grey(800));
    add_area_light(scene, Box{{2, 3, 1.5}, {2.2, 3.3, 1.6}}, Rgb::grey(500));
    add_area_light(scene, Sphere{{3.2, 3, 2}, 0.1}, Rgb::grey(3000));
    add_area_light(scene, Disk{{4.2, 1, 2.99}, {0, 0, -1}, 0.15}, Rgb::grey(5000));
    return scene;
}

class Factors : public testing::TestWithParam<patches::BufferBackend> {
  protected:
    void SetUp() override {
        if (GetParam() == patches::BufferBackend::rays) return;
        try {
            const patches::OpenGlContext context;
        } catch (const InputError& error) {
            GTEST_SKIP() << error.what();
        }
    }
};

/// sum_j A_j e_ij is the flux of the light, in every window, however coarse the pixels.
TEST_P(Factors, TakeAllLightOfAClosedRoom) {
    const PreparedScene room(room_of_lights(), 0.5);
    const FirstShotLights lights = room.lights();
    for (const patches::BufferShape window : {patches::BufferShape::cube, patches::BufferShape::hemicube,
                                              patches::BufferShape::cubic_tetrahedron}) {
        for (const int resolution : {64, 256}) {
            const FirstShotFactors factors(room.patch_caster, lights.samples,
                                           {window, GetParam(), resolution});
            std::vector<double> arrived_lm(lights.lights.size());
            for (std::uint32_t side = 0; side < room.sides(); ++side) {
                for (const auto& factor : factors.of(side)) {
                    arrived_lm[lights.samples[factor.sample].light] +=
                        factor.illuminance_lx * room.area_m2(side);
                }
            }
            for (std::size_t i = 0; i < arrived_lm.size(); ++i) {
                const double flux = flux_lm(room.scene, room.scene.lights[i]).luminance();
                EXPECT_NEAR(arrived_lm[i] / flux, 1, 1e-6 + 6. / (resolution * resolution))
                    << name_of(window) << ", " << resolution << ", light " << i;
            }
        }
    }
}

/// The rear half of a cube on an area light carries nothing; the front half has the hemicube's pixels.
TEST(FactorsByRays, CubesAreWhatHemicubesAre) {
    const PreparedScene room(room_of_lights(), 0.5);
    const FirstShotLights lights = room.lights();
    const FirstShotFactors cubes(room.patch_caster, lights.samples,
                                 {patches::BufferShape::cube, patches::BufferBackend::rays, 64});
    const FirstShotFactors hemicubes(room.patch_caster, lights.samples,
                                     {patches::BufferShape::hemicube, patches::BufferBackend::rays, 64});
    for (std::uint32_t side = 0; side < room.sides(); ++side) {
        const auto of_cubes = cubes.of(side), of_hemicubes = hemicubes.of(side);
        ASSERT_EQ(of_cubes.size(), of_hemicubes.size()) << side;
        for (std::size_t i = 0; i < of_cubes.size(); ++i) {
            EXPECT_EQ(of_cubes[i].sample, of_hemicubes[i].sample) << side;
            EXPECT_NEAR(of_cubes[i].illuminance_lx, of_hemicubes[i].illuminance_lx,
                        1e-5 * of_hemicubes[i].illuminance_lx)
                << side;
        }
    }
}

/// Of the triangle seen from `place` [Van Oosterom, Strackee 1983].
double solid_angle_sr(const patches::Patches& patches, std::uint32_t patch, const Vec3& place) {
    const Vec3 a = patches.position(patch, {1, 0, 0}) - place, b = patches.position(patch, {0, 1, 0}) - place,
               c = patches.position(patch, {0, 0, 1}) - place;
    const double la = length(a), lb = length(b), lc = length(c);
    const double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    return 2 * std::atan2(std::abs(dot(a, cross(b, c))), denominator);
}

/// The error of all patches together, as a share of the flux, over the resolution: its slope on log scales is
/// -1 or steeper. An isotropic source gives each patch its solid angle times the intensity.
TEST_P(Factors, ErrorsFallWithTheResolution) {
    const PreparedScene cube(cube_with_bulb(diffuse(0.5)), 0.4);
    const double intensity_cd = 1e4 / (4 * kPi);
    std::vector<double> log_error;
    for (int resolution = 64; resolution <= 1024; resolution *= 2) {
        const FirstShotFactors factors(cube.patch_caster, cube.lights().samples,
                                       {patches::BufferShape::hemicube, GetParam(), resolution});
        double wrong_lm = 0;
        for (std::uint32_t p = 0; p < cube.patches.count(); ++p) {
            const auto row = factors.of(p);
            ASSERT_EQ(row.size(), 1u);
            const double exact_lm = intensity_cd * solid_angle_sr(cube.patches, p, {2, 2, 2});
            wrong_lm += std::abs(row[0].illuminance_lx * cube.area_m2(p) - exact_lm);
            EXPECT_TRUE(factors.of(cube.patches.other_side(p)).empty());
        }
        log_error.push_back(std::log2(wrong_lm / 1e4));
        RecordProperty("log2_error_at_" + std::to_string(resolution), std::to_string(log_error.back()));
    }
    const double slope = (log_error.back() - log_error.front()) / static_cast<double>(log_error.size() - 1);
    EXPECT_LT(slope, -1);
    EXPECT_LT(log_error.back(), std::log2(2e-3));
}

INSTANTIATE_TEST_SUITE_P(Both, Factors,
                         testing::Values(patches::BufferBackend::rays, patches::BufferBackend::opengl),
                         [](const auto& test) { return std::string(name_of(test.param)); });

struct Illuminances {
    const PreparedScene& prepared;
    IncomingFirstShot incoming;

    Illuminances(const PreparedScene& scene, int resolution)
        : prepared(scene),
          incoming(
              scene.scene, scene.patches, scene.lights(),
              FirstShotFactors(scene.patch_caster, scene.lights().samples,
                               {patches::BufferShape::hemicube, patches::BufferBackend::rays, resolution})) {}
    double lx(std::uint32_t side) const { return incoming.illuminance_lx(side).luminance(); }
};

/// The root mean square of relative errors. Single patches of some hundred pixels may be wrong by 5 %.
class RelativeErrors {
  public:
    void add(double found, double exact) {
        squares_ += std::pow(found / exact - 1, 2);
        ++count_;
    }
    double rms() const { return std::sqrt(squares_ / count_); }

  private:
    double squares_ = 0;
    int count_ = 0;
};

/// Of the illuminance of a floor 2 m below a light, at patches' middles.
template <typename ExactLx>
double error_below(const Shape& light, const ExactLx& exact_lx) {
    Scene scene;
    add_object(scene, Rectangle{{-2, -2, 0}, {4, 0, 0}, {0, 4, 0}}, diffuse(0.5));
    add_area_light(scene, light, Rgb::grey(1000));
    const PreparedScene floor(std::move(scene), 0.25);
    EXPECT_TRUE(floor.lights().lights[0].is_replaced) << floor.lights().lights[0].why;
    const Illuminances illuminances(floor, 512);
    RelativeErrors errors;
    for (std::uint32_t p = 0; p < floor.patches.first_of_object[1]; ++p) {
        errors.add(illuminances.lx(p), exact_lx(exact::Receiver{floor.middle(p), {0, 0, 1}}));
    }
    return errors.rms();
}

TEST(FactorsOfAreaLights, AgreeWithConfigurationFactors) {
    const Rectangle square{{-0.15, -0.2, 2}, {0, 0.3, 0}, {0.3, 0, 0}};
    EXPECT_LT(error_below(square,
                          [&](const auto& receiver) {
                              return exact::illuminance_by_rectangle_lx(receiver, square.corner,
                                                                        square.edge_u, square.edge_v, 1000);
                          }),
              0.02);
    const Disk disk{{0.3, 0.1, 2}, normalized(Vec3{0.3, 0, -1}), 0.2};
    EXPECT_LT(
        error_below(
            disk,
            [&](const auto& receiver) {
                return exact::illuminance_by_disk_lx(receiver, {disk.center, disk.normal, disk.radius}, 1000);
            }),
        0.02);
    const Sphere sphere{{0.2, 0, 2}, 0.2};
    EXPECT_LT(error_below(sphere,
                          [&](const auto& receiver) {
                              return exact::illuminance_by_sphere_lx(receiver, sphere.center, sphere.radius,
                                                                     1000);
                          }),
              0.02);
}

/// In the cube of 4 m with 10 klm at the centre: E = I cos / d^2, here the mean over a patch, and over all
/// the flux over the area.
TEST(FactorsOfPoints, AreTheInverseSquareLaw) {
    const PreparedScene cube(cube_with_bulb(diffuse(0.8)), 0.2);
    const Illuminances illuminances(cube, 1024);
    double flux_lm = 0;
    RelativeErrors errors;
    for (std::uint32_t p = 0; p < cube.patches.count(); ++p) {
        const exact::Receiver receiver{cube.middle(p), cube.patches.normal_of(p)};
        const double exact = exact::illuminance_by_point_lx(receiver, {2, 2, 2}, 1e4 / (4 * kPi));
        errors.add(illuminances.lx(p), exact);
        flux_lm += illuminances.lx(p) * cube.area_m2(p);
    }
    EXPECT_LT(errors.rms(), 0.015);
    EXPECT_NEAR(flux_lm / 96, 1e4 / 96, 1e-3);
}

/// A luminaire's intensity towards each patch, its turn and aim included.
TEST(FactorsOfLuminaires, FollowTheirDistribution) {
    Scene scene = empty_cube(diffuse(0.5));
    PhotometricSolid::Grid grid{.planes_deg = {0, 90, 180, 270, 360}, .polar_deg = {}, .intensity_cd = {}};
    for (int gamma = 0; gamma <= 180; gamma += 20) grid.polar_deg.push_back(gamma);
    for (int i = 0; i < 50; ++i) grid.intensity_cd.push_back(100 + 37 * (i % 40) % 90);
    add_luminaire(scene, {1.5, 2.5, 2}, PhotometricSolid(grid), normalized(Vec3{1, 0.4, -0.5}), 40,
                  {{0.5, 1, 2}});
    const PreparedScene cube(std::move(scene), 0.2);
    const Illuminances illuminances(cube, 1024);
    RelativeErrors errors;
    for (std::uint32_t p = 0; p < cube.patches.count(); ++p) {
        const auto light = cube.sampler.sample_incident(0, {cube.middle(p)}, {});
        const Rgb exact = light->normal_illuminance_lx * dot(light->direction, cube.patches.normal_of(p));
        const Rgb found = illuminances.incoming.illuminance_lx(p);
        for (std::size_t band = 0; band < kBands; ++band) errors.add(found[band], exact[band]);
    }
    EXPECT_LT(errors.rms(), 0.02);
}

/// Behind a box that hides the light: patches that lie in its shadow with all three corners get nothing.
TEST(FactorsOfPoints, LeaveShadowsDark) {
    Scene scene = cube_with_bulb(diffuse(0.5));
    const Box box{{1.5, 1.4, 0.8}, {2.4, 2.5, 1}};
    add_object(scene, box, diffuse(0.5));
    const PreparedScene cube(std::move(scene), 0.15);
    const Illuminances illuminances(cube, 512);
    const auto is_shaded = [&](const Vec3& corner) {
        const Vec3 in_top = Vec3{2, 2, 2} + (corner - Vec3{2, 2, 2}) * (1 / (2 - corner.z));
        return corner.z < 0.01 && in_top.x > box.min.x && in_top.x < box.max.x && in_top.y > box.min.y &&
               in_top.y < box.max.y;
    };
    int shaded = 0, lit = 0;
    for (std::uint32_t p = 0; p < cube.patches.first_of_object[1]; ++p) {
        const bool all = is_shaded(cube.patches.position(p, {1, 0, 0})) &&
                         is_shaded(cube.patches.position(p, {0, 1, 0})) &&
                         is_shaded(cube.patches.position(p, {0, 0, 1}));
        EXPECT_FALSE(all && illuminances.lx(p) > 0) << p;
        (all ? shaded : lit) += 1;
    }
    EXPECT_GT(shaded, 100);
    EXPECT_GT(lit, 1000);
}

}  // namespace
}  // namespace stilb::estimators
