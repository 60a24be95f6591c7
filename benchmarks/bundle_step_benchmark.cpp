// What a step of ray-bundle iteration costs as patches become more: it should grow no faster than they do.
// One thread; the processor time of OpenGL is that of all threads that its driver takes.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "estimators/patch_light/ray_bundle/bundle_iteration.h"
#include "rooms.h"
#include "stilb/error.h"

namespace stilb {
namespace {

/// The mean processor time of so many steps that all take a while, as directions differ; the first one is
/// left out.
double step_s(const estimators::PatchTransport& transport) {
    const auto patches = static_cast<double>(transport.patches.count());
    const auto steps = static_cast<int>(std::clamp(2e6 / patches, 3., 100.));
    estimators::BundleIteration iteration(transport, {math::RandomKey{1}});
    iteration.step();
    const std::clock_t start = std::clock();
    for (int i = 0; i < steps; ++i) iteration.step();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / steps;
}

void report(const Scene& scene, double count, patches::BufferBackend backend) {
    const rays::RayCaster caster(scene);
    estimators::PatchOptions options;
    options.patch_m = patches::patch_size_m(scene, count);
    options.first_shot.shooting.backend = backend;
    const estimators::PatchTransport transport(scene, caster, options);
    const double time_s = step_s(transport);
    fmt::print("{:26} {:>8} {:10} {:9.2f} {:9.0f}\n", scene.name, name_of(backend), transport.patches.count(),
               1e3 * time_s, 1e9 * time_s / static_cast<double>(transport.patches.count()));
}

void report_all(const Scene& scene, patches::BufferBackend backend) {
    try {
        for (const double count : {1e4, 1e5, 1e6}) report(scene, count, backend);
    } catch (const InputError& error) {
        fmt::print("{}\n", error.what());
    }
}

}  // namespace
}  // namespace stilb

int main() {
    fmt::print(
        "A step of three bundles, incoming first shot, processor time\n{:26} {:>8} {:>10} {:>9} {:>9}\n", "",
        "by", "patches", "ms", "ns each");
    for (const auto backend : {stilb::patches::BufferBackend::rays, stilb::patches::BufferBackend::opengl}) {
        stilb::report_all(stilb::make_room(8), backend);
        stilb::report_all(stilb::make_glossy_room(8), backend);
    }
}
