#include "cli/place_text.h"

#include <fmt/format.h>

namespace stilb::cli {

std::string place_text(const Vec3& p) { return fmt::format("({:.5g}, {:.5g}, {:.5g})", p.x, p.y, p.z); }
std::string direction_text(const Vec3& d) { return fmt::format("({:.3g}, {:.3g}, {:.3g})", d.x, d.y, d.z); }

std::string place_text(const Place& place) {
    std::string text = fmt::format("{} {}", place.preposition, place_text(place.position));
    for (const Place::Direction& direction : place.directions) {
        if (!direction.preposition.empty())
            text += fmt::format(" {} {}", direction.preposition, direction_text(direction.value));
    }
    return text;
}

std::string angles_text(const Place& place) {
    std::string text;
    for (const Place::Angle& angle : place.angles)
        text += fmt::format("{}{} {:5.5g}°", text.empty() ? "" : "  ", angle.name, angle.value_deg);
    return text;
}

}  // namespace stilb::cli
