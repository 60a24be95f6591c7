// Where particles of light from infinity should come in. In proportion to their flux hardly one of them finds
// a court in a scene that something far away makes a thousand times as large.
#pragma once

#include <vector>

#include "lights/light_kind.h"
#include "rays/ray_caster.h"

namespace stilb::transport {

/// Boxes within the scene's around the surfaces from which light may come to the measured points: short walks
/// from these points find them. Where they are close together in a part of a box that has much less surface,
/// it gets most of the particles of that box in proportion to them, and parts of this part likewise. None
/// where nothing is known to be measured, or where that fills the scene.
std::vector<lights::Entry> entries_to(const rays::RayCaster& caster);

}  // namespace stilb::transport
