// Luminous openings of luminaires whose size is that of another unit.
#include <fmt/format.h>

#include "checks/checks.h"
#include "checks/walks.h"

namespace stilb::checks {
std::vector<std::string> opening_warnings(const Scene& scene) {
    std::vector<std::string> names;
    double first_m = 0;
    for (const Light& light : scene.lights) {
        const auto opening = lights::opening_of(light);
        if (!opening) continue;
        const double size_m = 2 * bounds_of(scene.object(*opening).shape).half_extent();
        if (size_m >= lights::kSmallestOpening_m && size_m <= lights::kLargestOpening_m) continue;
        if (names.empty()) first_m = size_m;
        names.push_back(light.name);
    }
    if (names.empty()) return {};
    return {
        fmt::format("{} {}: the luminous opening is {:.3g} m large, as that of no luminaire. Its size is "
                    "probably in another "
                    "unit: give it in metres by the key opening.",
                    names.size() == 1 ? "light" : "lights", list_of(names), first_m)};
}

}  // namespace stilb::checks
