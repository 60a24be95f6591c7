#include "cli/place_text.h"

#include <fmt/format.h>

namespace stilb::cli {
namespace {

struct PlaceText {
    std::string operator()(const MeasuringPoint& point) const {
        return fmt::format("at {} facing {}", place_text(point.position), direction_text(point.normal));
    }
    std::string operator()(const LineOfSight& sight) const {
        return fmt::format("from {} along {}", place_text(sight.position), direction_text(sight.direction));
    }
    std::string operator()(const EmergentRay& ray) const {
        return fmt::format("at {} towards {}", place_text(ray.position), direction_text(ray.direction));
    }
};

}  // namespace

std::string place_text(const Vec3& p) { return fmt::format("({:.5g}, {:.5g}, {:.5g})", p.x, p.y, p.z); }
std::string direction_text(const Vec3& d) { return fmt::format("({:.3g}, {:.3g}, {:.3g})", d.x, d.y, d.z); }

std::string place_text(const Measurand& measurand) { return std::visit(PlaceText{}, measurand); }

}  // namespace stilb::cli
