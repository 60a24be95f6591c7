// The four variants of first shot: each reflects what it says, and they agree as far as each is exact.
#include "estimators/patch_light/first_shot/first_shot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "estimators/first_shot_rooms.h"
#include "exact/configuration_factors.h"
#include "materials/black.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "materials/thin_dielectric.h"
#include "materials/ward.h"
#include "stilb/error.h"

namespace stilb::estimators {
namespace {

FirstShotOptions options(FirstShotVariant variant, int resolution, int bin_rings = 4) {
    return {variant, {patches::BufferShape::hemicube, patches::BufferBackend::rays, resolution}, bin_rings};
}

const Material kGlossy = Phong{{{0.4, 0.3, 0.2}}, Rgb::grey(0.3), 20};

/// A cabinet, a bulb, a panel in the ceiling and a ball of light, all over one material.
Scene room_of(const Material& material) {
    Scene scene;
    add_object(scene, inward({{0, 0, 0}, {5, 4, 3}}), material);
    add_object(scene, Box{{0.5, 0.4, 0}, {1.4, 1.1, 1.2}}, material);
    add_point_light(scene, {2.3, 1.9, 1.6}, {{100, 80, 30}});
    add_area_light(scene, Rectangle{{3, 2, 3}, {0, 0.5, 0}, {0.5, 0, 0}}, {{1000, 900, 500}});
    add_area_light(scene, Sphere{{1, 3, 2}, 0.1}, Rgb::grey(3000));
    return scene;
}

/// A direction in front of a side, another one for each.
Vec3 some_direction(const PreparedScene& room, std::uint32_t side) {
    const Frame frame = Frame::around(room.patches.normal_of(side));
    return frame.to_world(
        math::sample_cosine_hemisphere(std::fmod(0.618 * side, 1), std::fmod(0.414 * side, 1)).direction);
}

/// The mean over a side's patch, by the middles of its parts: n^2 triangles.
Rgb mean_reflected(const PreparedScene& room, const FirstShot& shot, std::uint32_t side, int n) {
    Rgb sum;
    const auto add = [&](double b1, double b2) {
        const Vec3 place = room.patches.position(room.patches.patch_of(side), {1 - b1 - b2, b1, b2});
        sum += shot.reflected(side, place, {}, some_direction(room, side));
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; i + j < n; ++j) {
            add((i + 1. / 3) / n, (j + 1. / 3) / n);
            if (i + j + 1 < n) add((i + 2. / 3) / n, (j + 2. / 3) / n);
        }
    }
    return sum * (1. / (n * n));
}

/// pi times it is what a side gives off in all.
Rgb mean_over_directions(const PreparedScene& room, const FirstShot& shot, std::uint32_t side) {
    constexpr int kSteps = 48;
    const Frame frame = Frame::around(room.patches.normal_of(side));
    std::vector<Vec3> outs;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const double u1 = (i / kSteps + 0.5) / kSteps, u2 = (i % kSteps + 0.5) / kSteps;
        outs.push_back(frame.to_world(math::sample_cosine_hemisphere(u1, u2).direction));
    }
    std::vector<Rgb> sums(outs.size());
    shot.add_reflected(side, room.middle(side), {}, outs, sums);
    return std::accumulate(sums.begin(), sums.end(), Rgb{}) * (1. / (kSteps * kSteps));
}

/// sum_j A_j |L_j - L'_j| / sum_j A_j L'_j.
template <typename Found, typename Reference>
double difference(const PreparedScene& room, const Found& found, const Reference& reference) {
    double wrong = 0, all = 0;
    for (std::uint32_t side = 0; side < room.sides(); ++side) {
        const double expected = reference(side).luminance();
        wrong += room.area_m2(side) * std::abs(found(side).luminance() - expected);
        all += room.area_m2(side) * expected;
    }
    return wrong / all;
}

Rgb reflected_from_middle(const PreparedScene& room, const FirstShot& shot, std::uint32_t side) {
    return shot.reflected(side, room.middle(side), {}, some_direction(room, side));
}

void expect_same(const Rgb& found, const Rgb& expected, double relative_error) {
    for (std::size_t band = 0; band < kBands; ++band) {
        EXPECT_NEAR(found[band], expected[band], relative_error * expected[band] + 1e-300);
    }
}

/// What is stored in three ways is the same where nothing depends on direction, and shadow rays differ by the
/// boundary pixels of patches and by what vertices are not the whole light.
TEST(FirstShot, VariantsAgreeOnDiffuseReflection) {
    const PreparedScene room(room_of(diffuse(0.5)), 0.5);
    const FirstShot incoming = room.first_shot(options(FirstShotVariant::incoming, 256));
    const FirstShot classical = room.first_shot(options(FirstShotVariant::classical, 256));
    const FirstShot diffuse_only = room.first_shot(options(FirstShotVariant::diffuse, 256));
    for (std::uint32_t side = 0; side < room.sides(); ++side) {
        EXPECT_TRUE(incoming.is_constant(side) && classical.is_constant(side) &&
                    diffuse_only.is_constant(side));
        const Rgb expected = reflected_from_middle(room, incoming, side);
        expect_same(reflected_from_middle(room, classical, side), expected, 1e-6);
        expect_same(reflected_from_middle(room, diffuse_only, side), expected, 1e-6);
    }
    const FirstShot on_the_fly = room.first_shot(options(FirstShotVariant::on_the_fly, 0));
    EXPECT_LT(difference(
                  room, [&](std::uint32_t side) { return reflected_from_middle(room, incoming, side); },
                  [&](std::uint32_t side) { return mean_reflected(room, on_the_fly, side, 5); }),
              0.015);
}

/// That error falls as 1 / resolution at least.
TEST(FirstShot, DifferenceToShadowRaysFallsWithTheResolution) {
    Scene scene = room_of(diffuse(0.5));
    scene.lights.resize(1);
    const PreparedScene room(std::move(scene), 0.4);
    const FirstShot on_the_fly = room.first_shot(options(FirstShotVariant::on_the_fly, 0));
    std::vector<Rgb> reference;
    for (std::uint32_t side = 0; side < room.sides(); ++side) {
        reference.push_back(mean_reflected(room, on_the_fly, side, 16));
    }
    std::vector<double> log_error;
    for (int resolution = 64; resolution <= 512; resolution *= 2) {
        const FirstShot incoming = room.first_shot(options(FirstShotVariant::incoming, resolution));
        log_error.push_back(std::log2(difference(
            room, [&](std::uint32_t side) { return reflected_from_middle(room, incoming, side); },
            [&](std::uint32_t side) { return reference[side]; })));
        RecordProperty("log2_error_at_" + std::to_string(resolution), std::to_string(log_error.back()));
    }
    EXPECT_LT((log_error.back() - log_error.front()) / 3, -1);
    EXPECT_LT(log_error.back(), std::log2(0.01));
}

/// L* = e f(w_i, w), whatever the BRDF, and nothing behind the side.
TEST(FirstShot, IncomingReflectsByTheBrdf) {
    const std::vector<Material> materials{kGlossy, RoughConductor({{{0.9, 0.6, 0.3}}, 0.3}),
                                          Ward({Rgb::grey(0.2), Rgb::grey(0.3), {0.1, 0.4}, 25}),
                                          Plastic({{{0.5, 0.4, 0.1}}, 1.5, 0.2})};
    for (const Material& material : materials) {
        const PreparedScene cube(cube_with_bulb(material), 1);
        const FirstShot shot = cube.first_shot(options(FirstShotVariant::incoming, 64));
        for (std::uint32_t side = 0; side < cube.patches.count(); ++side) {
            const Frame frame = Frame::of_surface(cube.patches.normal_of(side));
            const Vec3 out = some_direction(cube, side);
            const Vec3 in = normalized(Vec3{2, 2, 2} - cube.middle(side));
            const auto row = shot.incoming()->factors().of(side);
            ASSERT_EQ(row.size(), 1u);
            const Rgb expected = evaluate_brdf_per_sr(material, frame.to_local(in), frame.to_local(out)) *
                                 row[0].illuminance_lx;
            expect_same(shot.reflected(side, {}, {}, out), expected, 1e-9);
            EXPECT_EQ(shot.reflected(side, {}, {}, -out), Rgb{});
            EXPECT_FALSE(shot.is_constant(side));
            EXPECT_TRUE(shot.is_constant(cube.patches.other_side(side)));
        }
    }
}

/// Several directions at once are as one by one.
TEST(FirstShot, AddsWhatIsReflectedInSeveralDirections) {
    const PreparedScene room(room_of(kGlossy), 1);
    for (const auto variant : {FirstShotVariant::classical, FirstShotVariant::diffuse,
                               FirstShotVariant::incoming, FirstShotVariant::on_the_fly}) {
        const FirstShot shot = room.first_shot(options(variant, 64));
        for (std::uint32_t side = 0; side < room.sides(); ++side) {
            const std::array<Vec3, 2> outs{some_direction(room, side), room.patches.normal_of(side)};
            std::array<Rgb, 2> sums{Rgb::grey(1), Rgb::grey(2)};
            shot.add_reflected(side, room.middle(side), {}, outs, sums);
            for (std::size_t i = 0; i < outs.size(); ++i) {
                const Rgb before = Rgb::grey(static_cast<double>(i + 1));
                expect_same(sums[i], before + shot.reflected(side, room.middle(side), {}, outs[i]), 1e-12);
            }
        }
    }
}

/// Of a BRDF that splits, the diffuse part is a mean over the patch and the rest that of the position; of one
/// that does not, all is.
TEST(FirstShot, DiffuseVariantLeavesTheRestToShadowRays) {
    const auto& phong = *kGlossy.get_if<Phong>();
    const PreparedScene matt(room_of(Diffuse{phong.diffuse}), 0.8), glossy(room_of(kGlossy), 0.8),
        lobe(room_of(Phong{{}, phong.specular, phong.exponent}), 0.8),
        plastic(room_of(Plastic({Rgb::grey(0.5), 1.5, 0.2})), 0.8);
    const FirstShot split = glossy.first_shot(options(FirstShotVariant::diffuse, 64));
    const FirstShot stored = matt.first_shot(options(FirstShotVariant::diffuse, 64));
    const FirstShot rest = lobe.first_shot(options(FirstShotVariant::on_the_fly, 64));
    const FirstShot no_split = plastic.first_shot(options(FirstShotVariant::diffuse, 64));
    const FirstShot all = plastic.first_shot(options(FirstShotVariant::on_the_fly, 64));
    for (std::uint32_t side = 0; side < glossy.sides(); ++side) {
        const Rgb expected =
            reflected_from_middle(matt, stored, side) + reflected_from_middle(lobe, rest, side);
        expect_same(reflected_from_middle(glossy, split, side), expected, 1e-6);
        expect_same(reflected_from_middle(plastic, no_split, side), reflected_from_middle(plastic, all, side),
                    0);
    }
}

/// A bin's radiance is the mean of what it stands for: its flux is right, and its error falls with its size.
TEST(FirstShot, ClassicalBinsComeCloserToTheBrdf) {
    const PreparedScene room(room_of(kGlossy), 1.5);
    const FirstShot incoming = room.first_shot(options(FirstShotVariant::incoming, 64));
    const auto bins_stored = [&](int bins) {
        std::size_t stored = 0;
        for (std::uint32_t side = 0; side < room.sides(); ++side)
            stored += incoming.is_constant(side) ? 0 : bins;
        return stored;
    };
    std::vector<double> errors;
    for (const int rings : {2, 4, 8}) {
        const FirstShot classical = room.first_shot(options(FirstShotVariant::classical, 64, rings));
        errors.push_back(difference(
            room, [&](std::uint32_t side) { return reflected_from_middle(room, classical, side); },
            [&](std::uint32_t side) { return reflected_from_middle(room, incoming, side); }));
        EXPECT_NEAR(difference(
                        room, [&](std::uint32_t side) { return mean_over_directions(room, classical, side); },
                        [&](std::uint32_t side) { return mean_over_directions(room, incoming, side); }),
                    0, 0.02);
        EXPECT_EQ(classical.bytes(), 8 * (room.sides() + 1) + 12 * bins_stored(4 * rings * rings));
    }
    EXPECT_LT(errors[0], 0.5);
    EXPECT_LT(errors[1], 0.65 * errors[0]);
    EXPECT_LT(errors[2], 0.65 * errors[1]);
}

TEST(HemisphereBins, HaveEqualProjectedSolidAngles) {
    const HemisphereBins bins(3);
    ASSERT_EQ(bins.count(), 36u);
    std::vector<int> hits(bins.count());
    constexpr int kSteps = 360;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const Vec3 direction =
            math::sample_cosine_hemisphere((i / kSteps + 0.5) / kSteps, (i % kSteps + 0.5) / kSteps)
                .direction;
        ++hits[bins.bin_of(direction)];
    }
    for (std::uint32_t bin = 0; bin < bins.count(); ++bin) {
        EXPECT_NEAR(hits[bin] * 36. / (kSteps * kSteps), 1, 0.03) << bin;
        EXPECT_EQ(bins.bin_of(bins.direction(bin, 0.01, 0.99)), bin);
        EXPECT_EQ(bins.bin_of(bins.direction(bin, 0.99, 0.01)), bin);
        EXPECT_NEAR(length(bins.direction(bin, 0.3, 0.6)), 1, 1e-14);
    }
    EXPECT_EQ(bins.bin_of({0, 0, 1}), 0u);
    EXPECT_LT(bins.bin_of({1, -1e-20, 0}), bins.count());
    EXPECT_THROW(HemisphereBins(0), InputError);
}

/// Over positions, points drawn on lights have no bias; and positions on the patches of a ball, which lie
/// inside of it, are not in its own shadow.
TEST(FirstShot, ShadowRaysAreTheWholeLight) {
    Scene scene;
    add_object(scene, Rectangle{{-2, -2, 0}, {4, 0, 0}, {0, 4, 0}}, diffuse(1));
    add_object(scene, Sphere{{0, 0, -8}, 4}, diffuse(1));
    const Rectangle panel{{-0.3, -0.2, 2}, {0, 0.5, 0}, {0.5, 0, 0}};
    add_area_light(scene, panel, Rgb::grey(1000));
    add_point_light(scene, {0, 0, -3}, Rgb::grey(50));
    const PreparedScene floor(std::move(scene), 0.15);
    const FirstShot shot = floor.first_shot(options(FirstShotVariant::on_the_fly, 0));
    double found = 0, expected = 0;
    for (std::uint32_t p = 0; p < floor.patches.first_of_object[1]; ++p) {
        found += floor.area_m2(p) * kPi * reflected_from_middle(floor, shot, p).luminance();
        expected +=
            floor.area_m2(p) * exact::illuminance_by_rectangle_lx({floor.middle(p), {0, 0, 1}}, panel.corner,
                                                                  panel.edge_u, panel.edge_v, 1000);
    }
    EXPECT_NEAR(found / expected, 1, 1e-3);
    for (std::uint32_t p = floor.patches.first_of_object[1]; p < floor.patches.first_of_object[2]; ++p) {
        const double by_point =
            exact::illuminance_by_point_lx({floor.middle(p), floor.patches.normal_of(p)}, {0, 0, -3}, 50);
        if (floor.middle(p).z < -4.5) continue;
        EXPECT_NEAR(kPi * reflected_from_middle(floor, shot, p).luminance(), by_point, 1e-6 * by_point);
    }
}

/// What is small and what is not, said in the report.
TEST(FirstShot, DecidesWhichLightsAreSmall) {
    Scene scene = room_of(diffuse(0.5));
    add_area_light(scene, Rectangle{{0.01, 0.2, 0.2}, {0, 3.5, 0}, {0, 0, 2.5}}, Rgb::grey(100));
    add_area_light(scene, Rectangle{{1, 1, 2.99}, {0, 0.1, 0}, {0.1, 0, 0}}, {});
    const PreparedScene room(std::move(scene), 1);
    const FirstShot shot = room.first_shot(options(FirstShotVariant::incoming, 64));
    const std::vector<bool> expected{true, true, true, false, false};
    const std::vector<std::size_t> samples{1, 5, 12, 0, 0};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(shot.replaces(i), expected[i]) << shot.lights()[i].why;
        EXPECT_EQ(shot.lights()[i].samples, samples[i]) << shot.lights()[i].why;
        EXPECT_EQ(shot.lights()[i].name, room.scene.lights[i].name);
    }
    EXPECT_NE(shot.lights()[3].why.find("large"), std::string::npos);
    EXPECT_NE(shot.lights()[4].why.find("dark"), std::string::npos);
    const FirstShot none = room.first_shot(options(FirstShotVariant::none, 64));
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_FALSE(none.replaces(i));
    EXPECT_EQ(reflected_from_middle(room, none, 0), Rgb{});
}

TEST(FirstShot, ReflectsNothingFromMirrorsGlassAndPanes) {
    for (const Material& material : {Material(Mirror{Rgb::grey(0.9)}), Material(Dielectric{}),
                                     Material(ThinDielectric{}), Material(Black{})}) {
        const PreparedScene cube(cube_with_bulb(material), 2);
        for (const auto variant : {FirstShotVariant::classical, FirstShotVariant::diffuse,
                                   FirstShotVariant::incoming, FirstShotVariant::on_the_fly}) {
            const FirstShot shot = cube.first_shot(options(variant, 64));
            for (std::uint32_t side = 0; side < cube.sides(); ++side) {
                EXPECT_EQ(reflected_from_middle(cube, shot, side), Rgb{}) << name_of(variant);
            }
        }
    }
}

/// Patches of a pixel and less are missed, and counted; at the resolution for so many patches few are.
TEST(FirstShot, CountsPatchesThatNoPixelSees) {
    const PreparedScene cube(cube_with_bulb(diffuse(0.5)), 0.1);
    const auto missed = [&](int resolution) {
        return cube.first_shot(options(FirstShotVariant::incoming, resolution)).missed();
    };
    const std::size_t patches = cube.patches.count();
    const auto seen = [&](int resolution) {
        const FirstShot shot = cube.first_shot(options(FirstShotVariant::incoming, resolution));
        std::size_t count = 0;
        for (std::uint32_t p = 0; p < patches; ++p) count += shot.incoming()->factors().of(p).size();
        return count;
    };
    EXPECT_GT(missed(32), patches / 2);
    EXPECT_EQ(missed(32) + seen(32), patches);
    EXPECT_EQ(missed(first_shot_resolution(patches, 1)), 0u);
}

/// A cube with many points of light.
Scene cube_with_lights(int along_edge) {
    Scene scene;
    add_object(scene, inward({{0, 0, 0}, {4, 4, 4}}), diffuse(0.5));
    for (int i = 0; i < along_edge * along_edge * along_edge; ++i) {
        const Vec3 steps(i % along_edge, i / along_edge % along_edge, i / (along_edge * along_edge));
        add_point_light(scene, Vec3{0.9, 1, 1.1} + (2.0 / along_edge) * steps, {{10, 10, 10}});
    }
    return scene;
}

TEST(FirstShot, NeedsFewerPixelsForManySamples) {
    const auto error = [](int along_edge) {
        const PreparedScene cube(cube_with_lights(along_edge), 0.4);
        const auto shot_at = [&](int resolution) {
            return cube.first_shot(options(FirstShotVariant::incoming, resolution));
        };
        const FirstShot automatic = shot_at(ShootingOptions::kAutomatic), fine = shot_at(256);
        EXPECT_EQ(automatic.resolution(),
                  first_shot_resolution(cube.patches.count(), std::pow(along_edge, 3)));
        return difference(
            cube, [&](std::uint32_t side) { return reflected_from_middle(cube, automatic, side); },
            [&](std::uint32_t side) { return reflected_from_middle(cube, fine, side); });
    };
    EXPECT_LT(error(4), error(1));
    EXPECT_EQ(first_shot_resolution(12000, 15), first_shot_resolution(12000, 1));
    EXPECT_EQ(first_shot_resolution(12000, 16), first_shot_resolution(12000, 1));
    EXPECT_LT(first_shot_resolution(12000, 17), first_shot_resolution(12000, 16));
    EXPECT_LT(first_shot_resolution(12000, 125), 0.52 * first_shot_resolution(12000, 16));
}

TEST(FirstShot, CountsTheSamplesThatMatter) {
    const auto number_of = [](const Scene& scene) {
        const PreparedScene room(scene, 1);
        return effective_number(room.scene, choose_first_shot_lights(room.scene, room.caster, {}));
    };
    Scene cube = cube_with_lights(3);
    EXPECT_NEAR(number_of(cube), 27, 1e-9);
    add_point_light(cube, {2, 2, 2}, Rgb::grey(10'000));
    EXPECT_NEAR(number_of(cube), 1, 0.1);
}

}  // namespace
}  // namespace stilb::estimators
