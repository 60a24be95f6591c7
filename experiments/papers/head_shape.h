// A human head, made up of formulas: the mesh that `stilb reproduce harmonics` shows when it is given none.
#pragma once

#include "base/vec.h"
#include "geometry/shape.h"

namespace stilb::papers {

/// The distance [m] of the surface from a point between the ears, in a unit direction: y is up, the face
/// looks along z. Above 0 everywhere, so the head is star-shaped about the origin.
double head_radius(const Vec3& direction);

/// Its points where 154 meridians meet 106 parallels about y, and its poles: 32 648 faces, where
/// [LocalEstimation 6] has 32 654; closed, fronts outside.
Mesh head_mesh();

}  // namespace stilb::papers
