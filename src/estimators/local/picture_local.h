#pragma once

#include "estimators/picture_estimator.h"

namespace stilb::estimators {

/// Double local estimation of pictures as published, and balanced with path tracing; see picture_local.cpp.
std::unique_ptr<PictureEstimator> make_local_picture(const PictureInput& input);
std::unique_ptr<PictureEstimator> make_auto_picture(const PictureInput& input);

}  // namespace stilb::estimators
