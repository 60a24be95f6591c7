// Light by where it began and how often it was reflected, for what keeps lamps or bounces apart.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/rgb.h"

namespace stilb::transport {

/// The light of one lamp after so many reflections, in the unit of the sum that it is a part of.
struct LightPart {
    Rgb value;
    std::uint32_t light = 0;  ///< of Scene::lights
    int reflections = 0;
};

/// What a sum consists of. Null pointers to it stand for: nobody asks.
using LightParts = std::vector<LightPart>;

/// Whether a set-up keeps the parts of light that needs no samples.
enum class PartsOfLight { none, all };

/// Adds a part to a sum.
inline void add_part(const Rgb& value, std::size_t light, int reflections, Rgb& sum, LightParts* parts) {
    sum += value;
    if (parts) parts->push_back({value, static_cast<std::uint32_t>(light), reflections});
}

/// The channels that the light of a problem is divided into: groups of lights, and numbers of reflections.
struct Channels {
    std::vector<std::uint32_t> group_of_light;  ///< by Scene::lights
    std::size_t groups = 1;
    /// The last one is: so many reflections, or more.
    std::size_t orders = 1;

    std::size_t count() const { return groups * orders; }
    std::size_t of(std::uint32_t light, int reflections) const {
        return group_of_light[light] * orders + std::min(static_cast<std::size_t>(reflections), orders - 1);
    }
    /// Adds parts of a reading, times a weight and after so many more reflections, to `sums`: channels x
    /// readings.
    void add(std::span<const LightPart> parts, const Rgb& weight, int reflections, std::size_t reading,
             std::span<Rgb> sums) const {
        const std::size_t readings = sums.size() / count();
        for (const LightPart& part : parts) {
            const Rgb value = weight * part.value;
            if (value.is_finite())
                sums[of(part.light, part.reflections + reflections) * readings + reading] += value;
        }
    }
};

}  // namespace stilb::transport
