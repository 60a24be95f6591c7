// Areas of EN 12464-1: a task area as a polygon, the surrounding band and the background band around it, each
// measured on a raster.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "sensors/areas/plane_region.h"
#include "sensors/fields.h"
#include "sensors/illuminance.h"
#include "sensors/measurand.h"
#include "sensors/requirement.h"

namespace stilb::sensors {

/// A plane polygon: the corners of its outline and of its holes, without the first ones again.
struct PolygonInSpace {
    std::vector<Vec3> outline;
    std::vector<std::vector<Vec3>> holes;
};

double area_m2(const PolygonInSpace& polygon);

/// Which faces of objects: by the direction that the measured side faces.
enum class SurfacePart { all, walls, ceiling, floor };
inline constexpr std::array<std::string_view, 4> kSurfacePartNames{"all", "walls", "ceiling", "floor"};

/// Faces of objects, or those around a room, such as its walls.
struct Surfaces {
    std::vector<std::string> objects;  ///< their names
    std::optional<Vec3> room;          ///< a point in it
    SurfacePart part = SurfacePart::all;

    /// Nothing is where the area is a polygon.
    bool are_given() const { return !objects.empty() || room; }
};

/// A band around an area, which is a sensor of its own.
struct Band {
    double width_m = 0;
    std::vector<Requirement> requirements;
};

/// The largest distance of points in an area whose shorter and longer side are `short_m` and `long_m`
/// [EN 12464-1, 4.4]: 0.2 * 5^log10(d), at most 10 m, with d the longer side, or the shorter one where the
/// longer is twice as long or more.
double raster_spacing_m(double short_m, double long_m);

/// Illuminance at the middles of the cells of a raster that lie in a polygon, in a band around it, or on
/// faces of objects.
struct Area {
    PolygonInSpace polygon;
    Surfaces surfaces{};
    /// A unit vector for all points; by default upwards for a horizontal polygon, else the side from which
    /// the corners run counterclockwise.
    std::optional<Vec3> normal{};
    std::optional<double> spacing_m{};  ///< by default raster_spacing_m()
    std::optional<Band> surround{}, background{};
    /// Of a band: its distances from the polygon; 0, 0 for the polygon itself.
    std::array<double, 2> band_m{};

    // From settle() on; of faces from place_on() on (surface_points.h), or place_in() (rooms.h).
    std::vector<MeasuringPoint> points{};
    Grid raster{};  ///< its cells have the points in their middles, and others beyond the area
    std::array<double, 2> cell_m{};  ///< the distances of neighbouring points along both axes of the raster
    std::size_t left_out = 0;  ///< points inside of bodies, which are not measured (checks/hidden_points.cpp)

    static constexpr std::string_view kType = "area";
    static constexpr Quantity kQuantity = kIlluminance;
    static constexpr Noun kReadings = kPoints;
    static constexpr auto fields() {
        return std::tuple{
            PolygonField{&Area::polygon, "the measured area"},
            SurfacesField{&Area::surfaces, "faces of objects, or of a room, as the measured area"},
            DirectionField{"normal", &Area::normal,
                           "the side that receives light; by default upwards, or where the corners run "
                           "counterclockwise",
                           Presence::optional},
            Field{"spacing", &Area::spacing_m, Range{1e-3, 1e6, "a length from 0.001 to 1e6 m"},
                  "of the points [m]; by default that of EN 12464-1", Presence::optional},
            BandField{"surround", &Area::surround, "band around the area [m], a sensor of its own"},
            BandField{"background", &Area::background, "band around that [m], a sensor of its own"}};
    }
    /// Makes the points.
    std::optional<Fault> settle(const GivenKeys& given);

    std::size_t size() const { return points.size(); }
    Measurand measurand(std::size_t j) const { return points[j]; }
};

}  // namespace stilb::sensors

namespace stilb {
using sensors::Area;
}  // namespace stilb
