// Readings do not depend on what lies elsewhere, nor on where a scene lies: far objects that nothing sees,
// map coordinates, sensors far from a lamp and closer to it than rays can tell.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "exact/configuration_factors.h"
#include "exact/diffuse_cube.h"
#include "materials/black.h"
#include "run/run.h"
#include "scene/overlaps.h"
#include "statistics/hypothesis.h"
#include "statistics/interval.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

/// A room with a table and a panel a centimetre below its ceiling, in one mesh or in several shapes. `wider`:
/// a hall of so many times the length and width.
Scene furnished_room(const Vec3& at, double wider = 1) {
    const double height_m = wider > 1 ? 8 : 2.5, w = wider;
    Scene scene;
    add_object(scene, Box{at, at + Vec3{4 * w, 3 * w, height_m}}, diffuse(0.5));
    add_object(scene, Box{at + Vec3{1, 1, 0.72}, at + Vec3{2.6, 1.8, 0.75}}, diffuse(0.5));
    add_area_light(scene, Rectangle{at + Vec3{1.7, 1.2, height_m - 0.01}, {0, 0.6 * w, 0}, {0.6 * w, 0, 0}},
                   Rgb::grey(3000));
    return scene;
}

std::vector<Sensor> sensors_of_room(const Vec3& at) {
    return {{"points", IlluminancePoints{{{at + Vec3{1.8, 1.4, 0.76}, kUp},
                                          {at + Vec3{1.1, 1.1, 0.751}, kUp},
                                          {at + Vec3{3.5, 2.5, 0}, kUp},
                                          {at + Vec3{1.8, 1.4, 0.01}, kUp}}}},
            {"sight", Luminance{{LineOfSight{at + Vec3{0.5, 0.5, 1.2}, normalized({1.3, 0.9, -0.45})}}}}};
}

std::vector<statistics::Estimate> estimates_of(Scene scene, const std::vector<Sensor>& sensors,
                                               std::string_view method, std::uint64_t paths) {
    scene::put_lamps_in_front(scene);
    RunOptions options;
    options.method = method;
    options.paths = paths;
    std::vector<statistics::Estimate> estimates;
    for (const SensorResult& sensor : measure(scene, sensors, options).sensors) {
        for (const Reading& reading : sensor.readings) estimates.push_back(reading.estimate);
    }
    return estimates;
}

std::vector<double> values_of(const Scene& scene, const std::vector<Sensor>& sensors, std::string_view method,
                              std::uint64_t paths = 4096) {
    std::vector<double> values;
    for (const statistics::Estimate& estimate : estimates_of(scene, sensors, method, paths))
        values.push_back(estimate.value);
    return values;
}

struct FarThing {
    std::string name;
    std::function<void(Scene&)> add;
};

/// Nothing of it is seen from inside the room.
std::vector<FarThing> far_things() {
    const auto object = [](const std::string& name, const Shape& shape) {
        return FarThing{name, [shape](Scene& scene) { add_object(scene, shape, diffuse(0.5)); }};
    };
    const auto ground = [&](const std::string& name, double side_m) {
        return object(name, Rectangle{{-side_m / 2, -side_m / 2, -0.2}, {side_m, 0, 0}, {0, side_m, 0}});
    };
    return {ground("a ground of 65 m", 65),
            ground("a ground of 10 km", 1e4),
            ground("a ground of 1000 km", 1e6),
            object("a triangle at the edge of what is possible",
                   Mesh{{{1e9, 1e9, 1e9}, {1e9 - 1, 1e9, 1e9}, {1e9, 1e9 - 1, 1e9}}, {{0, 1, 2}}}),
            object("a sun", Sphere{{6e4, 0, 8e4}, 500}),
            object("a body of many triangles", icosphere({{3000, 4000, 0}, 20}, 4)),
            {"a lamp",
             [](Scene& scene) {
                 add_point_light(scene, {1e5, 0, 1e5}, Rgb::grey(1e-3));
             }},
            {"three triangles in three places", [&](Scene& scene) {
                 for (const double far : {-5e3, 2e4, 3e6}) {
                     add_object(scene,
                                Mesh{{{far, far, 0}, {far + 1, far, 0}, {far, far + 1, 0}}, {{0, 1, 2}}},
                                diffuse(0.5));
                 }
             }}};
}

/// `has_same_numbers`: both readings are of the same random numbers; else their standard errors count too.
void expect_unchanged(const std::vector<statistics::Estimate>& changed,
                      const std::vector<statistics::Estimate>& alone, bool has_same_numbers,
                      const std::string& what) {
    for (std::size_t i = 0; i < alone.size(); ++i) {
        const double noise = std::hypot(changed[i].standard_error, alone[i].standard_error);
        EXPECT_NEAR(changed[i].value, alone[i].value,
                    0.001 * alone[i].value + (has_same_numbers ? 0 : 4 * noise))
            << what << ": " << i;
    }
}

/// A room, and a hall of 60 m by 45 m.
TEST(FarThings, ChangeNoReadingOfAClosedRoom) {
    for (const double wider : {1.0, 15.0}) {
        for (const std::string method : {"path", "auto", "guided"}) {
            const auto estimates = [&](const Scene& scene) {
                return estimates_of(scene, sensors_of_room({}), method, 2048);
            };
            const auto alone = estimates(furnished_room({}, wider));
            for (const FarThing& thing : far_things()) {
                Scene scene = furnished_room({}, wider);
                thing.add(scene);
                // The numbers of light paths depend on what their rays meet outside of the room.
                const bool has_same_numbers = method != "guided" && scene.lights.size() == 1;
                expect_unchanged(estimates(scene), alone, has_same_numbers,
                                 fmt::format("{}, {} times as wide, {}", method, wider, thing.name));
            }
        }
    }
}

/// Methods on patches, whose rays are spread over all surfaces: at map coordinates, beside things so far away
/// that a grid of rays over all of them would never end, and beside a ground whose patches are much larger
/// than the room.
TEST(FarThings, ChangeNoReadingByPatchesOfAClosedRoom) {
    const auto estimates = [](Scene scene, const Vec3& at, std::string_view method, double patch_m) {
        scene::put_lamps_in_front(scene);
        RunOptions options;
        options.method = method;
        options.paths = method == "particles" ? 1 << 18 : 1024;
        options.patch_m = patch_m;
        options.patches.resolution = 128;
        std::vector<statistics::Estimate> found;
        for (const SensorResult& sensor : measure(scene, sensors_of_room(at), options).sensors) {
            for (const Reading& reading : sensor.readings) found.push_back(reading.estimate);
        }
        return found;
    };
    const Vec3 map{3.5e6, 5.4e6, 120};
    for (const std::string method : {"ray-bundle", "radiosity", "particles"}) {
        const auto alone = estimates(furnished_room({}), {}, method, 1);
        for (const Vec3& far : {Vec3{500, 0, 0}, Vec3{5000, 0, 0}, Vec3{-1e6, 1e5, 0}, Vec3{1e8, 1e8, 1e8}}) {
            Scene scene = furnished_room({});
            add_object(scene, Rectangle{far, {4, 0, 0}, {0, 4, 0}}, diffuse(0.5));
            expect_unchanged(estimates(scene, {}, method, 1), alone, false,
                             fmt::format("{}, {} m", method, length(far)));
        }
        Scene at_map = furnished_room(map);
        add_object(at_map, Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, diffuse(0.5));
        expect_unchanged(estimates(at_map, map, method, 1), alone, false, method + ", at map coordinates");
        Scene on_ground = furnished_room({});
        add_object(on_ground, Rectangle{{-5e5, -5e5, -0.2}, {1e6, 0, 0}, {0, 1e6, 0}}, diffuse(0.5));
        const auto beside = estimates(on_ground, {}, method, 5e4);
        expect_unchanged(beside, estimates(furnished_room({}), {}, method, 5e4), false,
                         method + ", on a ground of 1000 km");
        for (const statistics::Estimate& estimate : beside)
            EXPECT_LT(estimate.standard_error, 0.05 * estimate.value) << method;
    }
}

/// Light paths of the sky start around the whole scene: beside a stray thing a kilometre away hardly one
/// finds a room. A method that finds clearly less light than path tracing is not taken.
TEST(FarThings, LeaveARoomWithAWindowTheLightOfTheSky) {
    const auto room = [](double stray_m) {
        Scene scene;
        add_object(scene, Rectangle{{0, 0, 0}, {5, 0, 0}, {0, 4, 0}}, diffuse(0.6));
        add_object(scene, Rectangle{{0, 0, 0}, {0, 4, 0}, {0, 0, 3}}, diffuse(0.6));
        add_object(scene, Rectangle{{5, 0, 0}, {0, 0, 3}, {0, 4, 0}}, diffuse(0.6));
        add_object(scene, Rectangle{{0, 0, 0}, {0, 0, 1}, {5, 0, 0}}, diffuse(0.6));
        add_object(scene, Rectangle{{0, 4, 0}, {5, 0, 0}, {0, 0, 3}}, diffuse(0.6));
        add_object(scene, Rectangle{{0, 0, 3}, {0, 4, 0}, {5, 0, 0}}, diffuse(0.6));
        if (stray_m > 0)
            add_object(scene, Rectangle{{stray_m, stray_m, 0}, {0.3, 0, 0}, {0, 0.3, 0}}, diffuse(0.6));
        add_environment(scene, Rgb::grey(1000));
        add_point_light(scene, {2, 2, 2.5}, Rgb::grey(100));
        return scene;
    };
    for (const int count : {5, 12}) {
        const Sensor grid{"desk", Grid{{0.2, 0.2, 0.75}, {4.6, 0, 0}, {0, 3.6, 0}, {count, count}}};
        const auto mean = [&](const Scene& scene, std::string_view method) {
            RunOptions options;
            options.method = method;
            options.paths = method == "path" ? 2048 : 8192;
            return measure(scene, {&grid, 1}, options).sensors[0].summary.mean;
        };
        const auto right = mean(room(0), "path");
        for (const double stray_m : {100.0, 1e3, 1e5}) {
            const auto found = mean(room(stray_m), "auto");
            EXPECT_NEAR(found.value, right.value, 4 * std::hypot(found.standard_error, right.standard_error))
                << count << ' ' << stray_m;
            EXPECT_LT(found.standard_error, 0.05 * right.value) << count << ' ' << stray_m;
        }
    }
}

/// A court under the sky, or a room that is open to it above a parapet.
void add_court(Scene& scene, const Vec3& at, bool has_roof) {
    const Vec3 x{5, 0, 0}, y{0, 4, 0}, z{0, 0, 3};
    add_object(scene, Rectangle{at, x, y}, diffuse(0.6));
    add_object(scene, Rectangle{at, y, z}, diffuse(0.6));
    add_object(scene, Rectangle{at + x, z, y}, diffuse(0.6));
    add_object(scene, Rectangle{at + y, x, z}, diffuse(0.6));
    add_object(scene, Rectangle{at, has_roof ? z / 3 : z, x}, diffuse(0.6));
    if (has_roof) add_object(scene, Rectangle{at + z, y, x}, diffuse(0.6));
    add_point_light(scene, at + Vec3{2, 2, 2.5}, Rgb::grey(100));
}

/// The methods by light paths find it themselves: with a lamp beside the sky they lost all reflected light of
/// the sky, and their intervals, those of the lamp's light, had a width of 0.3 %.
TEST(FarThings, LeaveCourtsTheReflectedLightOfTheSky) {
    const std::vector<Vec3> places{{0, 0, 0}, {120, -15, 0}, {-3e3, 40, 7}};
    for (const std::size_t courts : {1, 3}) {
        for (const bool has_roof : {false, true}) {
            Scene scene;
            std::vector<Sensor> sensors;
            for (std::size_t i = 0; i < courts; ++i) {
                add_court(scene, places[i], has_roof);
                sensors.push_back({std::to_string(i),
                                   Grid{places[i] + Vec3{0.4, 0.4, 0.8}, {4.2, 0, 0}, {0, 3.2, 0}, {4, 4}}});
            }
            const auto means_of = [&](const Scene& measured, std::string_view method, std::uint64_t paths) {
                RunOptions options;
                options.method = method;
                options.paths = paths;
                std::vector<statistics::Estimate> means;
                for (const SensorResult& sensor : measure(measured, sensors, options).sensors)
                    means.push_back(sensor.summary.mean);
                return means;
            };
            add_environment(scene, Rgb::grey(1000));
            const auto right = means_of(scene, "path", 4096);
            for (const double stray_m : {10.0, 100.0, 1e3, 1e5}) {
                if (courts > 1 && stray_m < 1e3) continue;
                Scene with_stray = scene;
                add_object(with_stray, Rectangle{{stray_m, stray_m, 0}, {0.3, 0, 0}, {0, 0.3, 0}},
                           diffuse(0.6));
                for (const char* method : {"light-paths", "local"}) {
                    const auto found = means_of(with_stray, method, 1 << 15);
                    for (std::size_t i = 0; i < courts; ++i) {
                        const double error = std::hypot(found[i].standard_error, right[i].standard_error);
                        EXPECT_NEAR(found[i].value, right[i].value, 4 * error)
                            << courts << ' ' << has_roof << ' ' << method << ' ' << stray_m << ' ' << i;
                        EXPECT_LT(error, (has_roof ? 0.1 : 0.04) * right[i].value)
                            << courts << ' ' << has_roof << ' ' << method << ' ' << stray_m << ' ' << i;
                    }
                }
            }
        }
    }
}

/// A wall and a kiosk under a sky, with a globe of light, on grounds of 40 m to 40 km. The kiosk's lower face
/// has hardly any light of the guess, and the ground of the largest scene a billion times as much.
TEST(FarThings, AGuessFindsTheLightOfWallsOnALargeGround) {
    for (const double size_m : {40., 4e3, 4e4}) {
        Scene scene;
        const double half_m = size_m / 2;
        add_object(scene, Rectangle{{-half_m, -half_m, 0}, {size_m, 0, 0}, {0, size_m, 0}}, diffuse(0.1));
        add_object(scene, Box{{-6, 8, 0}, {6, 8.3, 7}}, diffuse(0.35));
        add_object(scene, Box{{-1, 2, 0}, {1, 3, 1}}, diffuse(0.4));
        add_area_light(scene, Sphere{{0, 5, 3}, 0.15}, Rgb::grey(3000));
        add_environment(scene, Rgb::grey(500));
        const std::vector<Sensor> sensors{
            {"yard", IlluminancePoints{{{{-3, 1, 0}, kUp}, {{1.5, 2.5, 0}, kUp}, {{0, 5, 0}, kUp}}}}};
        const auto guided = estimates_of(scene, sensors, "guided", 1024);
        const auto path = estimates_of(scene, sensors, "path", 1 << 16);
        for (std::size_t i = 0; i < path.size(); ++i) {
            EXPECT_LT(std::abs(statistics::z_score(guided[i], path[i])), 4.5) << size_m << " " << i;
            EXPECT_LT(guided[i].standard_error, 0.01 * path[i].value) << size_m << " " << i;
        }
    }
}

TEST(FarThings, ARoomAtMapCoordinatesWithATriangleLeftAtTheOrigin) {
    const Vec3 map{3.5e6, 5.4e6, 120};
    const Mesh stray{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    for (const double wider : {1.0, 15.0}) {
        Scene apart = furnished_room(map, wider), in_one_mesh = apart;
        add_object(apart, stray, diffuse(0.5));
        Mesh& room = std::get<Mesh>(in_one_mesh.objects[0].shape =
                                        triangulated(std::get<Box>(in_one_mesh.objects[0].shape)));
        for (const Vec3& vertex : stray.vertices) room.vertices.push_back(vertex);
        const auto first = static_cast<std::uint32_t>(room.vertices.size() - 3);
        room.triangles.push_back({first, first + 1, first + 2});
        for (const std::string method : {"path", "auto", "guided"}) {
            const auto alone = estimates_of(furnished_room({}, wider), sensors_of_room({}), method, 2048);
            for (const Scene& scene : {apart, in_one_mesh, furnished_room(map, wider)}) {
                expect_unchanged(estimates_of(scene, sensors_of_room(map), method, 2048), alone,
                                 method != "guided", fmt::format("{}, {} times as wide", method, wider));
            }
        }
    }
}

/// Sensors 0.5 m to 1 km from a panel of 0.3 m, in all directions, at once; with nothing else, and beside a
/// body of so many triangles that rays go by a tree.
void expect_light_of_panel(const Scene& others) {
    const Rectangle panel{{-0.05, -0.15, 3}, {0, 0.3, 0}, {0.1, 0, 0}};
    Scene scene = others;
    add_area_light(scene, panel, Rgb::grey(1e4));
    std::vector<MeasuringPoint> points;
    for (const double distance_m : {0.5, 3.0, 31.0, 33.0, 100.0, 1000.0}) {
        for (const double angle : {0.0, 0.5, 2.0, 4.0}) {
            const Vec3 out = normalized({std::cos(angle), std::sin(angle), -0.2 - angle});
            points.push_back({Vec3{0, 0, 3} + distance_m * out, -out});
        }
    }
    for (const std::string_view method : {"path", "auto"}) {
        const auto values = values_of(scene, {point_sensor(points)}, method);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double exact_lx = exact::illuminance_by_rectangle_lx(
                {points[i].position, points[i].normal}, panel.corner, panel.edge_u, panel.edge_v, 1e4);
            EXPECT_NEAR(values[i] / exact_lx, 1, 0.001) << method << ' ' << i;
        }
    }
}

TEST(FarThings, ALampAloneIsAsBrightFromEveryDistance) { expect_light_of_panel({}); }

TEST(FarThings, ALampBesideABodyIsAsBrightFromEveryDistance) {
    for (const double height_m : {4.0, 100.0}) {
        Scene scene;
        add_object(scene, icosphere({{0, 0, height_m}, 0.5}, 2), diffuse(0));
        expect_light_of_panel(scene);
    }
}

/// Below two panels 100 m apart, from a metre to less than rays can tell.
TEST(FarThings, SensorsRightBelowALampAreBelowIt) {
    const Rectangle strip{{0, 0, 1}, {0, 0.002, 0}, {10, 0, 0}}, panel{{100, 0, 1}, {0, 2, 0}, {3, 0, 0}};
    Scene scene;
    add_area_light(scene, strip, Rgb::grey(1e6));
    add_area_light(scene, panel, Rgb::grey(100));
    std::vector<MeasuringPoint> points;
    for (const double below_m : {1.0, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        points.push_back({{0, 0, 1 - below_m}, kUp});
        points.push_back({{5, 0.001, 1 - below_m}, kUp});
        points.push_back({{100, 0, 1 - below_m}, kUp});
        points.push_back({{101, 1, 1 - below_m}, kUp});
    }
    const auto values = values_of(scene, {point_sensor(points)}, "auto", 8192);
    for (std::size_t i = 0; i < points.size(); ++i) {
        double exact_lx = 0;
        for (const auto& [lamp, luminance_cd_m2] : {std::pair(strip, 1e6), std::pair(panel, 100.0)}) {
            exact_lx += exact::illuminance_by_rectangle_lx({points[i].position, kUp}, lamp.corner,
                                                           lamp.edge_u, lamp.edge_v, luminance_cd_m2);
        }
        EXPECT_NEAR(values[i] / exact_lx, 1, 0.001) << i;
    }
    // On its upper side, and exactly in its plane, there is no light.
    const auto above = values_of(
        scene, {point_sensor({{{101, 1, 1}, kUp}, {{101, 1, 1 + 1e-6}, kUp}, {{5, 0.001, 1}, kUp}})}, "path",
        64);
    for (const double lx : above) EXPECT_EQ(lx, 0);
}

// A receiver that is near to the centre of ray queries gets its light from walls that are far from it: from
// halls in which single precision at the walls is coarser than the offset at the centre.

/// The walls of a room that is seen from inside, floor and ceiling with them, as bodies of this thickness;
/// one box where it is 0.
void add_hall(Scene& scene, double half_m, double thickness_m) {
    if (thickness_m == 0) {
        add_object(scene, Box{{-half_m, -half_m, -half_m}, {half_m, half_m, half_m}}, diffuse(0.5));
        return;
    }
    const double middle_m = half_m + thickness_m / 2;
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const Vec3 half = (half_m + thickness_m) * (Vec3{1, 1, 1} - axis) + thickness_m / 2 * axis;
        for (const Vec3& middle : {middle_m * axis, -middle_m * axis})
            add_object(scene, Box{middle - half, middle + half}, diffuse(0.5));
    }
}

struct Hall {
    Scene scene;
    double half_m, flux_lm;

    Hall(double half, double thickness_m) : half_m(half), flux_lm(1e4 * half * half) {
        add_hall(scene, half_m, thickness_m);
        add_point_light(scene, {0, 0, 0}, Rgb::grey(flux_lm / (4 * kPi)));
    }
    /// Illuminances of places on the floor, or as good as there.
    void expect_exact(const std::vector<Sensor>& sensors, const std::vector<Vec3>& places,
                      const std::string& what) const {
        const exact::DiffuseCube cube(2 * half_m, flux_lm);
        for (const std::string_view method : {"path", "light-paths", "local"}) {
            const auto values = values_of(scene, sensors, method, 32768);
            for (std::size_t i = 0; i < places.size(); ++i) {
                const double exact_lx = cube.direct_illuminance_lx(places[i].x, places[i].y) +
                                        cube.indirect_illuminance_lx(0.5, places[i].x, places[i].y);
                EXPECT_NEAR(values[i] / exact_lx, 1, 0.01)
                    << method << ", half side " << half_m << " m, " << what << ", " << i;
            }
        }
    }
};

TEST(FarThings, LargeHallsLoseNoLightOfTheirWalls) {
    for (const double half_m : {30.0, 34.0, 100.0, 300.0, 3000.0}) {
        for (const double thickness_m : {0.0, 0.3}) {
            const std::vector<Vec3> places{{0, 0, -half_m}, {half_m / 2, half_m / 2, -half_m}};
            Hall(half_m, thickness_m)
                .expect_exact({point_sensor({{places[0], kUp}, {places[1], kUp}})}, places,
                              fmt::format("walls of {} m", thickness_m));
        }
    }
}

/// Up to 64 m bundles have one grid of lines, from there on cells.
TEST(FarThings, HallsAreAsBrightByRayBundlesBelowAndAbove64m) {
    for (const double half_m : {31.9, 32.0, 32.1}) {
        const Hall hall(half_m, 0);
        RunOptions options;
        options.method = "ray-bundle";
        options.paths = 1024;
        options.patch_m = 8;
        const Sensor points =
            point_sensor({{{0, 0, -half_m}, kUp}, {{half_m / 2, half_m / 2, -half_m}, kUp}});
        const auto readings = measure(hall.scene, {&points, 1}, options).sensors[0].readings;
        const exact::DiffuseCube cube(2 * half_m, hall.flux_lm);
        for (std::size_t i = 0; i < 2; ++i) {
            const double xy_m = i == 0 ? 0 : half_m / 2;
            const double exact_lx =
                cube.direct_illuminance_lx(xy_m, xy_m) + cube.indirect_illuminance_lx(0.5, xy_m, xy_m);
            EXPECT_NEAR(readings[i].estimate.value, exact_lx,
                        0.01 * exact_lx + 4 * readings[i].estimate.standard_error)
                << half_m << ' ' << i;
            EXPECT_LT(readings[i].estimate.standard_error, 0.01 * exact_lx);
        }
    }
}

/// Most of the measured points see no more than a closet, in which it is dark.
TEST(FarThings, OneReadingOfALargeHallLosesNoLight) {
    Hall hall(300, 0);
    add_object(hall.scene, Box{{10, 10, -300}, {14, 13, -297.5}}, diffuse(0));
    std::vector<Sensor> sensors{point_sensor({{{0, 0, -300}, kUp}})};
    for (int i = 0; i < 17; ++i) sensors.push_back(point_sensor({{{11 + 0.1 * i, 11.5, -300}, kUp}}));
    hall.expect_exact(sensors, {{0, 0, -300}}, "beside a closet");
}

/// Exactly at, right above and clearly above the floor.
TEST(FarThings, ReadingsAboveTheFloorOfALargeHallLoseNoLight) {
    const double half_m = 300;
    const Hall hall(half_m, 0.3);
    std::vector<MeasuringPoint> points;
    std::vector<Vec3> places;
    for (const double above_m : {0.0, 1e-5, 1e-4, 9.99e-4, 1e-3, 1.001e-3, 0.01, 0.8}) {
        places.push_back({0, 0, above_m - half_m});
        points.push_back({places.back(), kUp});
    }
    hall.expect_exact({point_sensor(points)}, places, "above the floor");
}

/// Points in a room of this side: on its floor and above it, from a thousandth of the side to three per cent
/// away from walls, floor and ceiling.
std::vector<MeasuringPoint> points_near_walls(const Vec3& at, double side_m) {
    std::vector<MeasuringPoint> points;
    const auto add = [&](double x, double y, double z) {
        points.push_back({at + side_m * Vec3{x, y, z}, kUp});
    };
    for (const double share : {0.001, 0.003, 0.01, 0.03}) {
        add(share, 0.3, 0), add(share, 0.3, 0.3), add(1 - share, share, share);
        add(0.3, 0.3, share), add(0.3, 0.4, 1 - share);
    }
    return points;
}

/// A black room alone, and beside something of a tenth of the distance at which it lies.
void expect_exact_in_small_rooms(const std::function<void(Scene&, const Vec3&, double)>& add_lamp,
                                 const std::function<double(const MeasuringPoint&)>& exact_lx) {
    for (const double side_m : {0.01, 0.1, 3.0}) {
        for (const Vec3& at : {Vec3{}, Vec3{3.5e6, 5.4e6, 117}}) {
            for (const double far_m : {0.0, 100 * side_m, 20.0, 1e3, 1e7}) {
                Scene scene;
                add_object(scene, Box{at, at + side_m * Vec3{1, 1, 1}}, Black{});
                if (far_m > 0) add_object(scene, Sphere{at + Vec3{0, far_m, far_m}, far_m / 10}, diffuse(1));
                add_lamp(scene, at, side_m);
                const std::vector<MeasuringPoint> points = points_near_walls(at, side_m);
                const auto values = values_of(scene, {point_sensor(points)}, "auto");
                for (std::size_t i = 0; i < points.size(); ++i) {
                    const MeasuringPoint in_room{(points[i].position - at) / side_m, points[i].normal};
                    EXPECT_NEAR(values[i] / exact_lx(in_room), 1, 0.001)
                        << "side " << side_m << " m, beside a thing at " << far_m << " m, " << i;
                }
                // A thousandth of the side behind its walls it is dark, but for rounding as seen from afar.
                const auto behind = values_of(scene,
                                              {point_sensor({{at + side_m * Vec3{-0.001, 0.3, 0.3}, kUp},
                                                             {at + side_m * Vec3{0.3, 1.001, 0.3}, kUp},
                                                             {at + side_m * Vec3{0.3, 0.3, -0.001}, kUp}})},
                                              "path", 64);
                for (const double lx : behind) EXPECT_LT(lx, 1e-12) << side_m << ' ' << far_m;
            }
        }
    }
}

/// By the inverse square law.
TEST(FarThings, SmallRoomsReadAsAloneNearTheirWalls) {
    const Vec3 lamp{0.5, 0.5, 0.9995};
    expect_exact_in_small_rooms(
        [&](Scene& scene, const Vec3& at, double side_m) {
            add_point_light(scene, at + side_m * lamp, Rgb::grey(side_m * side_m));
        },
        [&](const MeasuringPoint& point) {
            const Vec3 to_lamp = lamp - point.position;
            return dot(to_lamp, point.normal) / std::pow(length(to_lamp), 3);
        });
}

/// A panel in the plane of the ceiling.
TEST(FarThings, SmallRoomsReadAsAloneBelowTheirPanels) {
    const Rectangle panel{{0.25, 0.3, 1}, {0, 0.3, 0}, {0.3, 0, 0}};
    expect_exact_in_small_rooms(
        [&](Scene& scene, const Vec3& at, double side_m) {
            add_area_light(
                scene, Rectangle{at + side_m * panel.corner, side_m * panel.edge_u, side_m * panel.edge_v},
                Rgb::grey(1000));
        },
        [&](const MeasuringPoint& point) {
            return exact::illuminance_by_rectangle_lx({point.position, point.normal}, panel.corner,
                                                      panel.edge_u, panel.edge_v, 1000);
        });
}

/// Rooms of 4 cm and of 40 cm are measured by all methods, also between floor and table.
TEST(FarThings, ChangeNoReadingOfASmallFurnishedRoom) {
    for (const double scale : {0.01, 0.1}) {
        Scene room = furnished_room({});
        for (Object& object : room.objects)
            object.shape = geometry::transformed(object.shape, geometry::Transform::scaling(scale));
        std::vector<MeasuringPoint> points;
        for (int i = 0; i < 64; ++i)
            points.push_back({scale * Vec3{0.25 + 0.5 * (i % 8), 0.2 + 0.37 * (i / 8), 0.01}, kUp});
        Scene beside = room;
        add_object(beside, Sphere{{0, 0, -1e4}, 3e3}, diffuse(0.5));
        for (const std::string_view method : {"path", "auto", "light-paths", "guided"}) {
            const auto estimates = [&](const Scene& scene) {
                return estimates_of(scene, {point_sensor(points)}, method, 2048);
            };
            expect_unchanged(estimates(beside), estimates(room), false, fmt::format("{}, {}", method, scale));
        }
    }
}

/// A wall beyond a gap, which an even sky lights, seen from the side of a small box: rays from there end at
/// the box as exactly as rays from nearby.
TEST(FarThings, AWallBeyondAGapLightsASmallBox) {
    for (const double far_m : {10.0, 100.0, 1e4}) {
        const Rectangle wall{{far_m, -far_m, -far_m}, {0, 0, 2 * far_m}, {0, 2 * far_m, 0}};
        Scene scene;
        add_object(scene, Box{{-0.1, -0.05, -0.05}, {0, 0.05, 0.05}}, Black{});
        add_object(scene, wall, diffuse(0.5));
        add_environment(scene, Rgb::grey(100));
        const MeasuringPoint point{{0, 0.01, 0.02}, {1, 0, 0}};
        const double wall_lx = exact::illuminance_by_rectangle_lx({point.position, point.normal}, wall.corner,
                                                                  wall.edge_u, wall.edge_v, 50);
        const double exact_lx = kPi * 100 - wall_lx;  // the wall is half as bright as the sky
        for (const std::string_view method : {"path", "light-paths", "local", "guided"}) {
            const auto found = estimates_of(scene, {point_sensor({point})}, method, 2048)[0];
            EXPECT_NEAR(found.value, exact_lx, 4 * found.standard_error + 1e-4 * exact_lx)
                << method << ' ' << far_m;
            EXPECT_LT(found.standard_error, 0.03 * exact_lx) << method << ' ' << far_m;
        }
    }
}

}  // namespace
}  // namespace stilb::run
