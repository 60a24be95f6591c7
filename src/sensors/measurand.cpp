#include "sensors/measurand.h"

#include "rays/ray_caster.h"

namespace stilb::sensors {
namespace {

struct IsLuminance {
    bool operator()(const MeasuringPoint&) const { return false; }
    bool operator()(const LineOfSight&) const { return true; }
    bool operator()(const EmergentRay&) const { return true; }
};

struct ViewpointOf {
    MeasuringPoint operator()(const MeasuringPoint& point) const { return point; }
    MeasuringPoint operator()(const LineOfSight& sight) const { return {sight.position, sight.direction}; }
    MeasuringPoint operator()(const EmergentRay& ray) const { return {ray.position, ray.normal}; }
};

struct PlaceOf {
    Place operator()(const MeasuringPoint& point) const {
        return {"at", point.position, {{"normal", "facing", point.normal}}};
    }
    Place operator()(const LineOfSight& sight) const {
        return {"from", sight.position, {{"direction", "along", sight.direction}}};
    }
    Place operator()(const EmergentRay& ray) const {
        return {"at", ray.position, {{"normal", "", ray.normal}, {"direction", "towards", ray.direction}}};
    }
};

}  // namespace

bool is_luminance(const Measurand& measurand) { return std::visit(IsLuminance{}, measurand); }
MeasuringPoint viewpoint_of(const Measurand& measurand) { return std::visit(ViewpointOf{}, measurand); }
Place place_of(const Measurand& measurand) { return std::visit(PlaceOf{}, measurand); }

std::optional<rays::Hit> surface_at(const MeasuringPoint& point, const rays::RayCaster& caster) {
    const double most = caster.offset_m(point.position, caster.half_extent_m());
    const auto below = caster.closest(point.position + most * point.normal, -point.normal);
    return below && below->distance_m < 2 * most ? below : std::nullopt;
}

Vec3 lifted_position(const MeasuringPoint& point, const rays::RayCaster& caster) {
    if (const auto surface = surface_at(point, caster)) return surface->lifted;
    return point.position + caster.offset_m(point.position, 0) * point.normal;
}

}  // namespace stilb::sensors
