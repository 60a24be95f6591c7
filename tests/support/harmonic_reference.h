// All crossings of a ray and a surface by spherical harmonics, by small steps along the ray: code of its own,
// which shares nothing with the methods under test but HarmonicSeries::at().
//
// On the plane of the ray and the origin R is a trigonometric polynomial of degree L, from 2 L + 1 of its
// values, so a step costs little. Steps turn about the origin by an eighth of 1 / (L + 1) at most. Wherever
// the depth |x| - R comes near 0 and goes away again, its extremum is searched for.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/harmonics/surface.h"

namespace stilb {

class ReferenceRay {
  public:
    ReferenceRay(const geometry::HarmonicSurface& surface, const Vec3& origin, const Vec3& direction)
        : greatest_(surface.greatest_radius()), closest_(-dot(origin, direction)) {
        // Across the direction in spite of rounding.
        const Frame frame = Frame::around(direction);
        const Vec3 point = dot(origin, frame.u) * frame.u + dot(origin, frame.v) * frame.v;
        offset_ = length(point);
        const Vec3 towards = offset_ > 0 ? point / offset_ : frame.u;
        const auto terms = static_cast<std::size_t>(surface.radius().degree()) + 1;
        const std::size_t count = 2 * terms - 1;
        cosines_.assign(terms, 0);
        sines_.assign(terms, 0);
        for (std::size_t k = 0; k < count; ++k) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
            const double c = std::cos(angle), s = std::sin(angle);
            const double share =
                surface.radius().at(normalized(c * towards + s * direction)) / static_cast<double>(count);
            double cosine = 1, sine = 0;
            for (std::size_t n = 0; n < terms; ++n) {
                cosines_[n] += (n == 0 ? 1 : 2) * share * cosine;
                sines_[n] += 2 * share * sine;
                const double turned = cosine * c - sine * s;
                sine = sine * c + cosine * s;
                cosine = turned;
            }
        }
    }

    /// How far the point at a distance along the ray is outside, in terms of its distance from the origin.
    double depth(double distance) const {
        const double beyond = distance - closest_, radius = std::hypot(offset_, beyond);
        if (radius == 0) return -std::numeric_limits<double>::min();
        const double c = offset_ / radius, s = beyond / radius;
        double even = 0, odd = 0, even_before = 0, odd_before = 0;  // Clenshaw's sums
        for (std::size_t n = cosines_.size(); n-- > 1;) {
            const double next_even = cosines_[n] + 2 * c * even - even_before;
            const double next_odd = sines_[n] + 2 * c * odd - odd_before;
            even_before = even, even = next_even, odd_before = odd, odd = next_odd;
        }
        return radius - (cosines_[0] + c * even - even_before + s * odd);
    }

    struct Crossing {
        double distance = 0;
        double excursion = 0;  ///< the largest amount of depth before the next crossing
    };
    /// From `start` on.
    std::vector<Crossing> crossings(double start) const {
        const std::vector<Place> path = path_from(start);
        std::vector<Crossing> found;
        for (std::size_t n = 1; n < path.size(); ++n) {
            if (path[n].is_outside() != path[n - 1].is_outside()) {
                found.push_back({between(path[n - 1], path[n]), 0});
            }
            if (found.empty()) continue;
            found.back().excursion = std::max(found.back().excursion, std::abs(path[n].depth));
        }
        return found;
    }

    /// The largest amount of depth on a part of the ray.
    double largest_depth(double from, double to) const {
        double largest = 0;
        for (int i = 0; i <= 64; ++i) {
            largest = std::max(largest, std::abs(depth(from + (to - from) * i / 64)));
        }
        return largest;
    }

  private:
    struct Place {
        double distance = 0, depth = 0;
        bool is_outside() const { return depth > 0; }
        auto operator<=>(const Place&) const = default;
    };
    Place place(double distance) const { return {distance, depth(distance)}; }

    /// Steps and extrema.
    std::vector<Place> path_from(double start) const {
        const double squared = greatest_ * greatest_ - offset_ * offset_;
        if (squared <= 0) return {};
        const double reach = 1.001 * std::sqrt(squared);
        const double from = std::max(start, closest_ - reach), to = closest_ + reach;
        if (from >= to) return {};
        std::vector<double> distances{from, to};
        const auto include = [&](double distance) {
            if (from < distance && distance < to) distances.push_back(distance);
        };
        constexpr int steps = 128;
        for (int n = 1; n < steps; ++n) include(from + (to - from) * n / steps);
        const double turn = 0.125 / static_cast<double>(cosines_.size());
        for (double angle = -0.5 * std::numbers::pi; angle < 0.5 * std::numbers::pi; angle += turn) {
            include(closest_ + offset_ * std::tan(angle));
        }
        std::ranges::sort(distances);
        std::vector<Place> path;
        for (const double distance : distances) path.push_back(place(distance));
        const std::size_t count = path.size();
        path.push_back(nearest(path[0], path[1]));
        path.push_back(nearest(path[count - 2], path[count - 1]));
        for (std::size_t n = 1; n + 1 < count; ++n) {
            const double here = std::abs(path[n].depth);
            const bool is_dip = here <= std::abs(path[n - 1].depth) && here <= std::abs(path[n + 1].depth);
            if (is_dip && here < 0.03 * greatest_) path.push_back(nearest(path[n - 1], path[n + 1]));
        }
        std::ranges::sort(path);
        return path;
    }

    /// Where the depth comes nearest to the other side's, by golden sections.
    Place nearest(const Place& from, const Place& to) const {
        const double sign = from.is_outside() ? 1 : -1, golden = std::numbers::phi - 1;
        double low = from.distance, high = to.distance;
        Place left = place(high - golden * (high - low)), right = place(low + golden * (high - low));
        for (int i = 0; i < 45; ++i) {
            if (sign * left.depth < sign * right.depth) {
                high = right.distance, right = left;
                left = place(high - golden * (high - low));
            } else {
                low = left.distance, left = right;
                right = place(low + golden * (high - low));
            }
        }
        return left;
    }

    double between(const Place& from, const Place& to) const {
        double low = from.distance, high = to.distance, middle = 0.5 * (low + high);
        for (; low < middle && middle < high; middle = 0.5 * (low + high)) {
            (place(middle).is_outside() == from.is_outside() ? low : high) = middle;
        }
        return high;
    }

    std::vector<double> cosines_, sines_;
    double greatest_, closest_, offset_ = 0;
};

}  // namespace stilb
