// The unit and the vertical axis of models that do not state them.
#pragma once

#include <string>
#include <string_view>

#include "base/vec.h"
#include "io/import/import_settings.h"
#include "io/mesh/mesh_file.h"

namespace stilb::io {

struct PlacementGuess {
    UpAxis up = UpAxis::y;
    double scale = 1;  ///< metres per unit
    std::string_view unit = "metres";
    Vec3 size_m;  ///< with z upwards
    /// Why, as clauses: "because ...".
    std::string up_reason, scale_reason;
};

/// The axis and the unit (metre, millimetre, centimetre, inch, foot) that together make the model what models
/// usually are: a storey, a building, furniture ... A door decides about the unit. What the options state is
/// kept.
PlacementGuess guess_placement(const MeshFile& file, const ImportOptions& options = {});

}  // namespace stilb::io
