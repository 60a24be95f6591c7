// The light of each group of lights at the beginning of the walks over patches: emission and first shot.
#pragma once

#include <memory>
#include <vector>

#include "estimators/patch_light/patch_transport.h"
#include "estimators/patch_light/ray_bundle/bundle_iteration.h"
#include "scene/light_groups.h"

namespace stilb::estimators {

/// Keeps a reference to the transport.
class GroupSources {
  public:
    GroupSources(const PatchTransport& transport, const LightGroups& groups);

    /// They refer to this.
    std::vector<BundleSource> sources() const;

  private:
    struct Group {
        std::vector<FloatRgb> first_reflection, emission;  ///< as PatchTransport has them
        std::unique_ptr<FirstShot> first_shot;
        bool has_outside = false;
    };

    void add(std::uint32_t number, const LightGroups& groups);
    void add_light(std::size_t light, Group& group) const;
    /// With the factors of the group's lights alone.
    std::unique_ptr<FirstShot> first_shot_of(std::uint32_t number, const LightGroups& groups) const;

    const PatchTransport& transport_;
    std::vector<Group> groups_;
};

}  // namespace stilb::estimators
