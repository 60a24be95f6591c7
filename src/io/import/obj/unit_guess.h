// The unit and the vertical axis of models that do not state them.
#pragma once

#include <optional>
#include <string>

#include "io/import/import_settings.h"
#include "io/mesh/mesh_file.h"

namespace stilb::io {

struct UpGuess {
    UpAxis up = UpAxis::y;
    std::string reason;  ///< a sentence
};
/// The axis across which most area lies: floors and ceilings are the largest faces of most rooms. Where that
/// is not clear, the axis along which the model begins at 0.
UpGuess guess_up(const MeshFile& file);

struct ScaleGuess {
    double scale = 1;  ///< metres per unit
    std::string reason;
};
/// The unit (metre, millimetre, centimetre, inch, foot) in which a door is about 2 m high and the whole is as
/// high as a storey or some of them, and no longer than 200 m. `up`: the model's vertical axis.
ScaleGuess guess_scale(const MeshFile& file, UpAxis up);

}  // namespace stilb::io
