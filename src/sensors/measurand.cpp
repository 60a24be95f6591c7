#include "sensors/measurand.h"

#include "geometry/shape.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"

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

namespace {

std::optional<rays::Hit> close_surface(const MeasuringPoint& point, const rays::RayCaster& caster) {
    // Three offsets in front, because a lamp in the plane of a ceiling stands two in front of it
    // (scene/overlaps.h); and one behind.
    const double most = caster.offset_m(point.position, caster.lift().largest_size_m());
    const auto below = caster.closest(point.position + 3 * most * point.normal, -point.normal);
    return below && below->distance_m < 4 * most ? below : std::nullopt;
}

/// Whether the point lies in front of the lamp on which it seems to lie, and faces it. In double precision:
/// lamps are measured from nearer than rays can tell.
bool faces_lamp(const MeasuringPoint& point, const rays::Hit& close, const rays::RayCaster& caster) {
    if (close.on_front) return false;
    const Shape& shape = caster.scene().object(close.object).shape;
    const bool is_flat = caster.traced_mesh(close.object).has_value();
    const Vec3 on_surface = is_flat ? geometry::corners_of(shape, close.triangle)[0] : close.position;
    return dot(close.normal, point.position - on_surface) < 0 &&
           scene::lamps_of(caster.scene()).contains(close.object);
}

}  // namespace

std::optional<rays::Hit> surface_at(const MeasuringPoint& point, const rays::RayCaster& caster) {
    const auto close = close_surface(point, caster);
    return close && !faces_lamp(point, *close, caster) ? close : std::nullopt;
}

RayStart ray_start(const MeasuringPoint& point, const rays::RayCaster& caster) {
    const auto close = close_surface(point, caster);
    if (!close) return {point.position};
    const Vec3 lift = close->lift_m * close->normal;
    if (faces_lamp(point, *close, caster)) return {close->lifted_behind(), -lift};
    return {close->lifted, lift};
}

std::optional<rays::Hit> surface_at(const BodyPoint& body, const rays::RayCaster& caster) {
    if (auto surface = surface_at(MeasuringPoint{body.position, body.axis}, caster)) return surface;
    for (const Vec3& across : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        auto surface = surface_at(MeasuringPoint{body.position, across}, caster);
        if (!surface) continue;
        if (!surface->on_front) {
            surface->lifted = surface->lifted_behind();
            surface->normal = -surface->normal;
            surface->on_front = true;
        }
        return surface;
    }
    return std::nullopt;
}

Vec3 lifted_position(const BodyPoint& body, const rays::RayCaster& caster) {
    const auto surface = surface_at(body, caster);
    return surface ? surface->lifted : body.position;
}

}  // namespace stilb::sensors
