// Methods that find the first crossing of a ray and a surface by spherical harmonics, against small steps.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/harmonics/cells.h"
#include "geometry/harmonics/surface.h"
#include "support/box_tree.h"
#include "support/harmonic_rays.h"
#include "support/harmonic_reference.h"

namespace stilb {

/// Distances are along the normal, as shares of the greatest radius.
struct Tally {
    std::uint64_t rays = 0, hits = 0;
    std::uint64_t missed = 0;  ///< the ray went on through the surface, deeper than what is allowed
    std::uint64_t wrong = 0;   ///< what was found is not on the surface
    double farthest = 0;       ///< of what was found, from the surface

    Tally& operator+=(const Tally& other) {
        rays += other.rays, hits += other.hits, missed += other.missed, wrong += other.wrong;
        farthest = std::max(farthest, other.farthest);
        return *this;
    }
};

/// `allowed`: how far from the surface, and how deep in it without being found.
inline Tally judge(const geometry::HarmonicSurface& surface, const TestRay& ray,
                   const ReferenceRay& reference, const std::vector<ReferenceRay::Crossing>& crossings,
                   std::optional<double> found, double allowed) {
    // Depths are radial: along the normal they are less by this.
    const auto slant = [&](double distance) {
        const Vec3 outwards = normalized(ray.origin + distance * ray.direction);
        return dot(surface.normal_at(outwards), outwards) / surface.greatest_radius();
    };
    Tally tally;
    tally.rays = 1;
    if (found) {
        tally.hits = 1;
        tally.farthest = std::abs(reference.depth(*found)) * slant(*found);
        if (tally.farthest > allowed) tally.wrong = 1;
    }
    // The first time that the ray is on the other side and deep: crossings 0, 2, 4 ... lead there.
    for (std::size_t n = 0; n < crossings.size(); n += 2) {
        const double at = crossings[n].distance, scale = slant(at);
        if (crossings[n].excursion * scale <= allowed) continue;
        const bool is_late = found && *found > at && reference.largest_depth(at, *found) * scale > allowed;
        if (!found || is_late) tally.missed = 1;
        break;
    }
    return tally;
}

/// Roots are exact but for rounding; cells have their tolerance of 1e-7, and more between where it is
/// checked; what marching leaves out is large.
inline constexpr double kAllowedOfRoots = 1e-9, kAllowedOfCells = 5e-7, kAllowedOfMarch = 1e-6;

/// What single precision says of rays and cells whose boxes they meet, against what double precision does.
struct ClassificationTally {
    std::uint64_t told = 0, unclear = 0;
    std::uint64_t wrong = 0;

    ClassificationTally& operator+=(const ClassificationTally& other) {
        told += other.told, unclear += other.unclear, wrong += other.wrong;
        return *this;
    }
};

struct Tallies {
    Tally roots, cells, march;
    ClassificationTally classifications;

    Tallies& operator+=(const Tallies& other) {
        roots += other.roots, cells += other.cells, march += other.march,
            classifications += other.classifications;
        return *this;
    }
};

/// A surface with all that rays need. Immutable: threads share it.
class CheckedSurface {
  public:
    explicit CheckedSurface(geometry::HarmonicSurface surface)
        : surface_(std::move(surface)), cells_(surface_), tree_(boxes_of(cells_)) {}

    const geometry::HarmonicCells& cells() const { return cells_; }

    /// `marched_every`: of so many rays one is marched, too.
    Tallies check(RayKind kind, std::uint64_t rays, std::uint64_t marched_every, std::uint64_t seed) const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const double step = geometry::kMarchedShare * surface_.greatest_radius();
        const auto distance_of = [](const std::optional<geometry::HarmonicCrossing>& crossing) {
            return crossing ? std::optional(crossing->distance) : std::nullopt;
        };
        Numbers numbers(seed);
        Tallies sum;
        for (std::uint64_t n = 0; n < rays; ++n) {
            const TestRay ray = random_ray(surface_, kind, numbers);
            const auto& [origin, direction] = ray;
            const ReferenceRay reference(surface_, origin, direction);
            const auto crossings = reference.crossings(0);
            const auto judged = [&](std::optional<double> found, double allowed) {
                return judge(surface_, ray, reference, crossings, found, allowed);
            };
            const auto by_roots = surface_.first_crossing(origin, direction, 0, infinity);
            sum.roots += judged(distance_of(by_roots), kAllowedOfRoots);
            const auto by_cells =
                tree_.first(origin, direction, 0, [&](std::size_t cell, double start, double end) {
                    return cells_.crossing(cell, origin, direction, start, end);
                });
            sum.cells += judged(by_cells, kAllowedOfCells);
            sum.classifications += compare_classifications(ray);
            if (n % marched_every != 0) continue;
            const auto by_march = march_crossing(surface_, origin, direction, 0, infinity, step);
            sum.march += judged(distance_of(by_march), kAllowedOfMarch);
        }
        return sum;
    }

  private:
    ClassificationTally compare_classifications(const TestRay& exact) const {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        const PacketPlacement own{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {}};
        RayPacket rays;
        rays.set(0, exact.origin, exact.direction, infinity);
        const Vec3 origin{rays.origin_x[0], rays.origin_y[0], rays.origin_z[0]};
        const Vec3 direction{rays.direction_x[0], rays.direction_y[0], rays.direction_z[0]};
        ClassificationTally tally;
        std::uint64_t met = 0;
        bool is_crossed = false;
        const auto look_at = [&](std::size_t cell, double start, double) {
            const Classification classification = cells_.classifications(cell, rays, own)[0];
            const bool is_here = cells_.crossing(cell, origin, direction, start, infinity) < infinity;
            ++(classification == Classification::unclear ? tally.unclear : tally.told);
            if (classification == Classification::misses && is_here) ++tally.wrong;
            if (classification == Classification::meets) ++met;
            is_crossed = is_crossed || is_here;
            return Bounds::kInfinity;  // so that all cells are looked at
        };
        (void)tree_.first(origin, direction, 0, look_at);
        if (!is_crossed) tally.wrong += met;
        return tally;
    }

    static std::vector<Bounds> boxes_of(const geometry::HarmonicCells& cells) {
        std::vector<Bounds> boxes;
        for (std::size_t cell = 0; cell < cells.count(); ++cell) boxes.push_back(cells.bounds_of(cell));
        return boxes;
    }

    geometry::HarmonicSurface surface_;
    geometry::HarmonicCells cells_;
    BoxTree tree_;
};

}  // namespace stilb
