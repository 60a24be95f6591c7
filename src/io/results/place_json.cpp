#include "io/results/place_json.h"

namespace stilb::io {
namespace {

using Json = nlohmann::ordered_json;

struct PlaceJson {
    Json operator()(const MeasuringPoint& point) const {
        return {{"position", vector_json(point.position)}, {"normal", vector_json(point.normal)}};
    }
    Json operator()(const LineOfSight& sight) const {
        return {{"position", vector_json(sight.position)}, {"direction", vector_json(sight.direction)}};
    }
    Json operator()(const EmergentRay& ray) const {
        return {{"position", vector_json(ray.position)},
                {"normal", vector_json(ray.normal)},
                {"direction", vector_json(ray.direction)}};
    }
};

}  // namespace

Json vector_json(const Vec3& v) { return {v.x, v.y, v.z}; }

Json place_json(const Measurand& measurand) { return std::visit(PlaceJson{}, measurand); }

}  // namespace stilb::io
