#include "estimators/packed_points.h"

#include <algorithm>
#include <numeric>

#include "scene/morton.h"

namespace stilb {
PackedPoints packed(std::span<const Measurand> measurands, const RayCaster& caster) {
    std::vector<MeasuringPoint> points;
    std::vector<Vec3> positions;
    for (const Measurand& measurand : measurands) {
        points.push_back(place_of(measurand));
        positions.push_back(points.back().position);
    }
    const std::vector<std::uint64_t> codes = morton_codes(positions);
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return codes[a] < codes[b]; });
    PackedPoints result;
    result.reserve(points.size());
    for (const std::uint32_t reading : order) {
        result.push_back({points[reading].position, lifted_position(points[reading], caster),
                          points[reading].normal, reading});
    }
    return result;
}

}  // namespace stilb
