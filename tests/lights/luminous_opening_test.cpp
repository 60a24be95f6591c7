// Luminaires that shine from their opening: exact intensities at a distance, and the points that light leaves
// from.
#include "lights/luminous_opening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lights/opening_shape.h"
#include "support/scene_builder.h"

namespace stilb::lights {
namespace {

using Form = Opening::Form;

/// Unequal planes; light in all directions up to `last_deg` from the nadir.
PhotometricSolid solid_up_to(double last_deg) {
    PhotometricSolid::Grid grid;
    grid.planes_deg = {0, 90, 180, 270, 360};
    grid.polar_deg = {0, last_deg / 2, last_deg};
    grid.intensity_cd = {300, 200, 150, 300, 350, 90, 300, 100, 50, 300, 250, 20, 300, 200, 150};
    return PhotometricSolid(grid);
}

struct Case {
    std::string name;
    Opening opening;
    double last_deg = 90;
};

std::vector<Case> cases() {
    return {{"rectangle", {Form::box, {0.6, 0.3, 0}}},
            {"plate", {Form::box, {0.6, 0.3, 0}}, 150},
            {"line", {Form::box, {0, 1.2, 0}}},
            {"box", {Form::box, {0.4, 0.3, 0.2}}, 180},
            {"disk", {Form::vertical_cylinder, {0.3, 0.3, 0}}},
            {"ellipse", {Form::vertical_cylinder, {0.3, 0.5, 0}}},
            {"drum", {Form::vertical_cylinder, {0.3, 0.3, 0.4}}, 180},
            {"tube along C0", {Form::cylinder_along_c0, {1.2, 0.05, 0.05}}, 180},
            {"tube along C90", {Form::cylinder_along_c90, {0.05, 1.2, 0.05}}, 180},
            {"ball", {Form::ball, {0.3, 0.3, 0.3}}, 180}};
}

/// A scene with one luminaire, aimed anywhere.
Scene scene_of(const Case& c) {
    Scene scene;
    add_opening(scene, {1, 2, 3}, solid_up_to(c.last_deg), c.opening, normalized(Vec3{0.3, -0.5, -0.7}), 25,
                Rgb{{0.5, 1, 2}});
    return scene;
}

const LuminousOpening& light_of(const Scene& scene) {
    return std::get<LuminousOpening>(scene.lights.at(0).source);
}

OpeningEmitter emitter_of(const Scene& scene) {
    return {light_of(scene), scene::LightSurroundings(scene), scene::lift_of(scene)};
}

Vec3 direction_of(const Luminaire& luminaire, double c, double gamma) {
    const double sine = std::sin(gamma);
    return sine * std::cos(c) * luminaire.c0 + sine * std::sin(c) * luminaire.c90 +
           std::cos(gamma) * luminaire.nadir;
}

/// The mean of the light of many samples at a distant point is that of the point luminaire, whose intensity
/// the file states.
TEST(LuminousOpening, HasTheIntensityOfItsFileAtADistance) {
    constexpr double kFar_m = 1000;
    constexpr std::uint64_t kSamples = 4096;
    for (const Case& c : cases()) {
        const Scene scene = scene_of(c);
        const Luminaire& luminaire = light_of(scene).luminaire;
        const LuminaireEmitter point(luminaire, scene::LightSurroundings(scene), scene::lift_of(scene));
        const OpeningEmitter opening = emitter_of(scene);
        for (const double gamma : {0.1, 0.6, 1.2, 1.5, 2.2}) {
            if (gamma * 180 / kPi > c.last_deg) continue;
            const Vec3 at = luminaire.position + kFar_m * direction_of(luminaire, 0.7, gamma);
            double sum = 0;
            for (std::uint64_t i = 0; i < kSamples; ++i) {
                math::SampleStream stream(math::RandomKey{}, i);
                const auto light = opening.sample_incident({at}, stream.next_two());
                if (light) sum += light->normal_illuminance_lx.luminance() / kSamples;
            }
            const double exact = point.sample_incident({at}, {})->normal_illuminance_lx.luminance();
            EXPECT_NEAR(sum / exact, 1, 2e-3) << c.name << ", gamma " << gamma;
        }
    }
}

/// The luminance towards the eye is the intensity over the projected opening.
TEST(LuminousOpening, HasTheLuminanceOfItsIntensityOverTheProjectedOpening) {
    const Scene scene = scene_of({"rectangle", {Form::box, {0.6, 0.3, 0}}});
    const Luminaire& luminaire = light_of(scene).luminaire;
    const double gamma = 0.8;
    const Vec3 leaving = direction_of(luminaire, 0.7, gamma);
    const double intensity_cd = solid_up_to(90).intensity_cd(luminaire.in_solid(leaving));
    const Rgb luminance = emitter_of(scene).luminance_cd_m2(leaving);
    const double expected = intensity_cd / (0.6 * 0.3 * std::cos(gamma));
    for (std::size_t b = 0; b < kBands; ++b)
        EXPECT_NEAR(luminance[b], luminaire.factor[b] * expected, 1e-9 * expected);
    EXPECT_EQ(emitter_of(scene).luminance_cd_m2(-luminaire.nadir), Rgb{});
}

/// Particles leave with the directions of the file, from points that these directions see, evenly by
/// projected area: the mean of the points' offsets across the direction is 0.
TEST(LuminousOpening, EmitsWhatDirectionsSee) {
    constexpr std::uint64_t kParticles = 20'000;
    for (const Case& c : cases()) {
        const Scene scene = scene_of(c);
        const LuminousOpening& light = light_of(scene);
        const Bounds bounds = bounds_of(scene.object(light.object).shape);
        const PhotometricSolid& solid = scene.solid(light.luminaire.solid);
        double moment = 0, exact_moment = 0, share = 0;
        Vec3 across;
        for (std::uint64_t i = 0; i < kParticles; ++i) {
            math::SampleStream stream(math::RandomKey{}, i);
            const Emission particle = emitter_of(scene).emit(stream);
            const Vec3 direction = particle.direction;
            share += particle.share.luminance() / kParticles;
            moment += dot(direction, light.luminaire.nadir) / kParticles;
            if (!(particle.share.luminance() > 0)) continue;
            const Vec3 offset = particle.origin - bounds.middle();
            across += (offset - dot(offset, direction) * direction) / kParticles;
        }
        for (std::uint64_t i = 0; i < kParticles; ++i) {
            math::SampleStream own(math::RandomKey{}.derived(1), i);
            const auto [u1, u2] = own.next_two();
            exact_moment += solid.sample_direction(u1, u2).z / kParticles;
        }
        EXPECT_NEAR(share, 1, kMostHiddenShare) << c.name;
        EXPECT_NEAR(moment, exact_moment, 2e-3) << c.name;
        // Five standard errors of independent points at most.
        EXPECT_LT(length(across), 5 * length(bounds.max - bounds.min) / 2 / std::sqrt(kParticles)) << c.name;
    }
}

/// The illuminance by a flat part of an opening, cut into small pieces that send I(w) max(0, n w) dA / A(w).
struct Piece {
    Vec3 position, normal;
    double area_m2 = 0;
};

std::vector<Piece> pieces_of(const Rectangle& face, int each) {
    std::vector<Piece> pieces;
    const Vec3 across = cross(face.edge_u, face.edge_v);
    for (int i = 0; i < each; ++i) {
        for (int j = 0; j < each; ++j) {
            const double s = (i + 0.5) / each, t = (j + 0.5) / each;
            pieces.push_back({face.corner + s * face.edge_u + t * face.edge_v, normalized(across),
                              length(across) / (each * each)});
        }
    }
    return pieces;
}

/// Rings and sectors of equal area.
std::vector<Piece> pieces_of(const Disk& disk, int each) {
    std::vector<Piece> pieces;
    const Frame frame = Frame::around(disk.normal);
    for (int i = 0; i < each; ++i) {
        for (int j = 0; j < each; ++j) {
            const double r = disk.radius * std::sqrt((i + 0.5) / each), angle = 2 * kPi * (j + 0.5) / each;
            pieces.push_back({disk.center + r * (std::cos(angle) * frame.u + std::sin(angle) * frame.v),
                              disk.normal, kPi * disk.radius * disk.radius / (each * each)});
        }
    }
    return pieces;
}

/// The flat parts as one piece each.
std::vector<Piece> faces_of(const std::vector<Piece>& pieces) {
    std::vector<Piece> faces;
    for (const Piece& piece : pieces) {
        if (faces.empty() || !(faces.back().normal == piece.normal)) faces.push_back({{}, piece.normal, 0});
        faces.back().area_m2 += piece.area_m2;
    }
    return faces;
}

double brute_force_lx(const std::vector<Piece>& pieces, const Luminaire& luminaire,
                      const PhotometricSolid& solid, const Vec3& at, const Vec3& normal) {
    const std::vector<Piece> faces = faces_of(pieces);
    double sum = 0;
    for (const Piece& piece : pieces) {
        const Vec3 towards = at - piece.position;
        const Vec3 direction = normalized(towards);
        const double facing = dot(piece.normal, direction), cosine = -dot(normal, direction);
        if (facing <= 0 || cosine <= 0) continue;
        double projected_m2 = 0;
        for (const Piece& other : faces)
            projected_m2 += other.area_m2 * std::max(dot(other.normal, direction), 0.0);
        const double share = facing * piece.area_m2 / projected_m2;
        sum += share * solid.intensity_cd(luminaire.in_solid(direction)) * cosine / squared_length(towards);
    }
    return luminaire.factor.luminance() * sum;
}

/// On the axis and at 60 degrees from it, from a fifth of the opening to five openings away, facing it.
TEST(LuminousOpening, HasTheNearFieldOfThousandsOfPoints) {
    constexpr std::uint64_t kSamples = 1 << 16;
    for (const Case& c : {cases()[0], cases()[4], cases()[3]}) {
        const Scene scene = scene_of(c);
        const LuminousOpening& light = light_of(scene);
        const PhotometricSolid& solid = scene.solid(light.luminaire.solid);
        const Shape& shape = scene.object(light.object).shape;
        std::vector<Piece> pieces;
        if (const auto* rectangle = std::get_if<Rectangle>(&shape)) pieces = pieces_of(*rectangle, 60);
        if (const auto* disk = std::get_if<Disk>(&shape)) pieces = pieces_of(*disk, 60);
        if (const auto* box = std::get_if<Mesh>(&shape)) {
            for (std::size_t face = 0; face < 6; ++face) {
                const Vec3* v = &box->vertices[4 * face];
                std::vector<Piece> own = pieces_of(Rectangle{v[0], v[1] - v[0], v[3] - v[0]}, 200);
                const Vec3 outward = own[0].position - light.luminaire.position;
                for (Piece& piece : own) {
                    if (dot(piece.normal, outward) < 0) piece.normal = -piece.normal;
                }
                pieces.insert(pieces.end(), own.begin(), own.end());
            }
        }
        const OpeningEmitter emitter = emitter_of(scene);
        const double size_m = 0.4;
        for (const double openings : {0.2, 0.5, 1.0, 2.0, 5.0}) {
            for (const double angle_deg : {0.0, 60.0}) {
                const Vec3 away = direction_of(light.luminaire, 0.4, angle_deg * kPi / 180);
                const double beyond_m = c.name == "box" ? 0.15 : 0;
                const Vec3 at = light.luminaire.position + (openings * size_m + beyond_m) * away;
                double sum = 0;
                for (std::uint64_t i = 0; i < kSamples; ++i) {
                    math::SampleStream stream(math::RandomKey{}, i);
                    const auto incident = emitter.sample_incident({at, -away}, stream.next_two());
                    if (!incident) continue;
                    sum += std::max(-dot(away, incident->direction), 0.0) *
                           incident->normal_illuminance_lx.luminance() / kSamples;
                }
                const double exact = brute_force_lx(pieces, light.luminaire, solid, at, -away);
                EXPECT_NEAR(sum / exact, 1, 2e-3)
                    << c.name << ", " << openings << " openings, " << angle_deg << " degrees";
            }
        }
    }
}

/// The signs of LM-63.
TEST(Opening, IsReadFromSignedExtents) {
    EXPECT_TRUE(Opening::of_signed({0, 0, 0}).is_point());
    EXPECT_EQ(Opening::of_signed({0.6, 0.3, 0}).form, Form::box);
    EXPECT_EQ(Opening::of_signed({0.6, 0.3, 0.1}).form, Form::box);
    EXPECT_EQ(Opening::of_signed({-0.3, -0.3, 0}).form, Form::vertical_cylinder);
    EXPECT_EQ(Opening::of_signed({-0.3, -0.3, 0.2}).form, Form::vertical_cylinder);
    EXPECT_EQ(Opening::of_signed({-0.3, -0.3, -0.3}).form, Form::ball);
    EXPECT_EQ(Opening::of_signed({1.2, -0.03, -0.03}).form, Form::cylinder_along_c0);
    EXPECT_EQ(Opening::of_signed({-0.03, 1.2, -0.03}).form, Form::cylinder_along_c90);
}

/// Areas of prisms are those of the bodies that they stand for, and all fronts are outside.
TEST(Opening, HasItsAreaAndItsFrontsOutside) {
    const auto area_of = [](const Opening& opening) {
        const Scene scene = scene_of({"", opening, 180});
        return area_m2(scene.object(light_of(scene).object).shape);
    };
    EXPECT_NEAR(area_of({Form::box, {0.4, 0.3, 0.2}}), 2 * (0.12 + 0.08 + 0.06), 1e-12);
    EXPECT_NEAR(area_of({Form::ball, {0.2, 0.2, 0.2}}), 4 * kPi * 0.01, 1e-12);
    EXPECT_NEAR(area_of({Form::vertical_cylinder, {0.4, 0.4, 0.2}}), kPi * 0.4 * (0.2 + 0.2), 4e-3);
    // A tube's side is seen as wide as it is, in the mean; its ends are polygons of the same perimeter.
    const double ends_m2 = 2 * kPi * 0.1 * kPi * 0.1 / (64 * std::tan(kPi / 16));
    EXPECT_NEAR(area_of({Form::cylinder_along_c0, {1.2, 0.1, 0.1}}), kPi * 0.1 * 1.2 + ends_m2, 1e-12);
    for (const Case& c : cases()) {
        const Scene scene = scene_of(c);
        const Shape& shape = scene.object(light_of(scene).object).shape;
        const EmitterSurface surface(shape, scene::lift_of(scene));
        if (c.last_deg < 180) continue;  // flat: the middle is in their plane
        for (std::uint32_t i = 0; i < 64; ++i) {
            const auto point = surface.sample_by_area({(i + 0.5) / 64, math::sobol(i, 0) * 0x1p-32});
            EXPECT_GT(dot(point.normal, point.lifted - bounds_of(shape).middle()), 0) << c.name;
        }
    }
}

/// Nothing is lost where a flat opening sends a little of its light to its back.
TEST(Opening, OfOneSideKeepsTheFlux) {
    PhotometricSolid::Grid grid;
    grid.planes_deg = {0};
    grid.polar_deg = {0, 90, 90.4, 180};
    grid.intensity_cd = {100, 10, 0, 0};
    const PhotometricSolid solid(grid);
    Scene scene;
    add_opening(scene, {}, solid, {Form::box, {1, 1, 0}});
    EXPECT_TRUE(std::holds_alternative<Rectangle>(scene.objects[0].shape));
    double flux = 0;
    constexpr std::uint64_t kParticles = 100'000;
    for (std::uint64_t i = 0; i < kParticles; ++i) {
        math::SampleStream stream(math::RandomKey{}, i);
        flux += emitter_of(scene).emit(stream).share.luminance() *
                light_of(scene).luminaire.factor.luminance() / kParticles;
    }
    EXPECT_NEAR(flux, 1, 3e-4);  // without the share that is hidden it were 9e-4 less
}

}  // namespace
}  // namespace stilb::lights
