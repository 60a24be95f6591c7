// A luminous surface whose light on diffuse receivers has a closed form.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lights/solid_angle/projected_solid_angle.h"
#include "rays/ray_caster.h"
#include "rays/shaft_query.h"
#include "scene/scene.h"

namespace stilb::transport {

class UniformLamp {
  public:
    static constexpr std::size_t kMostElements = 32;

    /// Nothing where the light has no closed form, or too many elements for one.
    static std::optional<UniformLamp> of(const Scene& scene, const Light& light, Lift lift);

    const Rgb& luminance_cd_m2() const { return luminance_cd_m2_; }
    /// Of all elements, as if they hid nothing of each other.
    double projected_solid_angle_sr(const lights::LitPoint& at) const;

    /// A point of the front by projected solid angle.
    struct Sample {
        Vec3 lifted;                          ///< shadow rays end here
        double projected_solid_angle_sr = 0;  ///< as above
    };
    std::optional<Sample> sample(const lights::LitPoint& at, math::SampleStream& stream) const;

    /// Whether it is certain that all of the front is seen, through air, from all of the (lifted) points.
    bool is_seen_from(std::span<const Vec3> points, const rays::ShaftQuery& shafts) const {
        return is_convex_ && shafts.is_empty(points, hull_, object_);
    }
    /// Whether it is certain that one face of a box, a rectangle or a disk hides all of the front from the
    /// (lifted) point: such a face is convex, so that it hides what lies between points that it hides.
    bool is_hidden_from(const Vec3& point, const Scene& scene, const rays::RayCaster& caster) const;

  private:
    UniformLamp(ObjectId object, const Rgb& luminance_cd_m2, std::vector<lights::EmitterElement> elements,
                const Lift& lift);
    bool hides_nothing_of_itself() const;
    void add_to_hull(const lights::EmitterElement& element);

    ObjectId object_;
    Rgb luminance_cd_m2_;
    std::vector<lights::EmitterElement> elements_;
    Lift lift_;
    bool is_convex_ = false;
    std::vector<Vec3> hull_;  ///< around all points where shadow rays end
};

}  // namespace stilb::transport
