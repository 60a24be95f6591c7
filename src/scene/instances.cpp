#include "scene/instances.h"

namespace stilb::scene {

bool are_instances(std::size_t triangles, std::size_t uses) {
    constexpr std::size_t kSaved = 100'000;  // with the ray caster's data about 20 MB
    return uses > 1 && (uses - 1) * triangles >= kSaved;
}

void make_own_mesh(Object& object) {
    if (const auto* instance = std::get_if<Instance>(&object.shape)) object.shape = triangulated(*instance);
}

}  // namespace stilb::scene
