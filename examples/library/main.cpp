// A room with a lamp: the illuminance on a desk, with its error, and a picture.
#include <stilb/stilb.h>

#include <cstdio>
#include <exception>

int main() try {
    stilb::SceneBuilder builder("room");
    builder.material("wall", {{"type", "diffuse"}, {"reflectance", 0.6}})
        .material("oak",
                  {{"type", "plastic"}, {"diffuse", {0.35, 0.22, 0.12}}, {"roughness", 0.2}, {"ior", 1.5}})
        .object("room", {{"shape", "box"}, {"min", {0, 0, 0}}, {"max", {4, 3, 2.5}}, {"material", "wall"}})
        .object("desk",
                {{"shape", "box"}, {"min", {1, 1, 0}}, {"max", {2.6, 1.8, 0.75}}, {"material", "oak"}})
        .light("bulb", {{"type", "point"}, {"position", {2, 1.5, 2.3}}, {"flux", 800}})
        .sensor("desk", {{"type", "grid"},
                         {"corner", {1, 1, 0.75}},
                         {"edge_u", {1.6, 0, 0}},
                         {"edge_v", {0, 0.8, 0}},
                         {"count", {16, 8}}})
        .sensor("door", {{"type", "camera"},
                         {"position", {0.3, 0.3, 1.6}},
                         {"target", {2.5, 2, 0.8}},
                         {"fov", 70},
                         {"resolution", {160, 120}}});
    for (const std::string& problem : validate(builder)) std::printf("warning: %s\n", problem.c_str());

    const stilb::Scene scene = builder.build();
    stilb::Options options = scene.options();
    options.error = 0.01;
    const stilb::Result result = stilb::measure(scene, options);
    const stilb::Estimate& mean = result["desk"].mean;
    std::printf("desk: %.2f lx, 95 %% interval %.2f to %.2f lx\n", mean.value, mean.lower, mean.upper);

    options = {};
    options.paths = 16;
    stilb::render(scene, "door", options).save("door.png");
} catch (const stilb::InputError& error) {  // says what is wrong, where, and what would be right
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
