// Other forms of a scene that must give the same light.
#pragma once

#include <optional>
#include <string_view>

#include "random/draft.h"
#include "random/draw.h"

namespace stilb::random {

enum class Form {
    as_it_is,
    moved,
    turned,
    mirrored,
    scaled,
    reordered,
    lamps_halved,
    faces_cut,
    other_shapes,
    far_object,
    black_object,
    arrays_written_out,
    as_openings,
    count
};

std::string_view words(Form form);

/// The scene in another form, and the factor from its readings to those of the scene as it is; nothing where
/// the form does not apply. Sensors keep their order.
struct OtherForm {
    Draft draft;
    double factor = 1;
};
std::optional<OtherForm> in_form(const Draft& draft, Form form, Draw& draw);

}  // namespace stilb::random
