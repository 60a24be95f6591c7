// The reader of solutions: any contents give an InputError, or a solution that stays the same when it is
// written and read again, and that fits a scene or does not.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "io/results/solution_file.h"
#include "materials/diffuse.h"
#include "materials/phong.h"
#include "stilb/error.h"

namespace {

/// The scene of the corpus: a box of two materials with a lamp.
stilb::Scene lamp_in_box() {
    stilb::Scene scene;
    scene.materials.push_back({"wall", stilb::Diffuse{stilb::Rgb::grey(0.5)}});
    scene.materials.push_back({"floor", stilb::Phong{stilb::Rgb::grey(0.3), stilb::Rgb::grey(0.4), 5}});
    scene.objects.push_back({"room", stilb::Box{{0, 0, 0}, {2, 2, 2}}, {stilb::MaterialId{0}}});
    scene.objects.push_back(
        {"floor", stilb::Rectangle{{0, 0, 0.1}, {2, 0, 0}, {0, 2, 0}}, {stilb::MaterialId{1}}});
    scene.lights.push_back({"lamp", stilb::PointLight{{1, 1, 1.5}, stilb::Rgb::grey(100)}});
    return scene;
}

}  // namespace

/// The input is the contents before compression.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const stilb::Scene scene = lamp_in_box();
    const std::string_view body(reinterpret_cast<const char*>(data), size);
    const std::string bytes = stilb::io::solution_file_of(body);
    stilb::io::StoredSolution stored;
    try {
        stored = stilb::io::read_solution(bytes, "fuzzed");
    } catch (const stilb::InputError& error) {
        if (!std::string_view(error.what()).starts_with("fuzzed:")) std::abort();
        return 0;
    }
    // The first writing may choose other steps for the light than the contents had.
    const std::string written =
        stilb::io::to_bytes(stilb::io::read_solution(stilb::io::to_bytes(stored), ""));
    if (stilb::io::to_bytes(stilb::io::read_solution(written, "")) != written) std::abort();
    try {
        stilb::estimators::require_consistency(stored.solution, scene);
    } catch (const stilb::InputError&) {
    }
    return 0;
}
