// Patches and item buffers: how long a scene takes to become 10,000, 100,000 and 1,000,000 patches, what they
// weigh, and how long both ways need to fill a cube around a place in it. Rays on one thread; OpenGL with
// whatever its driver takes (software on all processors where there is no graphics card).
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "best_time.h"
#include "patches/vertex_interpolation.h"
#include "patches/visibility/item_buffer.h"
#include "patches/visibility/opengl.h"
#include "patches/visibility/patch_caster.h"
#include "rooms.h"
#include "stilb/error.h"

namespace stilb {
namespace {

double bytes_per_patch(const patches::Patches& patches) {
    const auto bytes_of = [](const auto& values) { return values.size() * sizeof values[0]; };
    const std::size_t bytes = bytes_of(patches.vertices) + bytes_of(patches.corners) +
                              bytes_of(patches.normals) + bytes_of(patches.areas_m2) +
                              bytes_of(patches.materials);
    return static_cast<double>(bytes) / static_cast<double>(patches.count());
}

void report_making(const Scene& scene, double size_m) {
    const patches::Patches patches = patches::make_patches(scene, size_m);
    const auto count = static_cast<double>(patches.count());
    const double making_s = best_time_s(3, [&] { patches::make_patches(scene, size_m); });
    const double interpolation_s = best_time_s(3, [&] { patches::VertexInterpolation{patches}; });
    const double caster_s = best_time_s(3, [&] { patches::PatchCaster{patches}; });
    fmt::print("{:10} {:9.3f} {:9.3f} {:9.3f} {:9.1f} {:9.1f}\n", patches.count(), making_s, interpolation_s,
               caster_s, bytes_per_patch(patches),
               static_cast<double>(patches::PatchCaster(patches).bytes()) / count);
}

double filling_ms(patches::ItemBuffers& buffers, int resolution) {
    const patches::ItemBufferLayout layout(patches::BufferShape::cube, resolution);
    std::vector<std::uint32_t> sides(layout.pixel_count());
    const patches::Viewpoint bulb{{2.1, 1.9, 2.4}, Frame::around(normalized(Vec3{1, 2, 3}))};
    return 1e3 * best_time_s(5, [&] { buffers.fill(layout, bulb, sides); });
}

/// Who draws, or why nobody does.
std::string renderer() {
    try {
        return patches::OpenGlItemBuffers(patches::Patches{}).renderer();
    } catch (const InputError& error) {
        return error.what();
    }
}

std::unique_ptr<patches::ItemBuffers> opengl_if_any(const patches::Patches& patches) {
    try {
        return std::make_unique<patches::OpenGlItemBuffers>(patches);
    } catch (const InputError&) {
        return nullptr;
    }
}

void report_filling(const Scene& scene, double size_m) {
    const patches::Patches patches = patches::make_patches(scene, size_m);
    const patches::PatchCaster caster(patches);
    patches::RayItemBuffers rays(caster);
    const auto opengl = opengl_if_any(patches);
    for (const int resolution : {512, 1024}) {
        fmt::print("{:10} {:10} {:9.1f} {:>9}\n", patches.count(), resolution, filling_ms(rays, resolution),
                   opengl ? fmt::format("{:.1f}", filling_ms(*opengl, resolution)) : "-");
    }
}

}  // namespace
}  // namespace stilb

int main() {
    const stilb::Scene scene = stilb::make_room(8);
    const std::vector<double> sizes_m{stilb::patches::patch_size_m(scene, 1e4),
                                      stilb::patches::patch_size_m(scene, 1e5),
                                      stilb::patches::patch_size_m(scene, 1e6)};
    fmt::print("Making, one thread (Embree: all), best of 3   [s, bytes per patch]\n");
    fmt::print("{:>10} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "patches", "patches", "interpol.", "Embree",
               "patches", "Embree");
    for (const double size_m : sizes_m) stilb::report_making(scene, size_m);
    fmt::print("\nFilling a cube, best of 5   [ms]; OpenGL by {}\n", stilb::renderer());
    fmt::print("{:>10} {:>10} {:>9} {:>9}\n", "patches", "resolution", "rays", "OpenGL");
    for (const double size_m : sizes_m) stilb::report_filling(scene, size_m);
}
