// What runs in one scene have in common.
#pragma once

#include <memory>
#include <mutex>
#include <span>

#include "base/monitor.h"
#include "checks/checks.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"

namespace stilb::run {

/// A scene with its acceleration structure, and with what the checks find in it: both are made by the first
/// run that needs them, and kept. Results do not depend on the runs before. May be used from several threads.
/// Keeps references.
class PreparedScene {
  public:
    PreparedScene(const Scene& scene)  // implicit: a scene for one run is prepared by that
        : scene_(scene) {}
    /// `relit`: the scene of `similar` with other lights.
    PreparedScene(const Scene& relit, const PreparedScene& similar) : scene_(relit), similar_(&similar) {}

    const Scene& scene() const { return scene_; }
    /// For light that is measured at these points. Throws as RayCaster's constructor.
    std::shared_ptr<const rays::RayCaster> caster(std::span<const Vec3> measured,
                                                  const Monitor& monitor) const;
    std::shared_ptr<const checks::SceneFindings> findings() const;

  private:
    std::shared_ptr<const rays::RayCaster> last_caster() const;

    const Scene& scene_;
    const PreparedScene* similar_ = nullptr;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const rays::RayCaster> caster_;
    mutable std::shared_ptr<const checks::SceneFindings> findings_;
};

}  // namespace stilb::run
