// Pictures by local estimation of the surfaces that are seen (sub_points.h).
#pragma once

#include <memory>

#include "estimators/local/guess/guided_light.h"
#include "estimators/local/local_transport.h"

namespace stilb::estimators {

class LocalPicture {
  public:
    virtual ~LocalPicture() = default;
    virtual std::unique_ptr<const PicturePass> start(const Pass& pass) const = 0;
};

// Pictures of the problem's camera. The results keep references to the arguments.

/// By light paths.
std::unique_ptr<const LocalPicture> make_local_picture(const LocalTransport& transport,
                                                       const Problem& problem);
/// By a guess of the light and its residual.
std::unique_ptr<const LocalPicture> make_guided_picture(const LocalTransport& transport,
                                                        const Problem& problem, const GuidedLight& guide);

}  // namespace stilb::estimators
