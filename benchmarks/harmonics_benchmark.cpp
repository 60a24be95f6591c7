// Surfaces by spherical harmonics: how long their cells take to make, what they store, and how long a ray
// takes: in one cell whose box it meets, in all of them from near to far until it hits, and by roots of the
// series. White relief has all degrees alike; a head's falls off. One thread.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "best_time.h"
#include "geometry/harmonics/cells.h"
#include "geometry/harmonics/surface.h"
#include "support/harmonic_shapes.h"

namespace stilb {
namespace {

constexpr std::size_t kRays = 3000, kRaysBySeries = 300;
constexpr int kRepetitions = 5;

struct Ray {
    Vec3 origin, direction;
    struct Met {
        double distance;
        std::size_t cell;
        auto operator<=>(const Met&) const = default;
    };
    std::vector<Met> cells;  ///< whose boxes it meets, from near to far
};

/// Where a ray enters a box; infinity where it does not.
double entry(const Bounds& box, const Ray& ray) {
    double low = 0, high = kInfinity;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double a = (box.min[axis] - ray.origin[axis]) / ray.direction[axis];
        const double b = (box.max[axis] - ray.origin[axis]) / ray.direction[axis];
        low = std::max(low, std::min(a, b));
        high = std::min(high, std::max(a, b));
    }
    return low <= high ? low : kInfinity;
}

/// From outside, aimed at the inside of the sphere around the surface.
std::vector<Ray> rays_to(const geometry::HarmonicCells& cells) {
    std::vector<Bounds> boxes;
    for (std::size_t cell = 0; cell < cells.count(); ++cell) boxes.push_back(cells.bounds_of(cell));
    Numbers numbers(3);
    std::vector<Ray> rays(kRays);
    for (Ray& ray : rays) {
        ray.origin = 4 * numbers.direction();
        ray.direction = normalized((1.3 * numbers.next()) * numbers.direction() - ray.origin);
        for (std::size_t cell = 0; cell < boxes.size(); ++cell) {
            const double distance = entry(boxes[cell], ray);
            if (distance < kInfinity) ray.cells.push_back({distance, cell});
        }
        std::ranges::sort(ray.cells);
    }
    return rays;
}

struct Walk {
    std::size_t calls = 0, hits = 0;
    double time_us = 0;
};

/// Every ray on its way through the boxes until it has hit.
Walk walk(const geometry::HarmonicCells& cells, const std::vector<Ray>& rays) {
    Walk result;
    result.time_us = 1e6 * best_time_s(kRepetitions, [&] {
                         result.calls = result.hits = 0;
                         for (const Ray& ray : rays) {
                             double end = kInfinity;
                             for (const auto& [distance, cell] : ray.cells) {
                                 if (distance > end) break;
                                 ++result.calls;
                                 end = std::min(end, cells.crossing(cell, ray.origin, ray.direction, 0, end));
                             }
                             result.hits += end < kInfinity;
                         }
                     });
    return result;
}

template <typename Cross>
double time_by_series_us(const std::vector<Ray>& rays, const Cross& cross) {
    std::size_t hits = 0;
    const double time_s = best_time_s(2, [&] {
        for (std::size_t i = 0; i < kRaysBySeries; ++i) hits += cross(rays[i]).has_value();
    });
    return hits > 0 ? 1e6 * time_s / kRaysBySeries : 0;
}

void report(const char* name, const geometry::HarmonicSurface& surface) {
    const double start_s = best_time_s(1, [&] { (void)geometry::HarmonicCells(surface); });
    const geometry::HarmonicCells cells(surface);
    const std::vector<Ray> rays = rays_to(cells);
    const Walk all = walk(cells, rays);
    const double roots_us = time_by_series_us(rays, [&](const Ray& ray) {
        return surface.first_crossing(ray.origin, ray.direction, 0, kInfinity);
    });
    const double step = geometry::kMarchedShare * surface.greatest_radius();
    const double march_us = time_by_series_us(rays, [&](const Ray& ray) {
        return march_crossing(surface, ray.origin, ray.direction, 0, kInfinity, step);
    });
    const auto per = [](double sum, std::size_t count) { return sum / static_cast<double>(count); };
    fmt::print("{:6} {:6} {:9.3f} {:7} {:9.2f} {:9.1e} {:6.0f} {:9.1f} {:9.3f} {:9.2f} {:9.1f} {:9.1f}\n",
               name, surface.radius().degree(), start_s, cells.count(),
               static_cast<double>(cells.bytes()) * 1e-6, cells.error(),
               100 * per(static_cast<double>(all.hits), kRays), per(static_cast<double>(all.calls), kRays),
               per(all.time_us, all.calls), per(all.time_us, kRays), roots_us, march_us);
    std::fflush(stdout);
}

}  // namespace
}  // namespace stilb

int main() {
    using namespace stilb;
    fmt::print("{:6} {:>6} {:>9} {:>7} {:>9} {:>9} {:>6} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "relief", "degree",
               "make s", "cells", "MB", "error", "hit %", "calls/ray", "us/call", "us/ray", "roots us",
               "march us");
    for (const int degree : {8, 16, 32, 64}) {
        report("white", rough_surface(degree, 1));
        report("head", head_like_surface(degree, 1));
    }
}
