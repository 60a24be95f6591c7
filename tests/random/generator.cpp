#include "random/generator.h"

namespace stilb::random {

RandomScene generate(std::uint64_t seed, std::uint64_t scene) {
    Draw draw(seed, scene);
    if (draw.chance(0.08)) return generate_exact(draw);
    RandomScene random;
    Draft& draft = random.draft;
    const Site site = add_room(draft, draw, random.kind);
    add_things(draft, draw, site);
    add_lamps(draft, draw, site, random.kind);
    // 96 triangles are tested without a tree.
    if (draw.chance(0.1)) fill_up(draft, draw.one_of<std::size_t>({95, 96, 97}), site);
    add_sensors(draft, draw, site);
    if (draw.chance(0.15)) draft.bounces = draw.one_of({0, 1, 2, 3});
    // By draws of its own, so that what is added here changes nothing else of a scene.
    Draw more(~seed, scene);
    add_extras(draft, more, site, random.kind);
    return random;
}

}  // namespace stilb::random
