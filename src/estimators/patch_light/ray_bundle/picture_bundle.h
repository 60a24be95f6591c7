#pragma once

#include "estimators/picture_estimator.h"

namespace stilb::estimators {

std::unique_ptr<PictureEstimator> make_ray_bundle_picture(const PictureInput& input);

}  // namespace stilb::estimators
