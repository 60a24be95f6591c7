#pragma once

#include "estimators/estimator_list.h"

namespace stilb {

std::unique_ptr<Estimator> make_particles_estimator(const EstimatorInput& input);
std::unique_ptr<PictureEstimator> make_particles_picture(const PictureInput& input);

}  // namespace stilb
