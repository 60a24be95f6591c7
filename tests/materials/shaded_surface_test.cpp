// Materials under shading normals: bounded, and the same light from the eye's side and from the lights'.
#include "materials/shaded_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "materials/thin_dielectric.h"
#include "materials/ward.h"
#include "math/sampling.h"
#include "support/direction_grid.h"
#include "support/random_pairs.h"

namespace stilb::materials {
namespace {

const Rgb kShadedWhite = Rgb::grey(1);

Vec3 at(double theta_deg, double phi_deg) {
    const double theta = theta_deg * kPi / 180, phi = phi_deg * kPi / 180;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// A surface whose shading normal leans by this much, towards an azimuth that is no axis.
ShadedSurface bent(const Material& material, double tilt_deg) {
    const Vec3 normal = normalized(Vec3{0.2, -0.5, 0.7});
    return {material, normal, Frame::of_surface(normal).to_world(at(tilt_deg, 40))};
}

struct ShadedCase {
    std::string name;
    Material material;
    int concentration;  ///< of the grid of directions
};

const std::vector<ShadedCase>& scattering() {
    static const std::vector<ShadedCase> cases{
        {"diffuse", Diffuse{kShadedWhite}, 1},
        {"phong 1", Phong{{}, kShadedWhite, 1}, 1},
        {"phong 100", Phong{Rgb::grey(0.5), Rgb::grey(0.5), 100}, 3},
        {"rough 0.1", RoughConductor({kShadedWhite, 0.1}), 4},
        {"rough 0.5", RoughConductor({kShadedWhite, 0.5}), 2},
        {"ward", Ward({Rgb::grey(0.3), Rgb::grey(0.7), {0.1, 0.4}, 30}), 3},
        {"plastic", Plastic({kShadedWhite, 1.5, 0.2}), 3}};
    return cases;
}

constexpr std::array<double, 4> kTilts{5, 20, 40, 60};

TEST(ShadedSurface, IsTheMaterialItselfWhereNormalsAreTheSame) {
    RandomPairs random(1);
    const Vec3 normal = normalized(Vec3{0.3, 0.4, -0.2});
    for (const ShadedCase& of : scattering()) {
        const ShadedSurface surface(of.material, normal, normal);
        EXPECT_FALSE(surface.is_bent());
        for (int i = 0; i < 100; ++i) {
            const auto [u1, u2] = random.next_pair();
            const auto [u3, u4] = random.next_pair();
            const Vec3 in = math::sample_cosine_hemisphere(u1, u2).direction;
            const Vec3 out = math::sample_cosine_hemisphere(u3, u4).direction;
            ASSERT_EQ(surface.brdf_per_sr(in, out), evaluate_brdf_per_sr(of.material, in, out));
            ASSERT_EQ(surface.pdf_of_incoming_per_sr(out, in), pdf_per_sr(of.material, out, in));
            ASSERT_EQ(surface.evaluate(in, out).brdf_per_sr, evaluate_brdf_per_sr(of.material, in, out));
            const auto drawn = sample_brdf(of.material, out, u1, u2);
            const auto from_eye = surface.sample_incoming(out, u1, u2);
            const auto from_light = surface.sample_outgoing(out, u1, u2);
            ASSERT_EQ(drawn.has_value(), from_eye.has_value());
            ASSERT_EQ(drawn.has_value(), from_light.has_value());
            if (!drawn) continue;
            ASSERT_EQ(drawn->direction, from_eye->direction);
            ASSERT_EQ(drawn->weight, from_light->weight);
        }
    }
}

/// Where the cosines' ratio is a little less than two, and a little more.
TEST(ShadedSurface, IsTwiceAsBrightAtMost) {
    const Material material = Diffuse{Rgb::grey(0.6)};
    const ShadedSurface surface = bent(material, 40);
    const Vec3 normal = surface.shading().w, towards = normalized({normal.x, normal.y, 0});
    const auto factor_at = [&](double ratio) {
        // sin(40) cos(h) + cos(40) sin(h) = ratio sin(h), for light at height h on the side of the normal.
        const double height = std::atan(std::sin(40 * kPi / 180) / (ratio - std::cos(40 * kPi / 180)));
        const Vec3 in = std::cos(height) * towards + Vec3{0, 0, std::sin(height)};
        return surface.brdf_per_sr(in, {0, 0, 1})[0] * kPi / 0.6;
    };
    EXPECT_NEAR(factor_at(1.99), 1.99, 1e-9);
    EXPECT_NEAR(factor_at(2), 2, 1e-9);
    EXPECT_NEAR(factor_at(2.01), 2, 1e-9);
}

TEST(ShadedSurface, ShowsAMattSurfaceAsTheShadingNormalWould) {
    const Material material = Diffuse{Rgb::grey(0.6)};
    const ShadedSurface surface = bent(material, 30);
    const Vec3 normal = surface.shading().w;
    RandomPairs random(2);
    int compared = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto [u1, u2] = random.next_pair();
        const auto [u3, u4] = random.next_pair();
        const Vec3 in = math::sample_cosine_hemisphere(u1, u2).direction;
        const Vec3 out = math::sample_cosine_hemisphere(u3, u4).direction;
        const double shaded = dot(in, normal);
        const double luminance = surface.brdf_per_sr(in, out)[1] * in.z;
        ASSERT_EQ(luminance > 0, shaded > 0);
        if (shaded <= 0 || shaded > kMostBrightening * in.z) continue;
        ASSERT_NEAR(luminance, 0.6 / kPi * shaded, 1e-14);
        ++compared;
    }
    EXPECT_GT(compared, 700);
}

/// The luminance along `out` in surroundings of luminance 1, by quadrature.
double seen_in_furnace(const ShadedCase& of, const ShadedSurface& surface, const Vec3& out) {
    const Vec3 mirrored_out = reflected(out, surface.shading().w);
    return DirectionGrid(0, mirrored_out, of.concentration).integrate_all([&](const Vec3& in) {
        return surface.brdf_per_sr(in, out)[1] * in.z;
    });
}

TEST(ShadedSurface, IsNeverBrighterThanItsSurroundings) {
    // The white material's own albedo is 1 within the errors of its table and of the quadrature.
    constexpr double kTolerance = 0.004;
    double largest = 0;
    for (const ShadedCase& of : scattering()) {
        for (const double tilt : {20.0, 60.0}) {
            const ShadedSurface surface = bent(of.material, tilt);
            for (const double theta : {0.0, 60.0, 85.0, 89.99}) {
                for (const double phi : {40.0, 220.0}) {
                    const double seen = seen_in_furnace(of, surface, at(theta, phi));
                    EXPECT_LE(seen, 1 + kTolerance) << of.name << ' ' << tilt << ' ' << theta << ' ' << phi;
                    largest = std::max(largest, seen);
                }
            }
        }
    }
    RecordProperty("largest", std::to_string(largest));
}

/// The density of a sampler and its samples, over the grid's cells.
template <typename Draw, typename Pdf>
void expect_density(const ShadedCase& of, const Vec3& focus, const Draw& draw, const Pdf& pdf, double least_p,
                    const std::string& what) {
    const auto direction_of = [&](double u1, double u2) -> std::optional<Vec3> {
        const auto sample = draw(u1, u2);
        if (!sample) return std::nullopt;
        return sample->direction;
    };
    EXPECT_GT(DirectionGrid(0, focus, of.concentration).p_value(100'000, 5, direction_of, pdf), least_p)
        << of.name << ' ' << what;
}

TEST(ShadedSurface, SamplesHaveTheirWeightsAndDensities) {
    constexpr double kLeast = 1e-5;  // of some 100 comparisons
    RandomPairs random(3);
    for (const ShadedCase& of : scattering()) {
        for (const double tilt : {10.0, 60.0}) {
            const ShadedSurface surface = bent(of.material, tilt);
            for (const Vec3& known : {at(20, 10), at(75, 215), at(85, 40)}) {
                const Vec3 focus = reflected(known, surface.shading().w);
                expect_density(
                    of, focus, [&](double u1, double u2) { return surface.sample_incoming(known, u1, u2); },
                    [&](const Vec3& in) { return surface.pdf_of_incoming_per_sr(known, in); }, kLeast, "in");
                for (int i = 0; i < 2000; ++i) {
                    const auto [u1, u2] = random.next_pair();
                    if (const auto in = surface.sample_incoming(known, u1, u2)) {
                        const Rgb f = surface.brdf_per_sr(in->direction, known);
                        ASSERT_NEAR(in->weight[0], f[0] * in->direction.z / in->pdf_per_sr,
                                    1e-9 * in->weight[0] + 1e-14);
                        ASSERT_LE(in->weight[0], 10);
                    }
                    if (const auto out = surface.sample_outgoing(known, u1, u2)) {
                        const Rgb f = surface.brdf_per_sr(known, out->direction);
                        ASSERT_NEAR(out->weight[0], f[0] * out->direction.z / out->pdf_per_sr,
                                    1e-9 * out->weight[0] + 1e-14);
                    }
                }
            }
        }
    }
}

/// Smooth functions of directions.
double light_from(const Vec3& in) { return 1 + 0.5 * in.x - 0.3 * in.y * in.z; }
double importance_of(const Vec3& out) { return 1 - 0.4 * out.x * out.y + 0.6 * out.y; }

struct Mean {
    double sum = 0, squares = 0, count = 0;
    void add(double value) { sum += value, squares += value * value, ++count; }
    double value() const { return sum / count; }
    double squared_error() const { return (squares / count - value() * value()) / count; }
};
double apart_z(const Mean& a, const Mean& b) {
    return (a.value() - b.value()) / std::sqrt(a.squared_error() + b.squared_error());
}

TEST(ShadedSurface, MakesTheSameLightFromBothSides) {
    // The integral of importance f* light cos cos over both directions.
    double worst = 0;
    for (const ShadedCase& of : scattering()) {
        for (const double tilt : kTilts) {
            const ShadedSurface surface = bent(of.material, tilt);
            RandomPairs random(static_cast<std::uint64_t>(tilt));
            Mean from_eye, from_light;
            for (int i = 0; i < 400'000; ++i) {
                const auto [u1, u2] = random.next_pair();
                const auto [u3, u4] = random.next_pair();
                const Vec3 first = math::sample_cosine_hemisphere(u1, u2).direction;
                const auto in = surface.sample_incoming(first, u3, u4);
                from_eye.add(in ? kPi * importance_of(first) * in->weight[0] * light_from(in->direction) : 0);
                const auto out = surface.sample_outgoing(first, u3, u4);
                from_light.add(out ? kPi * light_from(first) * out->weight[0] * importance_of(out->direction)
                                   : 0);
            }
            const double z = apart_z(from_eye, from_light);
            EXPECT_LT(std::abs(z), 4) << of.name << ' ' << tilt;
            EXPECT_LT(std::sqrt(from_light.squared_error()), 0.005 * from_light.value()) << of.name;
            worst = std::max(worst, std::abs(z));
        }
    }
    RecordProperty("worst_z", std::to_string(worst));
}

/// A direction's share, summed over the ways on.
template <typename Function>
double through_branches(const ShadedSurface& surface, LightSide side, const Vec3& from, Carried carried,
                        const Function& value_of) {
    double sum = 0;
    const SpecularBranches branches = surface.branches(side, from, carried);
    for (const SpecularBranch& branch : branches.list()) {
        const double factor = carried == Carried::luminance ? branch.luminance_factor : 1;
        sum += branch.share[0] * factor * value_of(branch.direction);
    }
    return sum;
}

TEST(ShadedSurface, MirrorsTheSameLightFromBothSides) {
    const Material mirror = Mirror{Rgb::grey(0.9)};
    for (const double tilt : kTilts) {
        const ShadedSurface surface = bent(mirror, tilt);
        RandomPairs random(8);
        Mean from_eye, from_light;
        for (int i = 0; i < 1'000'000; ++i) {
            const auto [u1, u2] = random.next_pair();
            const Vec3 first = math::sample_cosine_hemisphere(u1, u2).direction;
            from_eye.add(importance_of(first) * through_branches(surface, LightSide::outside, first,
                                                                 Carried::luminance, light_from));
            from_light.add(light_from(first) * through_branches(surface, LightSide::outside, first,
                                                                Carried::flux, importance_of));
        }
        EXPECT_LT(std::abs(apart_z(from_eye, from_light)), 4) << tilt;
        EXPECT_LT(std::sqrt(from_light.squared_error()), 0.002 * from_light.value());
    }
}

TEST(ShadedSurface, RefractsTheSameLightFromBothSides) {
    // The light is outside of a solid, the eye within: what is reflected goes to the wrong side.
    const Material glass = Dielectric{1.5};
    const Vec3 normal = normalized(Vec3{0.2, -0.5, 0.7});
    for (const double tilt : kTilts) {
        const Vec3 shading = Frame::of_surface(normal).to_world(at(tilt, 40));
        const ShadedSurface outside(glass, normal, shading), inside(glass, -normal, -shading);
        const auto light_from_within = [&](const Vec3& in) {
            const Vec3 to_light = outside.frame().to_local(inside.frame().to_world(in));
            return to_light.z > 0 ? light_from(to_light) : 0;
        };
        const auto importance_from_outside = [&](const Vec3& out) {
            const Vec3 to_camera = inside.frame().to_local(outside.frame().to_world(out));
            return to_camera.z > 0 ? importance_of(to_camera) : 0;
        };
        RandomPairs random(9);
        Mean from_eye, from_light;
        for (int i = 0; i < 1'000'000; ++i) {
            const auto [u1, u2] = random.next_pair();
            const Vec3 first = math::sample_cosine_hemisphere(u1, u2).direction;
            from_eye.add(importance_of(first) * through_branches(inside, LightSide::inside, first,
                                                                 Carried::luminance, light_from_within));
            from_light.add(light_from(first) * through_branches(outside, LightSide::outside, first,
                                                                Carried::flux, importance_from_outside));
        }
        EXPECT_LT(std::abs(apart_z(from_eye, from_light)), 4) << tilt;
        EXPECT_LT(std::sqrt(from_light.squared_error()), 0.002 * from_light.value());
    }
}

TEST(ShadedSurface, BoundsTheFluxOfParticles) {
    RandomPairs random(11);
    for (const double tilt : kTilts) {
        const Material matt = Diffuse{kShadedWhite}, mirror = Mirror{kShadedWhite};
        const ShadedSurface diffuse = bent(matt, tilt), specular = bent(mirror, tilt);
        for (int i = 0; i < 20'000; ++i) {
            const auto [u1, u2] = random.next_pair();
            const Vec3 in = at(89.999 + 0.001 * u1, 360 * u2);
            const auto [u3, u4] = random.next_pair();
            const auto out = diffuse.sample_outgoing(in, u3, u4);
            ASSERT_LE(out ? out->weight[0] : 0, 4 * kMostBrightening);
            const SpecularBranches branches = specular.branches(LightSide::outside, in, Carried::flux);
            for (const SpecularBranch& branch : branches.list()) {
                ASSERT_LE(branch.share[0], kMostBrightening);
                ASSERT_GT(branch.direction.z, 0);
            }
        }
    }
}

TEST(ShadedSurface, LeavesPanesFlat) {
    const Material pane = ThinDielectric{1.5, kShadedWhite};
    const ShadedSurface surface = bent(pane, 20);
    const Vec3 in = at(40, 10);
    const SpecularBranches own = specular_branches(pane, LightSide::outside, in);
    const SpecularBranches branches = surface.branches(LightSide::outside, in, Carried::luminance);
    ASSERT_EQ(branches.list().size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(branches.list()[i].direction, own.list()[i].direction);
        EXPECT_EQ(branches.list()[i].share, own.list()[i].share);
    }
}

}  // namespace
}  // namespace stilb::materials
