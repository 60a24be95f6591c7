#include "agreement/scenes.h"

#include "materials/black.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/frosted.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "materials/thin_dielectric.h"
#include "materials/translucent.h"
#include "materials/ward.h"
#include "support/harmonic_shapes.h"
#include "support/scene_builder.h"

namespace stilb {
namespace {

constexpr Box kRoom{{0, 0, 0}, {4, 3, 2.8}};
constexpr Vec3 kDown{0, 0, -1};
const Rgb kWhite = Rgb::grey(1);

Rgb rgb(double red, double green, double blue) { return {{red, green, blue}}; }

Material phong(double diffuse_part, double specular_part, double exponent) {
    return Phong{Rgb::grey(diffuse_part), Rgb::grey(specular_part), exponent};
}

Material mirror(double reflectance) { return Mirror{Rgb::grey(reflectance)}; }

/// Shines down from under the ceiling; large, where cosine-distributed rays must find it in mirrors.
Rectangle large_panel() { return {{0.8, 0.5, 2.6}, {0, 2, 0}, {2.4, 0, 0}}; }

Rectangle ceiling_panel() { return {{1.5, 1, 2.6}, {0, 0.8, 0}, {0.6, 0, 0}}; }

/// Four unequal C planes, the first repeated as the last; nothing beyond `last_deg` from the nadir.
PhotometricSolid luminaire(double last_deg) {
    PhotometricSolid::Grid grid;
    grid.planes_deg = {0, 90, 180, 270, 360};
    grid.polar_deg = {0, last_deg / 2, last_deg, last_deg + 1, 180};
    grid.intensity_cd = {300, 200, 150, 0,   0,  300, 350, 90,  0,   0,   300, 100, 50,
                         0,   0,   300, 250, 20, 0,   0,   300, 200, 150, 0,   0};
    return PhotometricSolid(grid);
}

Scene coloured_box() {
    Scene scene;
    const auto wall_of = [](double r, double g, double b) -> Material { return Diffuse{rgb(r, g, b)}; };
    add_walls(scene, kRoom,
              {wall_of(0.9, 0.1, 0.05), wall_of(0.1, 0.7, 0.1), wall_of(0.7, 0.7, 0.7),
               wall_of(0.05, 0.2, 0.9), wall_of(0.4, 0.3, 0.2), wall_of(0.85, 0.85, 0.8)});
    add_area_light(scene, ceiling_panel(), rgb(300, 200, 80));
    add_point_light(scene, {3.2, 0.8, 1.5}, rgb(5, 15, 60));
    return scene;
}

Scene parallel_planes() {
    Scene scene;
    add_object(scene, Rectangle{{-10, -10, 0}, {20, 0, 0}, {0, 20, 0}}, diffuse(0.5));
    add_object(scene, Rectangle{{-10, -10, 1.5}, {0, 20, 0}, {20, 0, 0}}, diffuse(0.8));
    add_point_light(scene, {0, 0, 0.6}, 100 * kWhite);
    return scene;
}

Scene bright_box() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.8));
    add_area_light(scene, ceiling_panel(), 500 * kWhite);
    return scene;
}

Scene glossy_box(const Material& gloss) {
    Scene scene;
    const Material matt = diffuse(0.5);
    add_walls(scene, kRoom, {gloss, matt, gloss, matt, gloss, matt});
    add_area_light(scene, Sphere{{1.7, 1.8, 1.9}, 0.25}, 500 * kWhite);
    return scene;
}
Scene broad_phong_box() { return glossy_box(phong(0.4, 0.3, 5)); }
Scene narrow_phong_box() { return glossy_box(phong(0.4, 0.3, 200)); }
Scene rough_box() { return glossy_box(RoughConductor({rgb(0.8, 0.7, 0.5), 0.3})); }

Scene ward_box() { return glossy_box(Ward({rgb(0.5, 0.4, 0.3), rgb(0.3, 0.4, 0.2), {0.1, 0.4}, 30})); }
Scene plastic_box() { return glossy_box(Plastic({rgb(0.7, 0.6, 0.4), 1.5, 0.2})); }

Scene mirror_and_panel() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_object(scene, Rectangle{{0.02, 1, 1}, {0, 1, 0}, {0, 0, 0.7}}, mirror(0.9));
    add_object(scene, Rectangle{{2.5, 2.98, 0.8}, {0, 0, 0.6}, {0.8, 0, 0}}, mirror(0.7));
    add_area_light(scene, large_panel(), 500 * kWhite, diffuse(0.5));
    return scene;
}

/// The luminaire's light stays below the mirror, which hangs above 1.6 m.
Scene mirror_above_the_light() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_object(scene, Rectangle{{0.05, 0.2, 1.6}, {0, 2.6, 0}, {0, 0, 1}}, mirror(0.9));
    add_luminaire(scene, {2, 1.5, 2.5}, luminaire(45), kDown, 30, kWhite);
    return scene;
}

Scene mirror_and_point_light() {
    Scene scene;
    const Material matt = diffuse(0.6);
    add_walls(scene, kRoom, {mirror(0.9), matt, matt, matt, matt, matt});
    add_point_light(scene, {1, 1.2, 2}, 100 * kWhite);
    return scene;
}

Scene rooms_with_slit() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.5}}, diffuse(0.7));
    add_object(scene, Rectangle{{2, 0, 0}, {0, 1.2, 0}, {0, 0, 2.5}}, diffuse(0.7));
    add_object(scene, Rectangle{{2, 1.5, 0}, {0, 1.5, 0}, {0, 0, 2.5}}, diffuse(0.7));
    add_point_light(scene, {1, 1, 1.8}, 200 * kWhite);
    return scene;
}

Scene sphere_light_at_wall() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_area_light(scene, Sphere{{0.3, 1.5, 2}, 0.2}, 900 * kWhite, diffuse(0.3));
    return scene;
}

Scene mesh_light() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_area_light(scene, icosphere({{2, 1.2, 2}, 0.3}, 0), 400 * kWhite, diffuse(0.4));
    return scene;
}

Scene flat_lights() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_area_light(scene, Disk{{1, 1, 2.7}, normalized(Vec3{0.3, 0.1, -1}), 0.3}, 700 * kWhite);
    add_area_light(scene, Box{{2.8, 1.8, 1.6}, {3.2, 2.2, 1.7}}, 200 * kWhite);
    return scene;
}

Scene photometry_luminaires() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_luminaire(scene, {1.2, 1, 2.8}, luminaire(80), kDown, 20, kWhite);
    add_luminaire(scene, {3.9, 2, 1.8}, luminaire(60), normalized(Vec3{-1, -0.4, 0.5}), 70, 0.5 * kWhite);
    return scene;
}

/// A panel in the plane of the ceiling, a tilted box that shines all around, a ball and a plate.
Scene luminous_openings() {
    using Form = lights::Opening::Form;
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_opening(scene, {1.2, 1, 2.8}, luminaire(80), {Form::box, {0.6, 0.3, 0}}, kDown, 20);
    add_opening(scene, {3.2, 2, 1.8}, luminaire(150), {Form::box, {0.3, 0.2, 0.1}},
                normalized(Vec3{-1, -0.4, 0.5}), 70, 0.5 * kWhite);
    add_opening(scene, {0.4, 0.5, 1.9}, luminaire(120), {Form::ball, {0.2, 0.2, 0.2}}, kDown, 0,
                0.3 * kWhite);
    add_opening(scene, {2.6, 0.6, 2.2}, luminaire(140), {Form::vertical_cylinder, {0.4, 0.4, 0}}, kDown, 0,
                rgb(0.5, 0.4, 0.2));
    return scene;
}

Scene black_objects() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.75));
    add_object(scene, Box{{1, 0.8, 0}, {1.6, 1.5, 1.2}}, Black{});
    add_object(scene, Sphere{{2.8, 1.2, 1.4}, 0.35}, Black{});
    add_object(scene, Disk{{2, 2, 2}, kUp, 0.4}, Black{});
    add_point_light(scene, {2, 1.4, 2.4}, 150 * kWhite);
    return scene;
}

Scene many_lights() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    for (int i = 0; i < 12; ++i) {
        const double x = 0.5 + 0.25 * i;
        add_point_light(scene, {x, 0.6 + 0.15 * i, 2.5 - 0.05 * i}, (3 + 2 * i) * kWhite);
        if (i % 4 == 0) add_area_light(scene, Sphere{{x, 2.5, 2.4}, 0.1}, 100 * (i + 1) * kWhite);
    }
    return scene;
}

/// A bright ball, 5 cm above a glossy table.
Scene sphere_over_gloss(const Material& gloss) {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.5));
    add_object(scene, Box{{1, 1, 0.6}, {2.2, 1.8, 0.75}}, gloss);
    add_area_light(scene, Sphere{{1.6, 1.4, 0.82}, 0.02}, 20000 * kWhite, diffuse(0.3));
    return scene;
}
Scene sphere_over_phong() { return sphere_over_gloss(phong(0.3, 0.4, 100)); }
Scene sphere_over_smooth_metal() { return sphere_over_gloss(RoughConductor({rgb(0.9, 0.7, 0.5), 0.1})); }
Scene sphere_over_plastic() { return sphere_over_gloss(Plastic({rgb(0.5, 0.3, 0.2), 1.5, 0.15})); }

/// A pane divides the room, a glass ball lies on a table.
Scene room_with_glass() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_object(scene, Rectangle{{2, 0, 0}, {0, 3, 0}, {0, 0, 2.8}},
               ThinDielectric{1.52, {{0.96, 0.95, 0.9}}});
    add_object(scene, Sphere{{1.2, 2, 0.9}, 0.3}, Dielectric{1.5});
    add_area_light(scene, large_panel(), 500 * kWhite, diffuse(0.5));
    return scene;
}

/// A ball of light on the other side of two panes, one close behind the other, that stand askew.
Scene lamp_behind_panes() {
    Scene scene;
    const Material gloss = phong(0.3, 0.4, 20), matt = diffuse(0.6);
    add_walls(scene, kRoom, {matt, matt, gloss, matt, matt, matt});
    const ThinDielectric pane{1.52, {{0.96, 0.9, 0.8}}};
    add_object(scene, Rectangle{{2, 0, 0}, {0.3, 3, 0}, {0, 0, 2.8}}, pane);
    add_object(scene, Rectangle{{2.02, 0, 0}, {0.3, 3, 0}, {0, 0, 2.8}}, pane);
    add_area_light(scene, Sphere{{1, 1.2, 2.2}, 0.25}, 500 * kWhite, diffuse(0.3));
    return scene;
}

/// A pane that reflects light of a point source: only light paths can find it.
Scene room_with_glass_and_point_light() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_object(scene, Rectangle{{2, 0, 1.2}, {0, 3, 0}, {0, 0, 1.6}}, ThinDielectric{1.52, Rgb::grey(0.96)});
    add_point_light(scene, {1, 1.2, 2.2}, 100 * kWhite);
    return scene;
}

/// A lumpy body of about `radius_m` by harmonics.
Harmonics body(const Vec3& center, double radius_m, int degree, std::uint64_t seed) {
    Harmonics harmonics(rough_surface(degree, seed));
    harmonics.center = center;
    harmonics.scale = radius_m;
    return harmonics;
}

std::array<Harmonics, 3> three_bodies() {
    return {body({1, 1, 0.5}, 0.35, 6, 1), body({3.2, 1, 0.6}, 0.4, 10, 2), body({2, 2.4, 1.1}, 0.4, 8, 3)};
}

Scene room_with_bodies(const std::array<Shape, 3>& shapes) {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_object(scene, shapes[0], Diffuse{rgb(0.8, 0.5, 0.3)});
    add_object(scene, shapes[1], phong(0.3, 0.4, 20));
    add_object(scene, shapes[2], mirror(0.9));
    add_area_light(scene, large_panel(), 500 * kWhite, diffuse(0.5));
    return scene;
}
Scene harmonic_bodies() {
    const auto [a, b, c] = three_bodies();
    return room_with_bodies({a, b, c});
}
Scene harmonic_bodies_as_meshes() {
    const auto [a, b, c] = three_bodies();
    return room_with_bodies({fine_mesh(a), fine_mesh(b), fine_mesh(c)});
}

Harmonics lamp() { return body({2.2, 1.4, 2}, 0.25, 7, 4); }
Scene room_with_lamp(const Shape& shape) {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_area_light(scene, shape, 400 * kWhite, diffuse(0.4));
    return scene;
}
Scene harmonic_lamp() { return room_with_lamp(lamp()); }
Scene harmonic_lamp_as_mesh() { return room_with_lamp(fine_mesh(lamp())); }

/// Coarse meshes that are to look round: of 80 triangles, whose vertex normals lean by up to 20 degrees.
Scene room_with_smooth_meshes(const std::array<Material, 3>& materials) {
    constexpr std::array<Sphere, 3> balls{Sphere{{1, 1, 0.5}, 0.35}, Sphere{{3.2, 1, 0.6}, 0.4},
                                          Sphere{{2, 2.4, 1.1}, 0.4}};
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    for (std::size_t i = 0; i < balls.size(); ++i)
        add_object(scene, smooth_icosphere(balls[i], 1), materials[i]);
    add_area_light(scene, large_panel(), 500 * kWhite, diffuse(0.5));
    return scene;
}
Scene smooth_meshes() {
    return room_with_smooth_meshes(
        {Diffuse{rgb(0.8, 0.5, 0.3)}, phong(0.3, 0.4, 20), RoughConductor({rgb(0.9, 0.7, 0.5), 0.4})});
}
Scene smooth_specular_meshes() {
    return room_with_smooth_meshes({Dielectric{1.5}, mirror(0.9), Diffuse{rgb(0.8, 0.5, 0.3)}});
}

/// Everything at once, for paths of few reflections.
Scene mixed_room() {
    Scene scene;
    const Material gloss = phong(0.3, 0.4, 20), matt = diffuse(0.6);
    add_walls(scene, kRoom, {mirror(0.9), matt, gloss, matt, matt, gloss});
    add_area_light(scene, large_panel(), 500 * kWhite, diffuse(0.5));
    return scene;
}

/// Walls and a shade that differ on their backs.
Scene different_sides() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_area_light(scene, Rectangle{{0.5, 1, 2.79}, {0, 0.6, 0}, {0.6, 0, 0}}, 500 * kWhite);
    add_object(scene, Rectangle{{1.6, 0, 0.2}, {0, 2.2, 0}, {0.2, 0, 2}}, phong(0.3, 0.3, 10));
    const MaterialId back = add_material(scene, materials::Diffuse{{{0.1, 0.8, 0.3}}});
    scene.materials[index_of(scene.objects.back().materials[0])].back = back;
    add_object(scene, Rectangle{{2.8, 1.8, 1.5}, {0.4, 0, 0}, {0, 0.5, 0.1}},
               materials::Translucent({Rgb::grey(0.1), Rgb::grey(0.45), {}}));
    const MaterialId bright =
        add_material(scene, materials::Translucent({Rgb::grey(0.5), Rgb::grey(0.45), {}}));
    scene.materials[index_of(scene.objects.back().materials[0])].back = bright;
    add_point_light(scene, {2.95, 1.95, 1.7}, 60 * kWhite);
    return scene;
}

/// A sheet that divides a part of the room, and a shade around a lamp.
Scene translucent_things() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_area_light(scene, Rectangle{{0.5, 1, 2.79}, {0, 0.6, 0}, {0.6, 0, 0}}, 500 * kWhite);
    add_object(scene, Rectangle{{1.6, 0, 0.2}, {0, 2.2, 0}, {0.2, 0, 2}},
               materials::Translucent({{{0.3, 0.4, 0.2}}, {{0.4, 0.3, 0.5}}, Rgb::grey(0.1)}));
    add_object(scene, Box{{2.8, 1.8, 1.5}, {3.1, 2.1, 1.9}},
               materials::Translucent({Rgb::grey(0.5), Rgb::grey(0.45), {}}));
    add_point_light(scene, {2.95, 1.95, 1.7}, 60 * kWhite);
    return scene;
}

/// A frosted sheet before a lamp, and a frosted block on a table of the same height as the measured points.
Scene frosted_things() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    add_area_light(scene, Rectangle{{0.5, 1, 2.79}, {0, 0.6, 0}, {0.6, 0, 0}}, 500 * kWhite);
    add_object(scene, Rectangle{{0.2, 0.7, 2.4}, {0, 1.2, 0}, {1.2, 0, 0}},
               materials::Frosted({1.5, 0.3, true}));
    add_object(scene, Box{{2.6, 1.7, 0.6}, {3.1, 2.2, 1.1}}, materials::Frosted({1.5, 0.4}));
    return scene;
}

/// The wall towards -y has a window, 3.4 m wide and 2 m high.
void add_room_with_window(Scene& scene, const Material& matt, const Material& floor) {
    const auto add_part = [&](double x, double z, double width, double height) {
        add_object(scene, Rectangle{{x, 0, z}, {0, 0, height}, {width, 0, 0}}, matt);
    };
    for (const auto& [axis, side] :
         {std::pair{0u, Side::low}, {0u, Side::high}, {1u, Side::high}, {2u, Side::high}})
        add_object(scene, wall(kRoom, axis, side), matt);
    add_object(scene, wall(kRoom, 2, Side::low), floor);
    add_part(0, 0, 0.3, 2.8), add_part(3.7, 0, 0.3, 2.8), add_part(0.3, 0, 3.4, 0.6);
    add_part(0.3, 2.6, 3.4, 0.2);
}

Scene room_with_window() {
    Scene scene;
    add_room_with_window(scene, diffuse(0.6), diffuse(0.6));
    add_environment(scene, rgb(80, 100, 140));
    return scene;
}

/// The sun shines in, a mirror shows the window, and a lamp is on.
Scene room_under_sky() {
    Scene scene;
    add_room_with_window(scene, diffuse(0.6), phong(0.3, 0.4, 20));
    add_object(scene, Rectangle{{0.5, 2.98, 1}, {0, 0, 1}, {1.5, 0, 0}}, mirror(0.9));
    add_area_light(scene, Sphere{{3, 2.2, 2.2}, 0.15}, 300 * kWhite, diffuse(0.5));
    add_sky(scene);
    return scene;
}

Scene room_with_glazing() {
    Scene scene;
    add_room_with_window(scene, diffuse(0.6), diffuse(0.4));
    add_object(scene, Rectangle{{0.3, 0.05, 0.6}, {0, 0, 2}, {3.4, 0, 0}},
               ThinDielectric{1.52, {{0.95, 0.96, 0.9}}});
    add_sky(scene, {0.2, 0.1, 1}, 20);
    return scene;
}

/// Glossy, white and mirror things on a ground of 8 m x 6 m, with nothing around.
Scene outdoors() {
    Scene scene;
    add_object(scene, Rectangle{{-2, -1.5, 0}, {8, 0, 0}, {0, 6, 0}}, diffuse(0.3));
    add_object(scene, Box{{1, 0.8, 0}, {1.6, 1.5, 1.2}}, phong(0.3, 0.4, 20));
    add_object(scene, Sphere{{2.8, 1.8, 0.5}, 0.4}, mirror(0.9));
    add_object(scene, Box{{3, 0.4, 0}, {3.6, 1, 0.6}}, RoughConductor({rgb(0.8, 0.7, 0.5), 0.3}));
    add_sky(scene);
    return scene;
}

/// From one place to the surroundings of several.
std::vector<Measurand> fan_of_sights(const Vec3& from, const std::vector<Vec3>& targets) {
    std::vector<Measurand> sights;
    for (const Vec3& target : targets) {
        for (int x = -4; x <= 4; ++x) {
            for (int z = -4; z <= 4; ++z) {
                const Vec3 to = target + Vec3{0.06 * x, 0.02 * x, 0.06 * z};
                sights.emplace_back(LineOfSight{from, normalized(to - from)});
            }
        }
    }
    return sights;
}

}  // namespace

std::span<const MeshTwin> mesh_twins() {
    static const std::vector<MeshTwin> twins{
        {"HarmonicBodies", harmonic_bodies_as_meshes,
         fan_of_sights({2, 0.6, 1.2}, {{1, 1, 0.5}, {3.2, 1, 0.6}, {2, 2.4, 1.1}})},
        {"HarmonicLamp", harmonic_lamp_as_mesh, fan_of_sights({1, 0.5, 1}, {{2.2, 1.4, 2}, {2, 2, 0}})}};
    return twins;
}

Scene closed_box() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.7));
    add_point_light(scene, {1.3, 1.1, 2}, 100 * kWhite);
    return scene;
}

std::vector<Sensor> AgreementScene::sensors() const {
    std::vector<Sensor> all;
    if (!points.empty()) all.push_back({"points", IlluminancePoints{points}});
    if (!sights.empty()) all.push_back({"sights", Luminance{sights}});
    all.insert(all.end(), bodies.begin(), bodies.end());
    return all;
}

std::span<const AgreementScene> agreement_scenes() {
    using enum Demand;
    // Away from walls, so that plain local estimation has finite variance.
    static const std::vector<MeasuringPoint> inside{{{2, 1.5, 0.8}, kUp},
                                                    {{3, 2.2, 0.8}, kUp},
                                                    {{0.7, 2.3, 1.2}, normalized(Vec3{1, -1, 0.5})},
                                                    {{2.6, 0.9, 1.4}, normalized(Vec3{-1, 0.5, 0.2})}};
    static const std::vector<MeasuringPoint> between_planes{
        {{0, 0, 0}, kUp}, {{1, 0.5, 0}, kUp}, {{0.3, 1, 1.5}, kDown}, {{-3, 0, 0.7}, {1, 0, 0}}};
    // Nearer to walls, where much of the light is gathered.
    static const std::vector<MeasuringPoint> near_walls{{{3.7, 1.5, 1}, kUp}, {{3.5, 2.7, 1}, kUp}};
    static const std::vector<MeasuringPoint> corners{{{0.005, 0.005, 0.005}, kUp},
                                                     {{3.995, 1.5, 0}, kUp},
                                                     {{0, 2.995, 2.795}, {1, 0, 0}},
                                                     {{2, 1.5, 0.005}, kDown}};
    static const std::vector<MeasuringPoint> both_rooms{{{1, 1, 0.7}, kUp},
                                                        {{2.8, 1.35, 1}, {-1, 0, 0}},
                                                        {{2.6, 1.9, 1}, normalized(Vec3{-1, -1, 0})},
                                                        {{1.4, 2, 1.2}, {1, 0, 0}}};
    // Onto the floor and walls; the last two leave the floor.
    static const std::vector<Measurand> around{
        LineOfSight{{2, 1.5, 1.2}, normalized(Vec3{1, 0.4, -1})},
        LineOfSight{{2, 1.5, 1.2}, normalized(Vec3{-1, 0.3, 0.1})},
        LineOfSight{{1, 1, 1.6}, normalized(Vec3{0.3, 1, -0.2})},
        EmergentRay{{2.5, 1.2, 0}, kUp, normalized(Vec3{0.5, 0.5, 0.6})},
        EmergentRay{{2.5, 1.2, 0}, kUp, normalized(Vec3{-0.8, 0.2, 0.3})}};
    static const std::vector<Measurand> into_corners{
        LineOfSight{{2, 1.5, 1.2}, normalized(Vec3{1.995, 1.495, -1.195})},
        LineOfSight{{2, 1.5, 1.2}, normalized(Vec3{1.99, 0, -1.2})},
        EmergentRay{{3.9, 1.5, 0}, kUp, normalized(Vec3{-1, 0, 1})}};
    static const std::vector<Measurand> at_the_table{
        EmergentRay{{1.6, 1.4, 0.75}, kUp, normalized(Vec3{0.5, 0.2, 0.7})},
        EmergentRay{{1.7, 1.4, 0.75}, kUp, normalized(Vec3{1, 0, 0.8})},
        LineOfSight{{0.8, 1.4, 0.95}, normalized(Vec3{0.6, 0.02, -0.2})}};
    static const std::vector<Measurand> into_mirrors{
        LineOfSight{{3, 1.5, 1.4}, normalized(Vec3{-1, 0, 0})},
        LineOfSight{{3, 1.8, 1.5}, normalized(Vec3{-1, -0.1, -0.08})},
        LineOfSight{{1.5, 1.6, 1.4}, normalized(Vec3{1.4, 1.4, -0.1})},
        LineOfSight{{2, 1, 1}, normalized(Vec3{0.2, -1, 0.1})}};
    static const std::vector<Measurand> through_glass{
        LineOfSight{{1, 1.2, 1.5}, normalized(Vec3{1, 0.2, -0.2})},
        LineOfSight{{3.2, 1.2, 1.5}, normalized(Vec3{-1, 0.1, -0.5})},
        LineOfSight{{0.3, 2, 1.2}, normalized(Vec3{0.9, 0.05, -0.2})},
        LineOfSight{{1.5, 0.6, 1.5}, normalized(Vec3{0.2, -1, -0.1})}};
    static const std::vector<Measurand> through_the_pane{
        LineOfSight{{3.2, 1.2, 1.9}, normalized(Vec3{-1, 0.1, 0.1})},
        LineOfSight{{3.2, 1.6, 0.4}, normalized(Vec3{0.3, 1, 0.1})},
        LineOfSight{{1, 1.2, 1.5}, normalized(Vec3{-1, 0.2, -0.2})}};
    static const std::vector<Measurand> both_sides_of_the_slit{
        LineOfSight{{1, 1, 1.2}, normalized(Vec3{-1, 0.3, -0.2})},
        LineOfSight{{1, 1.3, 1.2}, normalized(Vec3{1, 0.05, 0})},
        LineOfSight{{2.6, 1.4, 1.2}, normalized(Vec3{-1, -0.05, 0})}};
    static const std::vector<Measurand> at_bodies{
        LineOfSight{{2, 0.6, 1.2}, normalized(Vec3{-1, 0.4, -0.6})},
        LineOfSight{{2, 0.6, 1.2}, normalized(Vec3{1.2, 0.4, -0.5})},
        LineOfSight{{2, 0.6, 1.2}, normalized(Vec3{0, 1.8, 0})}};
    // At walls, out of the window, and at the mirror that shows it.
    static const std::vector<Measurand> about_the_window{
        LineOfSight{{2, 1.5, 1.2}, normalized(Vec3{1, 0.4, -1})},
        LineOfSight{{2, 1.5, 1.2}, normalized(Vec3{0.1, -1, 0.2})},
        LineOfSight{{2.5, 1.2, 1.4}, normalized(Vec3{-0.8, 1.8, 0})},
        EmergentRay{{2.5, 1.2, 0}, kUp, normalized(Vec3{0.2, 0.9, 0.6})}};
    static const std::vector<Measurand> outside{
        LineOfSight{{-1, -1, 1.6}, normalized(Vec3{2.3, 2, -1})},
        LineOfSight{{-1, -1, 1.6}, normalized(Vec3{3.8, 2.8, -1.1})},
        LineOfSight{{2, -1, 1.6}, normalized(Vec3{1.3, 1.7, -1.2})},
        LineOfSight{{2, -1, 1.6}, normalized(Vec3{0, 0.3, 1})},
        EmergentRay{{2.1, 1.1, 0}, kUp, normalized(Vec3{0.2, 0.9, 0.6})}};
    static const std::vector<Vec3> free{{1.1, 2.2, 1.2}, {3.1, 0.6, 1.6}};
    static const std::vector<Sensor> bodies{
        {"cylinders", Cylindrical{free}},
        {"semicylinders", Semicylindrical{free, normalized(Vec3{1, -2, 0})}},
        {"hemispheres", Hemispherical{free, normalized(Vec3{-1, 0.5, 0.2})}},
        {"spheres", Spherical{free}}};
    static const std::vector<Sensor> near_corners{
        {"cylinders", Cylindrical{{{0.005, 0.005, 1.2}, {3.995, 1.5, 0.005}}}},
        {"semicylinders", Semicylindrical{{{0.005, 0.005, 1.2}}, {1, 0, 0}}},
        {"spheres", Spherical{{{2, 2.995, 2.795}}}}};
    static const std::vector<AgreementScene> scenes{
        {"ClosedBox", nothing, {}, closed_box, inside, {}},
        {"ColouredBox", nothing, {}, coloured_box, inside, {}},
        {"ParallelPlanes", nothing, {}, parallel_planes, between_planes, {}},
        {"Corners", finite_variance, {}, bright_box, corners, {}},
        {"BroadPhong", nothing, {}, broad_phong_box, inside, {}},
        {"NarrowPhong", nothing, {}, narrow_phong_box, inside, {}},
        {"MirrorAndPanel", nothing, {}, mirror_and_panel, inside, {}},
        {"MirrorAboveTheLight", nothing, {}, mirror_above_the_light, inside, {}},
        {"MirrorAndPointLight", light_from_mirrors, {}, mirror_and_point_light, near_walls, {}, {}, 2},
        {"RoomsWithSlit", nothing, {}, rooms_with_slit, both_rooms, {}},
        {"SphereLightAtWall", nothing, {}, sphere_light_at_wall, inside, {}},
        {"MeshLight", nothing, {}, mesh_light, inside, {}},
        {"FlatLights", nothing, {}, flat_lights, inside, {}},
        {"PhotometryLuminaires", nothing, {}, photometry_luminaires, inside, {}},
        {"LuminousOpenings", nothing, {}, luminous_openings, inside, {}},
        {"BlackObjects", nothing, {}, black_objects, inside, {}},
        {"ManyLights", nothing, {}, many_lights, inside, {}},
        {"NoReflection", nothing, 0, mixed_room, inside, {}},
        {"OneReflection", nothing, 1, mixed_room, inside, {}},
        {"TwoReflections", nothing, 2, mixed_room, inside, {}},
        {"OnlyDiffuseTwice", nothing, 2, closed_box, inside, {}},
        {"RoughMetal", nothing, {}, rough_box, inside, {}},
        {"Translucent", nothing, {}, translucent_things, inside, {}, {}, 1, 3},
        {"DifferentSides", nothing, {}, different_sides, inside, around, {}, 1, 3},
        {"Frosted", finite_variance, {}, frosted_things, inside, around, {}, 1, 8},
        {"TranslucentTwoReflections", nothing, 2, translucent_things, inside, around, {}, 1, 4},
        {"BrushedWard", nothing, {}, ward_box, inside, {}},
        {"Plastic", nothing, {}, plastic_box, inside, {}},
        {"LuminanceInAClosedBox", nothing, {}, closed_box, inside, around},
        {"LuminanceInColour", nothing, {}, coloured_box, {}, around},
        {"LuminanceBetweenPlanes", nothing, {}, parallel_planes, {}, around},
        {"LuminanceInCorners", finite_variance, {}, bright_box, {}, into_corners},
        {"LuminanceOfBroadPhong", nothing, {}, broad_phong_box, {}, around},
        {"LuminanceOfNarrowPhong", finite_variance, {}, narrow_phong_box, {}, around},
        {"LuminanceOfRoughMetal", nothing, {}, rough_box, {}, around},
        {"LuminanceOfWard", finite_variance, {}, ward_box, {}, around},
        {"LuminanceOfPlastic", nothing, {}, plastic_box, {}, around},
        {"LuminanceOfTranslucent", finite_variance, {}, translucent_things, {}, around, {}, 1, 3},
        {"SphereOverPhong", nothing, {}, sphere_over_phong, {}, at_the_table},
        {"SphereOverSmoothMetal", finite_variance, {}, sphere_over_smooth_metal, {}, at_the_table},
        {"SphereOverPlastic", finite_variance, {}, sphere_over_plastic, {}, at_the_table},
        {"LuminanceInMirrors", nothing, {}, mirror_and_panel, {}, into_mirrors},
        {"LuminanceAndPointLightInMirror", light_from_mirrors, {}, mirror_and_point_light, {}, around},
        {"LuminanceThroughGlass", nothing, {}, room_with_glass, inside, through_glass, {}, 1, 2},
        {"LuminanceThroughAPane",
         light_from_mirrors,
         {},
         room_with_glass_and_point_light,
         {},
         through_the_pane},
        {"LampBehindPanes", nothing, {}, lamp_behind_panes, inside, around, {}, 1, 2.5},
        {"LampBehindPanesOneReflection", nothing, 1, lamp_behind_panes, inside, around},
        {"LuminanceThroughASlit", nothing, {}, rooms_with_slit, {}, both_sides_of_the_slit},
        {"LuminanceUnderLuminaires", nothing, {}, photometry_luminaires, {}, around},
        {"LuminanceUnderOpenings", nothing, {}, luminous_openings, {}, around},
        {"LuminanceOfEmission", nothing, 0, mixed_room, {}, around},
        {"LuminanceOfOneReflection", nothing, 1, mixed_room, inside, around},
        {"LuminanceOfTwoReflections", nothing, 2, mixed_room, inside, around},
        {"LuminanceOfThreeReflections", nothing, 3, mixed_room, inside, around},
        {"HarmonicBodies", nothing, {}, harmonic_bodies, inside, at_bodies},
        {"HarmonicBodiesOneReflection", nothing, 1, harmonic_bodies, inside, at_bodies},
        {"HarmonicLamp", nothing, {}, harmonic_lamp, inside, around},
        {"RoomWithWindow", nothing, {}, room_with_window, inside, about_the_window},
        {"RoomUnderSky", nothing, {}, room_under_sky, inside, about_the_window, {}, 4, 2.5},
        {"RoomUnderSkyTwoReflections", nothing, 2, room_under_sky, inside, about_the_window, {}, 4, 2.5},
        {"RoomWithGlazing", nothing, {}, room_with_glazing, inside, about_the_window},
        {"Outdoors", nothing, {}, outdoors, inside, outside},
        {"BodiesInColour", nothing, {}, coloured_box, {}, {}, bodies},
        {"BodiesNearCorners", finite_variance, {}, bright_box, {}, {}, near_corners},
        {"BodiesBesidePhong", nothing, {}, broad_phong_box, inside, {}, bodies, 4, 2.5},
        {"BodiesAndMirrors", nothing, {}, mirror_and_panel, {}, {}, bodies},
        {"BodiesUnderLuminaires", nothing, {}, photometry_luminaires, {}, {}, bodies},
        {"BodiesUnderOpenings", nothing, {}, luminous_openings, {}, {}, bodies},
        {"BodiesOneReflection", nothing, 1, mixed_room, {}, {}, bodies},
        {"SmoothMeshes", nothing, {}, smooth_meshes, inside, at_bodies},
        {"SmoothMeshesOneReflection", nothing, 1, smooth_meshes, inside, at_bodies},
        {"SmoothSpecularMeshes", nothing, {}, smooth_specular_meshes, inside, at_bodies},
    };
    return scenes;
}

}  // namespace stilb
