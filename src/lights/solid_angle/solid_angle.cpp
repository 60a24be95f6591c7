// Sampling of emitters by the solid angle that they subtend at a point.
//
// Where the solid angle is too small for the spherical formulas to be exact in double precision, points are
// are sampled uniformly by area instead; the density of their direction is then d^2 / (cos A). Both
// techniques are unbiased.
#include "lights/solid_angle/solid_angle.h"

#include <algorithm>
#include <cmath>

namespace stilb::lights {
namespace {

/// The threshold of edge-on views: a point nearer to an emitter's plane than this share of its distance
/// counts as in the plane, because rounding decides on its side.
constexpr double kEdgeOn = 1e-12;
/// Edges count as right-angled up to this cosine.
constexpr double kRightAngle = 1e-9;
/// [sr] Smaller spherical triangles are sampled by area.
constexpr double kSmallestTriangle = 1e-9;
/// The solid angle of a rectangle is a difference of two angles. It is exact to about 1e-16 of these, so
/// below this share of them rectangles are sampled by area.
constexpr double kSmallestRectangle = 1e-6;

/// The direction density of a point drawn uniformly from `area_m2` of a plane at `height_m` from the
/// observer.
double area_pdf_per_sr(double distance_m, double height_m, double area_m2) {
    return distance_m * distance_m * distance_m / (height_m * area_m2);
}

/// u conditioned on lying in [lower, lower + width), stretched to [0, 1].
double rescaled(double u, double lower, double width) { return std::min((u - lower) / width, 1.0); }

/// (sqrt(p^2 q^2) + r) for p^2 q^2 - r^2 = difference >= 0, without cancellation where r is negative.
double stable_sum(double product, double r, double difference) {
    return r >= 0 ? product + r : difference / (product - r);
}

/// A triangle as seen from the origin, not edge-on: vertex a and the edges from there, so that far triangles
/// keep their digits. The subdivision is that of [Arvo 1995]; the half-angle form of the solid angle [Van
/// Oosterom, Strackee 1983] replaces his angles, as it keeps small triangles exact. Points are given by their
/// offset from a.
class SphericalTriangle {
  public:
    SphericalTriangle(const Vec3& a, const Vec3& edge_ab, const Vec3& edge_ac)
        : a_(a),
          ab_(edge_ab),
          ac_(edge_ac),
          b_(a + edge_ab),
          c_(a + edge_ac),
          a_length_(length(a_)),
          b_length_(length(b_)),
          c_length_(length(c_)),
          a_cross_b_(cross(a, ab_)),
          a_cross_c_(cross(a, ac_)),
          normal_(cross(ab_, ac_)),
          determinant_(dot(a, normal_)) {
        const double denominator = a_length_ * b_length_ * c_length_ + dot(a_, b_) * c_length_ +
                                   dot(a_, c_) * b_length_ + dot(b_, c_) * a_length_;
        solid_angle_sr_ = 2 * std::atan2(std::abs(determinant_), denominator);
    }

    bool is_edge_on() const {
        return std::abs(determinant_) <=
               kEdgeOn * length(normal_) * std::max({a_length_, b_length_, c_length_});
    }
    double solid_angle_sr() const { return solid_angle_sr_; }
    double area_m2() const { return length(normal_) / 2; }
    double height_m() const { return std::abs(determinant_) / length(normal_); }

    Vec3 offset_by_area(double u1, double u2) const {
        const math::Barycentric share = math::sample_triangle(u1, u2);
        return share.b1 * ab_ + share.b2 * ac_;
    }

    Vec3 offset_by_solid_angle(double u1, double u2) const {
        const Vec3 unit_b = b_ / b_length_;
        const Vec3 from_b = direction_on_side(u1) - unit_b;
        // Uniform in the cosine along the arc from b: 1 - cos is proportional to u2.
        const double full = squared_length(from_b) / 2;
        if (full == 0) return ab_;
        const double one_minus_cos = u2 * full;
        const Vec3 towards_side = normalized(from_b + full * unit_b);
        return projected((1 - one_minus_cos) * unit_b +
                         std::sqrt(one_minus_cos * (2 - one_minus_cos)) * towards_side);
    }

  private:
    /// The direction on the arc from a to c that cuts off the share u of the solid angle on a's side: with t
    /// the tangent of half the arc, tan(u solid_angle / 2) = t D / (1 + a.b + t b.tangent), D = det(a, b,
    /// tangent).
    Vec3 direction_on_side(double u) const {
        const double sine = std::sin(u * solid_angle_sr_ / 2);
        const double cosine = std::cos(u * solid_angle_sr_ / 2);
        const Vec3 tangent = normalized(cross(a_cross_c_, a_));
        const double one_plus_cos_ab =
            stable_sum(a_length_ * b_length_, dot(a_, b_), squared_length(a_cross_b_)) / a_length_;
        const double opposite = sine * one_plus_cos_ab;
        const double adjacent =
            cosine * std::abs(determinant_) / length(a_cross_c_) - sine * dot(ab_, tangent);
        const double squares = adjacent * adjacent + opposite * opposite;
        return (adjacent - opposite) * (adjacent + opposite) / squares / a_length_ * a_ +
               2 * adjacent * opposite / squares * tangent;
    }

    /// The point where `direction` meets the triangle, by barycentric coordinates: rounding cannot move it
    /// out of the triangle.
    Vec3 projected(const Vec3& direction) const {
        const double side = std::copysign(1.0, determinant_);
        const double at_a = std::max(0.0, side * dot(direction, cross(b_, ac_ - ab_)));
        const double at_b = std::max(0.0, -side * dot(direction, a_cross_c_));
        const double at_c = std::max(0.0, side * dot(direction, a_cross_b_));
        const double sum = at_a + at_b + at_c;
        return sum > 0 ? (at_b * ab_ + at_c * ac_) / sum : ab_;
    }

    Vec3 a_, ab_, ac_, b_, c_;
    double a_length_, b_length_, c_length_;
    Vec3 a_cross_b_, a_cross_c_, normal_;
    double determinant_;
    double solid_angle_sr_ = 0;
};

/// An extent along an axis, mirrored where needed so that its middle is not negative.
struct MirroredRange {
    double width;
    bool mirrored;
    double low, high;

    MirroredRange(double start, double extent)
        : width(extent),
          mirrored(start + extent / 2 < 0),
          low(mirrored ? -(start + extent) : start),
          high(mirrored ? -start : start + extent) {}
    double u_in_range(double u) const { return mirrored ? 1 - u : u; }
    /// Share of the extent from its unmirrored start.
    double share(double x) const { return (mirrored ? high - x : x - low) / width; }
};

/// The rectangle [x.low, x.high] x [y.low, y.high] at height h > 0 over the origin. The subdivision is that
/// of [Urena, Fajardo, King 2013]: x by the solid angle, then y uniformly in the sine. The inversion is
/// written with half-angles, as theirs loses all digits where the rectangle is far or seen at a grazing
/// angle.
class SphericalRectangle {
  public:
    SphericalRectangle(const MirroredRange& x, const MirroredRange& y, double height)
        : x_(x), y_(y), h_(height), angle_low_(angle(x.low)), angle_high_(angle(x.high)) {}

    double solid_angle_sr() const { return angle_high_ - angle_low_; }
    bool is_too_small() const {
        return solid_angle_sr() <= kSmallestRectangle * std::max(std::abs(angle_low_), std::abs(angle_high_));
    }

    /// Inverse of angle(): with s = sin(angle / 2), x = h s cos(angle / 2) / sqrt((A - s^2) (B - s^2)), where
    /// A = sin^2((b1 - b0) / 2), B = cos^2((b1 + b0) / 2) and tan(b) = y / h at both ends of y.
    double sample_x(double u) const {
        const double half = (angle_low_ + u * solid_angle_sr()) / 2;
        const double sine = std::sin(half);
        const double h2 = h_ * h_;
        const double product = std::sqrt((y_.low * y_.low + h2) * (y_.high * y_.high + h2));
        const double dot_product = h2 + y_.low * y_.high;
        const double mirrored_product = h2 - y_.low * y_.high;
        const double width = h_ * y_.width;
        const double sum = h_ * (y_.high + y_.low);
        const double a = stable_sum(product, -dot_product, width * width) / (2 * product) - sine * sine;
        const double b = stable_sum(product, mirrored_product, sum * sum) / (2 * product) - sine * sine;
        const double root = std::sqrt(std::max(a, 0.0) * std::max(b, 0.0));
        return std::clamp(h_ * sine * std::cos(half) / root, x_.low, x_.high);
    }

    /// 1 - sin of the elevation along y is uniform; with a middle above 0 this keeps its digits.
    double sample_y(double x, double u) const {
        const double d2 = x * x + h_ * h_;
        const double low = one_minus_sine(y_.low, d2);
        const double value = low + u * (one_minus_sine(y_.high, d2) - low);
        return std::clamp(std::sqrt(d2 / (value * (2 - value))) * (1 - value), y_.low, y_.high);
    }

  private:
    /// Solid angle of the strip from 0 to x (negative for negative x): the sum over its corners of
    /// atan(x y / (h r)), merged into one angle.
    double angle(double x) const {
        const double xh2 = x * x + h_ * h_;
        const double r_low = std::sqrt(xh2 + y_.low * y_.low);
        const double r_high = std::sqrt(xh2 + y_.high * y_.high);
        const double sine =
            stable_sum(y_.high * r_low, -y_.low * r_high, xh2 * y_.width * (y_.high + y_.low));
        return std::atan2(h_ * x * sine, h_ * h_ * r_low * r_high + x * x * y_.low * y_.high);
    }

    static double one_minus_sine(double y, double d2) {
        const double r = std::sqrt(d2 + y * y);
        return stable_sum(r, -y, d2) / r;
    }

    MirroredRange x_, y_;
    double h_, angle_low_, angle_high_;
};

bool has_right_angles(const Rectangle& r) {
    return std::abs(dot(r.edge_u, r.edge_v)) <= kRightAngle * length(r.edge_u) * length(r.edge_v);
}

std::optional<SolidAngleSample> sample_right_angled(const Rectangle& r, const Vec3& from, double u1,
                                                    double u2) {
    const double width = length(r.edge_u);
    const double depth = length(r.edge_v);
    const Vec3 to_corner = r.corner - from;
    const MirroredRange x(dot(to_corner, r.edge_u) / width, width);
    const MirroredRange y(dot(to_corner, r.edge_v) / depth, depth);
    const double height = std::abs(dot(to_corner, cross(r.edge_u, r.edge_v))) / (width * depth);
    if (height <= kEdgeOn * std::max(x.high, y.high)) return std::nullopt;

    const SphericalRectangle seen(x, y, height);
    if (seen.is_too_small()) {
        const Vec3 point = r.corner + u1 * r.edge_u + u2 * r.edge_v;
        return SolidAngleSample{point, area_pdf_per_sr(length(point - from), height, width * depth)};
    }
    const double at_x = seen.sample_x(x.u_in_range(u1));
    const double at_y = seen.sample_y(at_x, y.u_in_range(u2));
    return SolidAngleSample{r.corner + x.share(at_x) * r.edge_u + y.share(at_y) * r.edge_v,
                            1 / seen.solid_angle_sr()};
}

/// As two triangles, each chosen by its share of the solid angle.
std::optional<SolidAngleSample> sample_skewed(const Rectangle& r, const Vec3& from, double u1, double u2) {
    const Vec3 to_corner = r.corner - from;
    const Vec3 diagonal = r.edge_u + r.edge_v;
    const SphericalTriangle first(to_corner, r.edge_u, diagonal);
    const SphericalTriangle second(to_corner, r.edge_v, diagonal);
    if (first.is_edge_on() && second.is_edge_on()) return std::nullopt;
    const double total_sr = first.solid_angle_sr() + second.solid_angle_sr();
    if (total_sr < kSmallestTriangle) {
        const Vec3 point = r.corner + u1 * r.edge_u + u2 * r.edge_v;
        return SolidAngleSample{point,
                                area_pdf_per_sr(length(point - from), first.height_m(), 2 * first.area_m2())};
    }
    const double first_share = first.solid_angle_sr() / total_sr;
    const Vec3 offset = u1 < first_share
                            ? first.offset_by_solid_angle(rescaled(u1, 0, first_share), u2)
                            : second.offset_by_solid_angle(rescaled(u1, first_share, 1 - first_share), u2);
    return SolidAngleSample{r.corner + offset, 1 / total_sr};
}

}  // namespace

std::optional<SolidAngleSample> sample_by_solid_angle(const Sphere& sphere, const Vec3& from, double u1,
                                                      double u2) {
    const Vec3 to_center = sphere.center - from;
    const double distance = length(to_center);
    if (distance <= sphere.radius) return std::nullopt;
    const double sin_max = sphere.radius / distance;
    const double cos_max = std::sqrt((distance - sphere.radius) * (distance + sphere.radius)) / distance;
    const double one_minus_cos_max = sin_max * sin_max / (1 + cos_max);

    // Cone direction at angle theta to the axis, q = sin^2(theta) / sin^2(theta_max); then the angle at the
    // centre between the axis and the point hit, from which the point lies on the sphere to full precision.
    const double one_minus_cos = u1 * one_minus_cos_max;
    const double q = std::min(u1 * (2 - one_minus_cos) / (1 + cos_max), 1.0);
    const double half_chord = std::sqrt(1 - q);
    const double cos_at_center = q * sin_max + (1 - one_minus_cos) * half_chord;
    const double sin_at_center = std::sqrt(q) * (1 - one_minus_cos - sin_max * half_chord);
    const double phi = 2 * kPi * u2;
    const Frame frame = Frame::around(to_center / -distance);
    const Vec3 normal =
        frame.to_world({sin_at_center * std::cos(phi), sin_at_center * std::sin(phi), cos_at_center});
    return SolidAngleSample{sphere.center + sphere.radius * normal, 1 / (2 * kPi * one_minus_cos_max)};
}

std::optional<SolidAngleSample> sample_by_solid_angle(const Rectangle& rectangle, const Vec3& from, double u1,
                                                      double u2) {
    return has_right_angles(rectangle) ? sample_right_angled(rectangle, from, u1, u2)
                                       : sample_skewed(rectangle, from, u1, u2);
}

std::optional<SolidAngleSample> sample_by_solid_angle(const std::array<Vec3, 3>& triangle, const Vec3& from,
                                                      double u1, double u2) {
    const Vec3& a = triangle[0];
    const SphericalTriangle seen(a - from, triangle[1] - a, triangle[2] - a);
    if (seen.is_edge_on()) return std::nullopt;
    if (seen.solid_angle_sr() >= kSmallestTriangle) {
        return SolidAngleSample{a + seen.offset_by_solid_angle(u1, u2), 1 / seen.solid_angle_sr()};
    }
    const Vec3 point = a + seen.offset_by_area(u1, u2);
    return SolidAngleSample{point, area_pdf_per_sr(length(point - from), seen.height_m(), seen.area_m2())};
}

std::optional<SolidAngleSample> sample_by_solid_angle(const Disk& disk, const Vec3& from, double u1,
                                                      double u2) {
    const Frame frame = Frame::around(disk.normal);
    const Rectangle square{disk.center - disk.radius * (frame.u + frame.v), 2 * disk.radius * frame.u,
                           2 * disk.radius * frame.v};
    const auto sample = sample_right_angled(square, from, u1, u2);
    if (!sample || length(sample->point - disk.center) > disk.radius) return std::nullopt;
    return sample;
}

}  // namespace stilb::lights
