#include "run/prepared_scene.h"

#include <algorithm>

namespace stilb::run {

std::shared_ptr<const rays::RayCaster> PreparedScene::caster(std::span<const Vec3> measured,
                                                             const Monitor& monitor) const {
    std::shared_ptr<const rays::RayCaster> known = last_caster();
    if (!known && similar_) known = similar_->caster(measured, monitor);
    auto made = known ? std::make_shared<const rays::RayCaster>(*known, scene_, monitor, measured)
                      : std::make_shared<const rays::RayCaster>(scene_, monitor, measured);
    const std::lock_guard lock(mutex_);
    return caster_ = std::move(made);
}

std::shared_ptr<const rays::RayCaster> PreparedScene::last_caster() const {
    const std::lock_guard lock(mutex_);
    return caster_;
}

std::shared_ptr<const checks::SceneFindings> PreparedScene::findings() const {
    const std::lock_guard lock(mutex_);
    if (!findings_) findings_ = std::make_shared<const checks::SceneFindings>(scene_);
    return findings_;
}

}  // namespace stilb::run
