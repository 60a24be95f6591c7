// The choice of lights that the first shot replaces, and the points that represent them.
//
// Point lights and luminaires are one point each. An area light is replaced where few points can represent
// it: the vertices of a triangle mesh of its own, no farther apart than kVertexSpacing of the distance that
// half of its light travels at least. A vertex i represents a third of the area S_i of the triangles
// around it [FirstShot (20)]: the trapezoidal rule, whose flux is exact and whose illuminance at a distance
// d, from squares of edge h, is wrong by a share of about (h/d)^2 / 3. Rectangles and disks begin as
// triangles around their middle, a disk as a hexagon; areas are scaled to the true one.
//
// A sphere is represented by the twelve vertices of the inscribed icosahedron, facing outwards. They share
// the light of each direction among the vertices that face it, in proportion to their cosines, so that all of
// them together have the sphere's intensity in every direction. Points on the opening of a luminaire, spread
// evenly by area, share its intensity likewise. Such an opening is always replaced, by as many points as are
// allowed where it is large: its luminance depends on direction, which patches do not provide for.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "estimators/patch_light/patch_options.h"
#include "patches/visibility/item_buffer.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"

namespace stilb::estimators {

/// The largest spacing of vertices, as a share of the distance that half of an area light's light travels at
/// least.
inline constexpr double kVertexSpacing = 0.25;
/// The fewest points of a luminaire's opening.
inline constexpr std::size_t kFewestOfOpening = 4;
/// The largest number of vertices of a small area light, and of points of an opening.
inline constexpr std::size_t kMostLightSamples = 32;

/// The intensities of light samples. Each is called with a pixel of an item buffer around the sample and
/// gives the sample's share of the light's luminous intensity [cd] towards it, the cosine of area lights
/// included; negative values count as 0.
struct PointIntensity {
    lights::Emitter emitter;  ///< a point, in the coordinates of the buffer
    double operator()(const patches::BufferPixel& pixel) const;
};
struct VertexIntensity {
    double normal_cd = 0;
    double operator()(const patches::BufferPixel& pixel) const { return normal_cd * pixel.cosine; }
};
/// One of the vertices that share the light of a sphere.
struct SphereVertexIntensity {
    double sphere_cd = 0;       ///< of the sphere
    std::vector<Vec3> normals;  ///< of all vertices, in the coordinates of the buffer
    double operator()(const patches::BufferPixel& pixel) const;
};
/// One of the points on a luminaire's opening, which share its light likewise.
struct OpeningPointIntensity {
    PointIntensity luminaire;
    std::vector<Vec3> normals;  ///< of all points, in the coordinates of the buffer
    double operator()(const patches::BufferPixel& pixel) const;
};
using SampleIntensity =
    std::variant<PointIntensity, VertexIntensity, SphereVertexIntensity, OpeningPointIntensity>;

/// A point that represents a light or a part of it.
struct LightSample {
    std::uint32_t light = 0;  ///< of Scene::lights
    bool is_point = false;    ///< emits in all directions, else to the hemisphere about the viewpoint's w
    patches::Viewpoint viewpoint;  ///< lifted off the light
    SampleIntensity intensity;

    double intensity_cd(const patches::BufferPixel& pixel) const {
        return std::visit([&](const auto& of) { return of(pixel); }, intensity);
    }
};

struct FirstShotLights {
    std::vector<FirstShotLight> lights;  ///< as Scene::lights
    std::vector<LightSample> samples;    ///< one light after the other
};

/// Decides on every light. `center` is that of the patches seen from the samples. The samples
/// keep references to the scene.
FirstShotLights choose_first_shot_lights(const Scene& scene, const rays::RayCaster& caster,
                                         const Vec3& center);

/// The number of samples of equal flux whose independent errors, relative to all light, would be the same.
double effective_number(const Scene& scene, const FirstShotLights& lights);

}  // namespace stilb::estimators
