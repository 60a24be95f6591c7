#include <fmt/format.h>

#include <optional>

#include "checks/checks.h"
#include "checks/walks.h"
#include "stilb/error.h"

namespace stilb::checks {
namespace {

/// A surface so close above a point covers it: it stands in a thing, or under it.
constexpr double kCovering_m = 0.02;

/// Whether a body hides a point from all lights, or covers it.
class HiddenPoints {
  public:
    HiddenPoints(const Scene& scene, const rays::RayCaster& caster)
        : scene_(scene), caster_(caster), enclosures_(scene, caster) {}

    bool contain(const MeasuringPoint& point) const {
        const ProbeRay probe{lifted_position(point, caster_), point.normal};
        const auto above = caster_.closest(probe.position, probe.direction);
        if (above && above->distance_m < kCovering_m && !transmits(scene_.material(above->material)))
            return true;
        return !scene_.lights.empty() && !enclosures_.is_lit(enclosures_.enclosure_of(probe));
    }

  private:
    const Scene& scene_;
    const rays::RayCaster& caster_;
    Enclosures enclosures_;
};

}  // namespace

std::vector<Sensor> without_hidden_points(const Scene& scene, const rays::RayCaster& caster,
                                          std::span<const Sensor> given) {
    std::vector<Sensor> sensors(given.begin(), given.end());
    std::optional<HiddenPoints> hidden;
    for (Sensor& sensor : sensors) {
        auto* const area = std::get_if<Area>(&sensor.kind);
        if (!area) continue;
        if (!hidden) hidden.emplace(scene, caster);
        area->left_out +=
            std::erase_if(area->points, [&](const MeasuringPoint& point) { return hidden->contain(point); });
        if (area->points.empty()) {
            throw InputError(
                fmt::format("sensor \"{}\": all {} points of the area are inside of bodies, right below a "
                            "surface, or outside of "
                            "the room. Move the area, or choose another height.",
                            sensor.name, area->left_out));
        }
    }
    return sensors;
}

}  // namespace stilb::checks
