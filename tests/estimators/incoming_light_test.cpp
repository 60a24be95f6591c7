// The light that solutions keep, where what is reflected of it is known.
#include "estimators/patch_light/incoming_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimators/first_shot_rooms.h"
#include "materials/black.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "materials/rough_conductor.h"
#include "support/quadrature.h"

namespace stilb::estimators {
namespace {

/// A cube of one material, seen from patches of a metre.
struct Cube {
    explicit Cube(const Material& material) : scene(empty_cube(material)) {}

    PatchOptions options = [] {
        PatchOptions coarse;
        coarse.patch_m = 1;
        return coarse;
    }();
    Scene scene;
    rays::RayCaster caster{scene};
    PatchTransport transport{scene, caster, options};
};

double albedo(const Material& material, const Vec3& out) {
    return integrate(0, kPi / 2, 64, [&](double theta) {
        return std::sin(theta) * std::cos(theta) * integrate(0, 2 * kPi, 64, [&](double phi) {
                   const Vec3 in{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                 std::cos(theta)};
                   return evaluate_brdf_per_sr(material, in, out)[0];
               });
    });
}

/// Light that is alike from everywhere is the first term alone, sqrt(pi) times its luminance.
TEST(IncomingLight, ReflectsConstantLightByTheAlbedo) {
    const std::vector<Material> materials{Diffuse{Rgb::grey(0.6)}, Phong{Rgb::grey(0.2), Rgb::grey(0.5), 3},
                                          Phong{Rgb::grey(0.2), Rgb::grey(0.5), 80},
                                          RoughConductor({Rgb::grey(0.7), 0.3})};
    for (const Material& material : materials) {
        const Cube cube(material);
        const TermLayout layout(cube.transport, 6, reflecting_sides(cube.transport));
        const Vec3 normal = cube.transport.patches.normal_of(0);
        const Frame frame = Frame::of_surface(normal);
        for (const double theta : {0.0, 0.6, 1.2}) {
            const Vec3 out{std::sin(theta) * std::cos(1.0), std::sin(theta) * std::sin(1.0), std::cos(theta)};
            const auto factors = reflection_factors(cube.transport, layout, 0, frame.to_world(out));
            const double expected = albedo(material, out);
            EXPECT_NEAR(double{factors[0][0]} * std::sqrt(kPi), expected, 0.006 * expected)
                << type_name(material) << ' ' << theta;
        }
    }
}

/// A lobe far narrower than the functions reads them in the mirrored direction.
TEST(IncomingLight, MirrorsWhatIsKeptByANarrowLobe) {
    const Cube cube(Phong{Rgb{}, Rgb::grey(1), 50'000});
    const TermLayout layout(cube.transport, 4, reflecting_sides(cube.transport));
    const Frame frame = Frame::of_surface(cube.transport.patches.normal_of(0));
    const Vec3 out = normalized(Vec3{0.3, -0.5, 0.7}), mirrored{-out.x, -out.y, out.z};
    std::vector<double> values(layout.basis().count());
    layout.basis().evaluate(mirrored, values);
    const auto factors = reflection_factors(cube.transport, layout, 0, frame.to_world(out));
    ASSERT_EQ(factors.size(), values.size());
    const double share = albedo(Phong{Rgb{}, Rgb::grey(1), 300}, out);  // hardly depends on the exponent
    for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(factors[k][0], share * values[k], 0.02) << k;
}

TEST(IncomingLight, KeepsNoNegativeLuminance) {
    const std::vector<FloatRgb> terms{{1, 1, 1}, {-3, 2, 1}}, factors{{1, 1, 1}, {1, 1, 1}};
    const Rgb luminance = reflected_cd_m2(terms, factors);
    EXPECT_EQ(luminance, (Rgb{{0, 3, 2}}));
}

TEST(IncomingLight, KeepsOneTermOfDiffuseSidesAndNoneOfBlackAndMirrors) {
    Scene scene = empty_cube(Diffuse{Rgb::grey(0.5)});
    add_object(scene, Rectangle{{1, 1, 1}, {1, 0, 0}, {0, 1, 0}}, Mirror{Rgb::grey(0.9)});
    add_object(scene, Rectangle{{1, 1, 2}, {1, 0, 0}, {0, 1, 0}}, Black{});
    add_object(scene, Rectangle{{1, 1, 3}, {1, 0, 0}, {0, 1, 0}}, RoughConductor({Rgb::grey(0.5), 0.5}));
    const rays::RayCaster caster(scene);
    PatchOptions options;
    options.patch_m = 2;
    const PatchTransport transport(scene, caster, options);
    const TermLayout layout(transport, 2, reflecting_sides(transport));
    for (std::uint32_t side = 0; side < 2 * transport.patches.count(); ++side) {
        const std::uint32_t object = index_of(transport.patches.object_of(transport.patches.patch_of(side)));
        EXPECT_EQ(layout.count_of(side), object == 0 ? 1u : object == 3 ? 6u : 0u) << side;
    }
}

}  // namespace
}  // namespace stilb::estimators
