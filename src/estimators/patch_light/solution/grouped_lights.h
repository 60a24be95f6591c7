// The lights of a scene, apart by groups: the light of each group at a point.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "math/random.h"
#include "rays/ray_caster.h"
#include "scene/light_groups.h"
#include "transport/light_sampler.h"

namespace stilb::estimators {

/// Keeps references to scene and caster. Immutable.
class GroupedLights {
  public:
    /// `counts`: whether a light (of Scene::lights) is one of them; others give no light.
    GroupedLights(const Scene& scene, const rays::RayCaster& caster, const LightGroups& groups,
                  const std::function<bool(std::size_t)>& counts);

    /// Adds to each group the direct light that a surface reflects towards the unit `out` [cd/m2], shadows
    /// included: one sample of each of its lights, or of some where they are many.
    void add_reflected(const rays::Hit& surface, const Vec3& out, math::SampleStream& stream,
                       std::span<Rgb> of_groups) const;

  private:
    struct Group {
        std::vector<std::size_t> lights;
        /// Chooses among them where they are many.
        std::unique_ptr<transport::LightSampler> sampler;
    };

    const Scene& scene_;
    const rays::RayCaster& caster_;
    transport::LightSampler lights_;
    std::vector<Group> groups_;
};

}  // namespace stilb::estimators
