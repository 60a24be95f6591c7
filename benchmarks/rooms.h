// The rooms of the benchmarks: boxes of 4 x 4 x 3 m, empty or furnished with clutter of a given number of
// triangles.
#pragma once

#include <cmath>
#include <numbers>

#include "materials/diffuse.h"
#include "materials/phong.h"
#include "math/random.h"
#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb {

/// A ball of 2 x rings x rings triangles or so, of radius 1 about the origin, moved and scaled.
inline void add_ball(Mesh& mesh, const Vec3& center, double radius, unsigned rings) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (unsigned i = 0; i <= rings; ++i) {
        for (unsigned j = 0; j < rings; ++j) {
            const double theta = std::numbers::pi * i / rings, phi = 2 * std::numbers::pi * j / rings;
            mesh.vertices.push_back(center + radius * Vec3{std::sin(theta) * std::cos(phi),
                                                           std::sin(theta) * std::sin(phi), std::cos(theta)});
        }
    }
    for (unsigned i = 0; i < rings; ++i) {
        for (unsigned j = 0; j < rings; ++j) {
            const std::uint32_t a = first + i * rings + j, b = first + i * rings + (j + 1) % rings;
            if (i > 0) mesh.triangles.push_back({a, a + rings, b});
            if (i + 1 < rings) mesh.triangles.push_back({b, a + rings, b + rings});
        }
    }
}

/// Diffuse walls of 0.6, a point light; `balls` balls of 400 triangles, half in the upper and half in the
/// lower part.
inline Scene make_room(unsigned balls) {
    Scene scene;
    scene.name = balls == 0 ? "empty room" : "room with clutter";
    scene.materials.push_back({"wall", Diffuse{Rgb::grey(0.6)}});
    scene.objects.push_back({"room", Box{{0, 0, 0}, {4, 4, 3}}, {MaterialId{0}}});
    scene.lights.push_back({"bulb", PointLight{{2.1, 1.9, 2.4}, Rgb::grey(80)}});
    Mesh clutter;
    for (unsigned i = 0; i < balls; ++i) {
        math::SampleStream place(math::RandomKey{7}, i);
        const auto [u, v] = place.next_two();
        const double height = place.next();
        add_ball(clutter, {0.3 + 3.4 * u, 0.3 + 3.4 * v, i % 2 ? 0.2 + 0.4 * height : 2.2 + 0.5 * height},
                 0.12, 15);
    }
    if (balls > 0) scene.objects.push_back({"clutter", clutter, {MaterialId{0}}});
    return scene;
}

/// The same with gloss on everything: Phong lobes of exponent 50 over diffuse 0.4.
inline Scene make_glossy_room(unsigned balls) {
    Scene scene = make_room(balls);
    scene.name = "glossy " + scene.name;
    scene.materials.front().material = Phong{Rgb::grey(0.4), Rgb::grey(0.2), 50};
    return scene;
}

/// Points on a horizontal plane at desk height.
inline std::vector<Measurand> make_grid(int cells) {
    const Grid grid{{0.05, 0.05, 0.8}, {3.9, 0, 0}, {0, 3.9, 0}, {cells, cells}};
    return Sensor{"grid", grid}.measurands();
}

}  // namespace stilb
