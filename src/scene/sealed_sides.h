// The insides of closed bodies, which no light reaches.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace stilb::scene {

/// A side of a whole object.
struct ObjectSide {
    ObjectId object{};
    bool is_front = true;

    /// The front of object i is 2 i, its back 2 i + 1.
    std::size_t number() const { return 2 * std::size_t{index_of(object)} + (is_front ? 0 : 1); }
};

/// By ObjectSide::number(): whether it is the inside of a closed, opaque body without a light inside of its
/// bounds. Walks over patches cannot tell: where a body stands on a patch, its inside gets light of the
/// covered part.
std::vector<bool> sealed_sides(const Scene& scene);

}  // namespace stilb::scene

namespace stilb {
using scene::ObjectSide;
using scene::sealed_sides;
}  // namespace stilb
