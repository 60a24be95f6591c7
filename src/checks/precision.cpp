// Sensors so far from the centre of ray queries that their rays are coarse beside what is around them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "checks/checks.h"
#include "sensors/place.h"

namespace stilb::checks {
namespace {

/// Offsets of rays that are larger than this share of the distances around a sensor change readings by a
/// tenth of a per cent or so.
constexpr double kLargestShare = 1. / 1000;
/// Offsets that are never named: nobody models so finely.
constexpr double kSmallOffset_m = 1e-4;

/// The median distance of the surfaces around a point; nothing where most of its sides are open.
std::optional<double> distance_around(const MeasuringPoint& point, const rays::RayCaster& caster) {
    const Vec3 from = place_of(point, caster).lifted;
    std::array<double, 6> distances_m;
    distances_m.fill(Bounds::kInfinity);
    constexpr std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (std::size_t i = 0; i < distances_m.size(); ++i) {
        if (const auto hit = caster.closest(from, i % 2 == 0 ? axes[i / 2] : -axes[i / 2]))
            distances_m[i] = hit->distance_m;
    }
    std::ranges::nth_element(distances_m, distances_m.begin() + 3);
    return std::isfinite(distances_m[3]) ? std::optional(distances_m[3]) : std::nullopt;
}

}  // namespace

std::vector<std::string> precision_warnings(const rays::RayCaster& caster, std::span<const Sensor> sensors) {
    std::vector<std::string> warnings;
    for (const Sensor& sensor : sensors) {
        for (const Vec3& position : sensors::measured_points({&sensor, 1})) {
            const double offset_m = caster.offset_m(position, 0);
            if (offset_m < kSmallOffset_m) continue;
            const auto around_m = distance_around({position, {0, 0, 1}}, caster);
            if (!around_m || offset_m < kLargestShare * *around_m) continue;
            const double far_m = largest_coordinate(position - caster.center());
            warnings.push_back(
                fmt::format("sensor \"{}\": it lies {:.3g} m from the middle of what is measured, ({:.6g}, "
                            "{:.6g}, {:.6g}). "
                            "Rays are exact to {:.2g} mm there, and the surfaces around it are {:.2g} m "
                            "away. Measure it in "
                            "a run of its own: --sensor {}.",
                            sensor.name, far_m, caster.center().x, caster.center().y, caster.center().z,
                            1000 * offset_m, *around_m, sensor.name));
            break;
        }
    }
    return warnings;
}

}  // namespace stilb::checks
