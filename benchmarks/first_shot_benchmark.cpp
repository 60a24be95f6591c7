// First shot: how long each variant takes to set up, what it stores, and how long one query takes, in a
// furnished room with ten small lights, where all surfaces are diffuse or all are glossy. All processors set
// up by rays; OpenGL takes whatever its driver does. Queries are one thread's.
#include <fmt/format.h>

#include <vector>

#include "best_time.h"
#include "estimators/patch_light/first_shot/first_shot.h"
#include "rooms.h"
#include "stilb/error.h"

namespace stilb {
namespace {

constexpr std::size_t kQueries = 100'000;

/// A panel and nine points, all of which are replaced.
void light(Scene& scene) {
    for (int i = 0; i < 8; ++i) {
        scene.lights.push_back({"", PointLight{{0.5 + 0.4 * i, 3.4 - 0.3 * i, 2}, Rgb::grey(40)}});
    }
    scene.objects.push_back(
        {"panel", Rectangle{{1.8, 1.8, 2.98}, {0, 0.2, 0}, {0.2, 0, 0}}, {MaterialId{0}}});
    const ObjectId panel{static_cast<std::uint32_t>(scene.objects.size() - 1)};
    scene.lights.push_back({"", AreaLight{panel, Rgb::grey(3000)}});
}

struct Query {
    std::uint32_t side = 0;
    Vec3 position, out;
};

std::vector<Query> queries(const patches::Patches& patches) {
    std::vector<Query> all;
    for (std::uint64_t i = 0; i < kQueries; ++i) {
        math::SampleStream stream(math::RandomKey{1}, i);
        const double sides = 2 * static_cast<double>(patches.count());
        const auto side = static_cast<std::uint32_t>(stream.next() * sides);
        const auto [u1, u2] = stream.next_two();
        const Vec3 local = math::sample_cosine_hemisphere(u1, u2).direction;
        all.push_back({side, patches.middle(patches.patch_of(side)),
                       Frame::around(patches.normal_of(side)).to_world(local)});
    }
    return all;
}

double query_us(const estimators::FirstShotPatches& patches) {
    const std::vector<Query> all = queries(patches.patches);
    Rgb sum;
    const double time_s = best_time_s(3, [&] {
        for (const auto& [side, position, out] : all) {
            sum += patches.first_shot.reflected(side, position, {}, out);
        }
    });
    return sum.is_finite() ? 1e6 * time_s / static_cast<double>(kQueries) : 0;
}

void report(const Scene& scene, double count, estimators::FirstShotVariant variant,
            patches::BufferBackend backend) {
    const rays::RayCaster caster(scene);
    estimators::PatchOptions options;
    options.patch_m = patches::patch_size_m(scene, count);
    options.first_shot.variant = variant;
    options.first_shot.shooting.backend = backend;
    const estimators::FirstShotPatches patches(scene, caster, options);
    const estimators::PatchReport report = patches.report();
    fmt::print("{:22} {:>10} {:10} {:>10} {:>8} {:9.3f} {:9.1f} {:9.3f}\n", scene.name, name_of(variant),
               report.count, report.resolution.value_or(0), name_of(backend), report.set_up_s,
               report.bytes_per_patch, query_us(patches));
}

void report_all(Scene scene) {
    light(scene);
    for (const double count : {1e4, 1e5}) {
        for (const patches::BufferBackend backend :
             {patches::BufferBackend::rays, patches::BufferBackend::opengl}) {
            for (const estimators::FirstShotVariant variant :
                 {estimators::FirstShotVariant::classical, estimators::FirstShotVariant::diffuse,
                  estimators::FirstShotVariant::incoming}) {
                try {
                    report(scene, count, variant, backend);
                } catch (const InputError& error) {  // there is no OpenGL
                    fmt::print("{}\n", error.what());
                }
            }
        }
        report(scene, count, estimators::FirstShotVariant::on_the_fly, patches::BufferBackend::rays);
    }
}

}  // namespace
}  // namespace stilb

int main() {
    fmt::print("{:22} {:>10} {:>10} {:>10} {:>8} {:>9} {:>9} {:>9}\n", "", "variant", "patches", "resolution",
               "by", "set-up s", "bytes", "query us");
    for (const stilb::Scene& scene : {stilb::make_room(8), stilb::make_glossy_room(8)})
        stilb::report_all(scene);
}
