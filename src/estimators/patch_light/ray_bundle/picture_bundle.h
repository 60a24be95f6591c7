#pragma once

#include "estimators/picture_estimator.h"

namespace stilb {

std::unique_ptr<PictureEstimator> make_ray_bundle_picture(const PictureInput& input);

}  // namespace stilb
