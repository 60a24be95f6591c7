#include "geometry/harmonics/march.h"

#include <algorithm>
#include <cmath>

namespace stilb::geometry {

std::optional<HarmonicCrossing> march_crossing(const HarmonicSurface& surface, const Vec3& origin,
                                               const Vec3& direction, double start, double end, double step) {
    const double closest = -dot(origin, direction), radius = surface.greatest_radius();
    const double squared = radius * radius - squared_length(origin + closest * direction);
    if (squared <= 0) return std::nullopt;
    const auto is_outside = [&](double distance) {
        const Vec3 x = origin + distance * direction;
        const double from_origin = length(x);
        return from_origin > 0 && from_origin > surface.radius().at(x / from_origin);
    };
    const double reach = std::sqrt(squared);
    const double first = std::max(start, closest - reach), last = std::min(end, closest + reach);
    if (!(first < last)) return std::nullopt;
    const bool starts_outside = is_outside(first);
    const auto steps = static_cast<long>(std::ceil((last - first) / step));
    for (long i = 1; i <= steps; ++i) {
        double high = std::min(last, first + static_cast<double>(i) * step);
        if (is_outside(high) == starts_outside) continue;
        double low = first + static_cast<double>(i - 1) * step, middle = 0.5 * (low + high);
        for (; low < middle && middle < high; middle = 0.5 * (low + high)) {
            (is_outside(middle) == starts_outside ? low : high) = middle;
        }
        return HarmonicCrossing{high, normalized(origin + high * direction), starts_outside};
    }
    return std::nullopt;
}

}  // namespace stilb::geometry
