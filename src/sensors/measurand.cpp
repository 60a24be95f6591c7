#include "sensors/measurand.h"

namespace stilb::sensors {
namespace {

struct IsLuminance {
    bool operator()(const MeasuringPoint&) const { return false; }
    bool operator()(const BodyPoint&) const { return false; }
    bool operator()(const LineOfSight&) const { return true; }
    bool operator()(const EmergentRay&) const { return true; }
};

struct ViewpointOf {
    MeasuringPoint operator()(const MeasuringPoint& point) const { return point; }
    MeasuringPoint operator()(const BodyPoint& body) const { return {body.position, body.axis}; }
    MeasuringPoint operator()(const LineOfSight& sight) const { return {sight.position, sight.direction}; }
    MeasuringPoint operator()(const EmergentRay& ray) const { return {ray.position, ray.normal}; }
};

struct LocationOf {
    Location operator()(const MeasuringPoint& point) const {
        return {"at", point.position, {{"normal", "facing", point.normal}}};
    }
    Location operator()(const BodyPoint& body) const {
        const std::string_view name = body.sensitivity->axis_name;
        if (name.empty()) return {"at", body.position};
        return {"at", body.position, {{name, "facing", body.axis}}};
    }
    Location operator()(const LineOfSight& sight) const {
        return {"from", sight.position, {{"direction", "along", sight.direction}}};
    }
    Location operator()(const EmergentRay& ray) const {
        return {"at", ray.position, {{"normal", "", ray.normal}, {"direction", "towards", ray.direction}}};
    }
};

}  // namespace

bool is_luminance(const Measurand& measurand) { return std::visit(IsLuminance{}, measurand); }
MeasuringPoint viewpoint_of(const Measurand& measurand) { return std::visit(ViewpointOf{}, measurand); }
Location location_of(const Measurand& measurand) { return std::visit(LocationOf{}, measurand); }

}  // namespace stilb::sensors
