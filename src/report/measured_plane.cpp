#include "report/measured_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plot/false_colour_painter.h"
#include "sensors/areas/measured_raster.h"

namespace stilb::report {
namespace {

constexpr int kMostTicks = 9;
/// The sine of the steepest slope that counts as horizontal.
constexpr double kLevel = 1e-3;

/// An axis of a raster, perhaps against its direction.
struct Axis {
    Vec3 edge;
    int count = 1;
    bool is_turned = false;

    Vec3 along() const { return is_turned ? -edge : edge; }
    int index(int cell) const { return is_turned ? count - 1 - cell : cell; }
};

/// The frame in which one looks at a plane: u to the right, v upwards.
Frame view_of(const Vec3& normal) {
    const bool is_level = std::hypot(normal.x, normal.y) < kLevel;
    return Frame::of_surface(is_level ? Vec3{0, 0, 1} : normal);
}

/// How well two axes run to the right and upwards; 2 at best.
double fit(const Axis& right, const Axis& up, const Frame& view) {
    return dot(normalized(right.along()), view.u) + dot(normalized(up.along()), view.v);
}

/// The readings in the cells of a raster, of which only some may have one.
std::vector<double> values_by_cell(const SensorResult& result, const Grid& raster) {
    std::vector<double> values(raster.size(), std::numeric_limits<double>::quiet_NaN());
    const std::vector<std::size_t> cells = sensors::cells_of_readings(result.sensor);
    for (std::size_t j = 0; j < cells.size(); ++j) values[cells[j]] = result.readings[j].estimate.value;
    return values;
}

MeasuredPlane make_plane(const SensorResult& result, const Grid& raster) {
    const Vec3 normal = raster.normal.value_or(normalized(cross(raster.edge_u, raster.edge_v)));
    const Frame view = view_of(normal);
    Axis right{raster.edge_u, raster.count[0]}, up{raster.edge_v, raster.count[1]};
    bool u_is_right = true;
    for (const bool is_first : {true, false}) {
        for (const bool turns_u : {false, true}) {
            for (const bool turns_v : {false, true}) {
                Axis u{raster.edge_u, raster.count[0], turns_u}, v{raster.edge_v, raster.count[1], turns_v};
                if (!is_first) std::swap(u, v);
                if (!(fit(u, v, view) > fit(right, up, view) + kLevel)) continue;
                right = u, up = v, u_is_right = is_first;
            }
        }
    }
    MeasuredPlane plane{&result, raster.corner, right.along(), up.along(), {}};
    for (const Axis& axis : {right, up}) {
        if (axis.is_turned) plane.corner += axis.edge;
    }
    plane.panel = {result.sensor.name, "", right.count, up.count, length(right.edge), length(up.edge), {}};
    const std::vector<double> values = values_by_cell(result, raster);
    for (int row = 0; row < up.count; ++row) {
        for (int column = 0; column < right.count; ++column) {
            const int u = u_is_right ? right.index(column) : up.index(row);
            const int v = u_is_right ? up.index(row) : right.index(column);
            plane.panel.values.push_back(
                values[static_cast<std::size_t>(v) * static_cast<std::size_t>(raster.count[0]) +
                       static_cast<std::size_t>(u)]);
        }
    }
    return plane;
}

}  // namespace

Vec3 MeasuredPlane::at(double column, double row) const {
    return corner + column / panel.nu * right + row / panel.nv * up;
}

bool MeasuredPlane::is_horizontal() const {
    const Vec3 normal = normalized(cross(right, up));
    return std::hypot(normal.x, normal.y) < kLevel;
}

bool MeasuredPlane::is_whole() const {
    const auto* area = std::get_if<Area>(&result->sensor.kind);
    return !area || area->band_m[1] == 0;
}

std::array<double, 2> MeasuredPlane::to_plane(const Vec3& position) const {
    const Vec3 from_corner = position - corner;
    return {dot(from_corner, normalized(right)), dot(from_corner, normalized(up))};
}

std::vector<MeasuredPlane> measured_planes(std::span<const SensorResult> results) {
    std::vector<MeasuredPlane> planes;
    for (const SensorResult& result : results) {
        if (const Grid* raster = sensors::raster_of(result.sensor))
            planes.push_back(make_plane(result, *raster));
    }
    return planes;
}

plot::Scale common_scale(std::span<const MeasuredPlane> planes) {
    std::vector<double> values;
    for (const MeasuredPlane& plane : planes)
        values.insert(values.end(), plane.panel.values.begin(), plane.panel.values.end());
    return plot::choose_scale(values, {});
}

std::vector<plot::Tick> scale_ticks(const plot::Scale& scale) {
    return plot::nice_ticks(scale, kMostTicks).major;
}

std::vector<std::vector<Vec3>> outlines_of(const Sensor& sensor) {
    if (const auto* grid = std::get_if<Grid>(&sensor.kind)) {
        const auto& [corner, u, v, count, normal] = *grid;
        return {{corner, corner + u, corner + u + v, corner + v}};
    }
    const sensors::PolygonInSpace& polygon = std::get<Area>(sensor.kind).polygon;
    std::vector<std::vector<Vec3>> outlines{polygon.outline};
    outlines.insert(outlines.end(), polygon.holes.begin(), polygon.holes.end());
    return outlines;
}

}  // namespace stilb::report
