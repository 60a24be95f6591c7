// The surface of a lamp, as its light is sampled: points by area, or by the solid angle at a receiving point.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/rays.h"
#include "lights/emitter_elements.h"
#include "lights/light_kind.h"
#include "math/sampling.h"

namespace stilb::lights {

class EmitterSurface {
  public:
    EmitterSurface(const Shape& shape, const Lift& lift);

    /// The area that the unit direction `leaving` sees, as if no part hid another [m2].
    double projected_area_m2(const Vec3& leaving) const;

    /// A point of the whole surface, by area.
    EmitterPoint sample_by_area(const std::array<double, 2>& u) const;
    /// A point of the part that `leaving` sees, by projected area; such a part must exist.
    EmitterPoint sample_projected(const Vec3& leaving, const std::array<double, 2>& u) const;

    struct SeenPoint {
        Vec3 lifted;
        Vec3 direction;  ///< unit, towards the point
        double pdf_per_sr = 0;
        double rough_pdf_per_sr = 0;  ///< as pdf_per_sr() below
    };
    /// Nothing where the sample's front faces away.
    std::optional<SeenPoint> sample_seen(const Vec3& from, const std::array<double, 2>& u) const;
    /// The approximate density of the direction to a point of a triangle (0 for shapes without triangles) in
    /// sample_seen(), for weights.
    double pdf_per_sr(std::uint32_t triangle, const Vec3& position, const Vec3& normal,
                      const Vec3& from) const;

    const Vec3& middle() const { return middle_; }
    /// Of a ball around the middle that holds about all of the surface.
    double radius_m() const { return radius_m_; }

  private:
    /// Of this many elements or fewer, only those whose fronts face the receiver are sampled.
    static constexpr std::size_t kFew = 64;

    bool chooses_facing() const { return elements_.size() > 1 && elements_.size() <= kFew; }
    math::DiscreteChoice choose(const Vec3& from, double u) const;
    double probability(std::size_t element, const Vec3& from) const;
    /// `distance_m`: of the other end of a ray; 0 where a ray starts there.
    Vec3 lifted(const EmitterElement& element, const Vec3& position, const Vec3& normal,
                double distance_m) const {
        return position + lift_.offset_m(position, element.size_m, distance_m) * normal;
    }

    Lift lift_;
    std::vector<EmitterElement> elements_;
    math::DiscreteDistribution by_area_;
    Vec3 middle_;
    double radius_m_ = 0;
};

}  // namespace stilb::lights
