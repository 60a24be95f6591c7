#include <fmt/format.h>

#include <algorithm>

#include "checks/checks.h"
#include "checks/walks.h"
#include "sensors/place.h"
#include "stilb/error.h"

namespace stilb::checks {
namespace {

/// A surface so close above a point covers it, where points are not as dense as that: it stands in a thing,
/// or under it.
constexpr double kCovering_m = 0.02;

/// Whether something covers a point, or bodies hide it from all lights.
class HiddenPoints {
  public:
    HiddenPoints(const Scene& scene, const rays::RayCaster& caster, const Enclosures& enclosures)
        : scene_(scene), caster_(caster), enclosures_(enclosures) {}

    bool is_covered(const MeasuringPoint& point, double covering_m) const {
        const auto above = caster_.closest(place_of(point, caster_).lifted, point.normal);
        return above && above->distance_m < covering_m && !transmits(scene_.material(above->material));
    }

    bool is_dark(const MeasuringPoint& point) const {
        return !scene_.lights.empty() &&
               !enclosures_.is_lit(enclosures_.enclosure_of(place_of(point, caster_)));
    }

  private:
    const Scene& scene_;
    const rays::RayCaster& caster_;
    const Enclosures& enclosures_;
};

}  // namespace

std::vector<Sensor> without_hidden_points(const Scene& scene, const rays::RayCaster& caster,
                                          const Enclosures& enclosures, std::span<const Sensor> given) {
    std::vector<Sensor> sensors(given.begin(), given.end());
    const HiddenPoints hidden(scene, caster, enclosures);
    for (Sensor& sensor : sensors) {
        auto* const area = std::get_if<Area>(&sensor.kind);
        if (!area) continue;
        const double covering_m = std::min(kCovering_m, std::min(area->cell_m[0], area->cell_m[1]) / 2);
        const auto is_covered = [&](const MeasuringPoint& point) {
            return hidden.is_covered(point, covering_m);
        };
        const auto is_dark = [&](const MeasuringPoint& point) { return hidden.is_dark(point); };
        area->left_out += std::erase_if(area->points, is_covered);
        if (area->points.empty()) {
            throw InputError(
                fmt::format("sensor \"{}\": all {} points of the area are right below a surface. Move the "
                            "area, or choose another height.",
                            sensor.name, area->left_out));
        }
        // Dark points among lit ones stand in furniture. Where all are dark, it is the room that has no lamp.
        if (!std::ranges::all_of(area->points, is_dark))
            area->left_out += std::erase_if(area->points, is_dark);
    }
    return sensors;
}

}  // namespace stilb::checks
