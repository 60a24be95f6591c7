#include "run/level_of_detail.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/harmonics/surface.h"

namespace stilb::run {
namespace {

constexpr double kNoLimit_m = std::numeric_limits<double>::infinity();
constexpr double kFootprint_rad = 1e-3;  ///< of sensors other than cameras
/// The least R, as a share of the largest, that the truncated surface may have: the surface must not reach
/// its centre.
constexpr double kMostOfRadius = 0.3;

double pixel_rad(const Camera& camera) {
    const sensors::CameraView view(camera);
    const double x = camera.resolution[0] / 2., y = camera.resolution[1] / 2.;
    return std::acos(std::min(1.0, dot(*view.direction_at(x, y), *view.direction_at(x + 1, y))));
}

/// Half the smallest footprint at the object; 0 where a sensor is in it or close to it.
double allowed_m(const Harmonics& object, std::span<const Sensor> sensors) {
    const double radius_m = object.scale * object.surface->greatest_radius();
    double allowed = kNoLimit_m;
    const auto include = [&](const Vec3& position, double footprint_rad) {
        const double distance_m = std::max(0.0, length(position - object.center) - radius_m);
        allowed = std::min(allowed, 0.5 * footprint_rad * distance_m);
    };
    for (const Sensor& sensor : sensors) {
        if (const Camera* camera = sensor.camera()) include(camera->position, pixel_rad(*camera));
        for (const Measurand& measurand : sensor.measurands())
            include(position_of(measurand), kFootprint_rad);
    }
    return allowed;
}

/// An upper bound of the degrees above `degree` in R.
double remainder_of(const math::HarmonicSeries<double>& radius, int degree) {
    if (degree == radius.degree()) return 0;
    const math::HarmonicRange range = range_of(radius.part(degree + 1, radius.degree()));
    return std::max(std::abs(range.least), std::abs(range.greatest));
}

/// The lowest degree at which the bound is met, and at all higher ones.
int least_degree(const math::HarmonicSeries<double>& radius, double allowed) {
    int degree = radius.degree();
    while (degree > 0 && remainder_of(radius, degree - 1) <= allowed) --degree;
    return degree;
}

LevelOfDetail reduce(Object& object, std::span<const Sensor> sensors) {
    auto& harmonics = std::get<Harmonics>(object.shape);
    harmonics.has_levels_of_detail = false;  // so that it is not done again
    const math::HarmonicSeries<double>& radius = harmonics.surface->radius();
    LevelOfDetail level{object.name, radius.degree(), radius.degree(), 0, allowed_m(harmonics, sensors)};
    const double allowed =
        std::min(level.allowed_m / harmonics.scale, kMostOfRadius * harmonics.surface->least_radius());
    level.degree = least_degree(radius, allowed);
    if (level.degree == level.full_degree) return level;
    level.error_m = harmonics.scale * remainder_of(radius, level.degree);
    Harmonics reduced(geometry::HarmonicSurface(radius.part(0, level.degree)));
    reduced.center = harmonics.center, reduced.scale = harmonics.scale, reduced.axes = harmonics.axes;
    reduced.method = harmonics.method;
    object.shape = std::move(reduced);
    return level;
}

bool asks_for_it(const Object& object) {
    const auto* harmonics = std::get_if<Harmonics>(&object.shape);
    return harmonics != nullptr && harmonics->has_levels_of_detail;
}

}  // namespace

bool has_levels_of_detail(const Scene& scene) { return std::ranges::any_of(scene.objects, asks_for_it); }

DetailedScene with_levels_of_detail(Scene scene, std::span<const Sensor> sensors) {
    DetailedScene detailed{std::move(scene), {}};
    for (Object& object : detailed.scene.objects) {
        if (asks_for_it(object)) detailed.levels.push_back(reduce(object, sensors));
    }
    return detailed;
}

}  // namespace stilb::run
