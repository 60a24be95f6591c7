// Random rays at a surface by spherical harmonics, of the kinds that are hard.
#pragma once

#include <array>
#include <cmath>

#include "support/harmonic_shapes.h"

namespace stilb {

enum class RayKind { hit, near_miss, grazing, from_inside, through_centre, along_pole };
inline constexpr std::array kRayKinds{RayKind::hit,         RayKind::near_miss,      RayKind::grazing,
                                      RayKind::from_inside, RayKind::through_centre, RayKind::along_pole};
inline constexpr const char* name_of(RayKind kind) {
    constexpr std::array names{"hits", "near misses", "grazing", "from inside", "through centre", "poles"};
    return names[static_cast<std::size_t>(kind)];
}

struct TestRay {
    Vec3 origin, direction;  ///< unit
};

/// 10^-low to 10^-high, or 0.
inline double tiny(Numbers& numbers, double low, double high) {
    return numbers.next() < 0.1 ? 0 : std::pow(10, -low - (high - low) * numbers.next());
}

/// Through a point, from outside.
inline TestRay ray_through(const geometry::HarmonicSurface& surface, const Vec3& point,
                           const Vec3& direction) {
    return {point - 3 * surface.greatest_radius() * direction, direction};
}

inline TestRay random_ray(const geometry::HarmonicSurface& surface, RayKind kind, Numbers& numbers) {
    const auto point = [&](double share) {
        const Vec3 direction = numbers.direction();
        return share * surface.radius().at(direction) * direction;
    };
    switch (kind) {
        case RayKind::hit:
            return ray_through(surface, point(0.9 * numbers.next()), numbers.direction());
        case RayKind::near_miss:
            return ray_through(surface, point(0.98 + 0.2 * numbers.next()), numbers.direction());
        case RayKind::grazing: {
            const Vec3 outwards = numbers.direction(), normal = surface.normal_at(outwards);
            const double turn = 2 * std::numbers::pi * numbers.next(), aside = tiny(numbers, 3, 13);
            const Frame frame = Frame::around(normal);
            const Vec3 touch = surface.radius().at(outwards) * outwards;
            return ray_through(surface, touch + (numbers.next() < 0.5 ? -aside : aside) * normal,
                               std::cos(turn) * frame.u + std::sin(turn) * frame.v);
        }
        case RayKind::from_inside:
            return {point(0.99 * numbers.next()), numbers.direction()};
        case RayKind::through_centre: {
            const Vec3 direction = numbers.direction();
            const Vec3 aside = tiny(numbers, 1, 17) * Frame::around(direction).u;
            if (numbers.next() < 0.2) return {aside, direction};
            return ray_through(surface, aside, direction);
        }
        case RayKind::along_pole: {
            const double sign = numbers.next() < 0.5 ? -1 : 1, aside = tiny(numbers, 0, 17);
            const double turn = 2 * std::numbers::pi * numbers.next();
            return ray_through(surface, aside * Vec3{std::cos(turn), std::sin(turn), 0}, {0, 0, sign});
        }
    }
    return {};
}

}  // namespace stilb
