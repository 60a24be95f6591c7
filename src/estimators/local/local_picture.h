// Pictures by local estimation of the surfaces that are seen (local_estimation.cpp).
#pragma once

#include <memory>

#include "estimators/local/guided_light.h"
#include "estimators/local/local_transport.h"

namespace stilb::estimators {

class LocalPicture {
  public:
    virtual ~LocalPicture() = default;
    virtual std::unique_ptr<const PicturePass> start(const Pass& pass) const = 0;
};

/// Pictures of the problem's camera. `guide` is null where light paths bring all the light. The result keeps
/// references to the arguments.
std::unique_ptr<const LocalPicture> make_local_picture(const LocalTransport& transport,
                                                       const Problem& problem, const GuidedLight* guide);

}  // namespace stilb::estimators
