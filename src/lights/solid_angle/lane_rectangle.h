// Right-angled rectangles and points as lights, in single precision and without branches: for loops over the
// lanes of packets. Coordinates are relative to any centre close by.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/lane_functions.h"

namespace stilb::lights {

struct LanePoint {
    float x = 0, y = 0, z = 0;
};
STILB_INLINED LanePoint operator-(const LanePoint& a, const LanePoint& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
STILB_INLINED LanePoint operator+(const LanePoint& a, const LanePoint& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
STILB_INLINED LanePoint operator*(float s, const LanePoint& a) { return {s * a.x, s * a.y, s * a.z}; }
STILB_INLINED float dot(const LanePoint& a, const LanePoint& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// The rectangle [0, width] x [0, depth] seen from height `h` over the point at (-x, -y): the solid angle and
/// its subdivision of solid_angle.cpp, in single precision.
class LaneSolidAngle {
  public:
    STILB_INLINED LaneSolidAngle(float x, float width, float y, float depth, float h)
        : x_mirrored_(x + width / 2 < 0),
          y_mirrored_(y + depth / 2 < 0),
          x_low_(x_mirrored_ ? -(x + width) : x),
          x_high_(x_mirrored_ ? -x : x + width),
          y_low_(y_mirrored_ ? -(y + depth) : y),
          y_high_(y_mirrored_ ? -y : y + depth),
          depth_(depth),
          h_(h),
          angle_low_(angle(x_low_)),
          angle_high_(angle(x_high_)) {}

    STILB_INLINED float sr() const { return angle_high_ - angle_low_; }

    /// Uniform over the solid angle, from the rectangle's corner.
    STILB_INLINED std::array<float, 2> sample(float u1, float u2) const {
        const float x = sample_x(x_mirrored_ ? 1 - u1 : u1);
        const float y = sample_y(x, y_mirrored_ ? 1 - u2 : u2);
        return {x_mirrored_ ? x_high_ - x : x - x_low_, y_mirrored_ ? y_high_ - y : y - y_low_};
    }

  private:
    STILB_INLINED static float stable_sum(float product, float r, float difference) {
        const float quotient = difference / (product - r);
        return r >= 0 ? product + r : quotient;
    }
    STILB_INLINED static float one_minus_sine(float y, float d2) {
        const float r = std::sqrt(d2 + y * y);
        return stable_sum(r, -y, d2) / r;
    }
    STILB_INLINED float angle(float x) const {
        const float xh2 = x * x + h_ * h_;
        const float r_low = std::sqrt(xh2 + y_low_ * y_low_), r_high = std::sqrt(xh2 + y_high_ * y_high_);
        const float sine = stable_sum(y_high_ * r_low, -y_low_ * r_high, xh2 * depth_ * (y_high_ + y_low_));
        return math::lane_atan2(h_ * x * sine, h_ * h_ * r_low * r_high + x * x * y_low_ * y_high_);
    }
    STILB_INLINED float sample_x(float u) const {
        const auto [sine, cosine] = math::lane_sine_cosine((angle_low_ + u * sr()) / 2);
        const float h2 = h_ * h_;
        const float product = std::sqrt((y_low_ * y_low_ + h2) * (y_high_ * y_high_ + h2));
        const float width = h_ * depth_, sum = h_ * (y_high_ + y_low_);
        const float a =
            stable_sum(product, -(h2 + y_low_ * y_high_), width * width) / (2 * product) - sine * sine;
        const float b = stable_sum(product, h2 - y_low_ * y_high_, sum * sum) / (2 * product) - sine * sine;
        const float root = std::sqrt(std::max(a, 0.0f) * std::max(b, 0.0f));
        const float x = h_ * sine * cosine / root;
        return std::min(std::max(x, x_low_), x_high_);
    }
    STILB_INLINED float sample_y(float x, float u) const {
        const float d2 = x * x + h_ * h_;
        const float low = one_minus_sine(y_low_, d2);
        const float value = low + u * (one_minus_sine(y_high_, d2) - low);
        const float y = std::sqrt(d2 / (value * (2 - value))) * (1 - value);
        return std::min(std::max(y, y_low_), y_high_);
    }

    bool x_mirrored_, y_mirrored_;
    float x_low_, x_high_, y_low_, y_high_, depth_, h_, angle_low_, angle_high_;
};

/// A point x u + y v from a rectangle's corner.
struct LaneLightSample {
    float x = 0, y = 0;
    /// Of the direction to it; 0 where the light's front faces away.
    float pdf_per_sr = 0;
};

/// Sampled by the solid angle where that is large, else by area.
struct LaneRectangle {
    LanePoint corner, u, v, normal;  ///< unit vectors; the front's normal
    float width = 0, depth = 0;

    /// Below this share of a steradian the solid angle, a difference of angles, is not exact enough.
    static constexpr float kLeast_sr = 0.01f;

    /// The solid angle where points are sampled by it, else 0.
    STILB_INLINED float sampled_sr(const LaneSolidAngle& seen, const LanePoint& to_corner) const {
        const LanePoint to_middle = to_corner + (width / 2) * u + (depth / 2) * v;
        const float size = std::max(width, depth), sr = seen.sr();
        return dot(to_middle, to_middle) <= 9 * size * size && sr > kLeast_sr ? sr : 0;
    }
    STILB_INLINED LaneSolidAngle seen(const LanePoint& to_corner) const {
        return {dot(to_corner, u), width, dot(to_corner, v), depth, height(to_corner)};
    }
    STILB_INLINED float height(const LanePoint& to_corner) const { return -dot(to_corner, normal); }
    STILB_INLINED float area_pdf_per_sr(const LanePoint& offset, float h) const {
        const float squared = dot(offset, offset);
        return squared * std::sqrt(squared) / (h * width * depth);
    }

    STILB_INLINED LaneLightSample sample(const LanePoint& from, float u1, float u2) const {
        const LanePoint to_corner = corner - from;
        const LaneSolidAngle seen = this->seen(to_corner);
        const float sr = sampled_sr(seen, to_corner), h = height(to_corner);
        const auto [seen_x, seen_y] = seen.sample(u1, u2);
        const float x = sr > 0 ? seen_x : u1 * width, y = sr > 0 ? seen_y : u2 * depth;
        const float by_area = area_pdf_per_sr(to_corner + x * u + y * v, h), by_sr = 1 / sr;
        const float pdf_per_sr = sr > 0 ? by_sr : by_area;
        return {x, y, h > 0 ? pdf_per_sr : 0};
    }
    /// The density of sample() in the direction to a point of the rectangle.
    STILB_INLINED float pdf_per_sr(const LanePoint& from, const LanePoint& point) const {
        const LanePoint to_corner = corner - from;
        const float sr = sampled_sr(seen(to_corner), to_corner), h = height(to_corner);
        if (!(h > 0)) return 0;
        return sr > 0 ? 1 / sr : area_pdf_per_sr(point - from, h);
    }
};

}  // namespace stilb::lights
