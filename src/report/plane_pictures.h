// Measured planes in false colours with numbers, all at one scale of lux and one of metres.
#pragma once

#include <span>

#include "report/html.h"
#include "report/measured_plane.h"

namespace stilb::report {

/// A bar of the colours, then a figure for each plane. Nothing where there is none.
Html plane_pictures(std::span<const MeasuredPlane> planes);

}  // namespace stilb::report
