// What Embree is told of rays, for the files that see Embree.
#pragma once

#include <embree3/rtcore.h>

#include "rays/ray_caster.h"

namespace stilb::rays {

inline RTCIntersectContext context_for(Coherence coherence) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                     : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

}  // namespace stilb::rays
