#pragma once

#include "estimators/picture_estimator.h"

namespace stilb {

std::unique_ptr<PictureEstimator> make_path_picture(const PictureInput& input);

}  // namespace stilb
