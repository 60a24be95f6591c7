// A human head, made up of formulas: the mesh that `stilb reproduce harmonics` shows when it is given none.
#pragma once

#include "base/vec.h"
#include "scene/shape.h"

namespace stilb {

/// The distance [m] of the surface from a point between the ears, in a unit direction: y is up, the face
/// looks along z. Above 0 everywhere, so the head is star-shaped about the origin.
double head_radius(const Vec3& direction);

/// Its points on 107 parallels about y with 154 meridians: 32 648 faces, as nearly as parallels allow the
/// 32 654 of [LocalEstimation 6]; closed, fronts outside.
Mesh head_mesh();

}  // namespace stilb
