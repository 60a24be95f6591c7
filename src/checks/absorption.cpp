#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "checks/checks.h"
#include "checks/walks.h"
#include "math/sampling.h"
#include "transport/light_sampler.h"

namespace stilb::checks {
namespace {

/// Without surfaces of a higher reflectance nothing needs a look.
constexpr double kBright = 0.995;
/// Rooms that lose a smaller share of their light at each reflection, on average, are named.
constexpr double kLeastLoss = 0.015;
constexpr std::uint64_t kParticles = 64;
constexpr int kReflections = 256;

bool has_bright_surfaces(const Scene& scene) {
    return std::ranges::any_of(scene.objects, [&](const Object& object) {
        return std::ranges::any_of(materials_of(scene, object), [&](MaterialId id) {
            const Material& material = scene.material(id);
            return !is_specular(material) && reflectance_bound(material).max() > kBright;
        });
    });
}

/// The losses of particles of all lamps at their reflections.
struct Losses {
    Rgb lost;  ///< sums over the reflections, in which light that leaves the scene loses all
    double reflections = 0;
    std::vector<std::size_t> meetings;  ///< by object

    explicit Losses(const Scene& scene) : meetings(scene.objects.size()) {}
    /// The mean share that is lost at a reflection, in the band that loses least.
    double mean() const { return reflections > 0 ? std::min({lost[0], lost[1], lost[2]}) / reflections : 1; }
};

/// All surfaces count as diffuse reflectors; through glass and panes every second walk goes on.
void follow(const Scene& scene, const rays::RayCaster& caster, Vec3 origin, Vec3 direction,
            math::SampleStream& stream, Losses& losses) {
    for (int i = 0; i < kReflections; ++i) {
        const auto hit = caster.closest(origin, direction);
        const Rgb reflected = hit ? reflectance_bound(scene.material(hit->material)) : Rgb{};
        losses.lost += Rgb::grey(1) + reflected * -1;
        ++losses.reflections;
        if (!hit) return;
        ++losses.meetings[index_of(hit->object)];
        const auto [u1, u2] = stream.next_two();
        if (transmits(scene.material(hit->material)) && stream.next() < 0.5) {
            origin = hit->lifted_behind();
            continue;
        }
        origin = hit->lifted;
        direction = Frame::around(hit->normal).to_world(math::sample_cosine_hemisphere(u1, u2).direction);
    }
}

std::optional<Losses> find_losses(const Scene& scene, const rays::RayCaster& caster) {
    if (scene.lights.empty() || !has_bright_surfaces(scene)) return std::nullopt;
    const transport::LightSampler lights(scene, caster);
    Losses losses(scene);
    for (std::uint64_t i = 0; i < kParticles; ++i) {
        math::SampleStream stream(math::RandomKey{}, i);
        const transport::EmittedParticle particle = lights.sample_emission(stream);
        follow(scene, caster, particle.origin, particle.direction, stream, losses);
    }
    return losses;
}

std::string most_met(const Losses& losses, const Scene& scene) {
    const auto most = std::ranges::max_element(losses.meetings);
    return scene.objects[static_cast<std::size_t>(most - losses.meetings.begin())].name;
}

constexpr std::string_view kRealSurfaces = "White paint reflects 80 to 90 %, the best white surfaces 99 %.";

std::string endless_text(const Losses& losses, const Scene& scene) {
    return fmt::format(
        "nothing absorbs the light: the surfaces around the lamps reflect all of it (object \"{}\", for "
        "one, has a reflectance of 1), and none gets out. Without a limit on reflections it adds up without "
        "end, and illuminance has no finite value. Lower the reflectances. {}",
        most_met(losses, scene), kRealSurfaces);
}

}  // namespace

std::optional<std::string> endless_light(const Scene& scene, const rays::RayCaster& caster) {
    const auto losses = find_losses(scene, caster);
    if (!losses || losses->mean() > 0) return std::nullopt;
    return endless_text(*losses, scene);
}

std::vector<std::string> absorption_warnings(const Scene& scene, const rays::RayCaster& caster) {
    const auto losses = find_losses(scene, caster);
    if (!losses || losses->mean() >= kLeastLoss) return {};
    if (!(losses->mean() > 0)) return {endless_text(*losses, scene)};
    return {fmt::format(
        "light is reflected about {:.2g} times before it is absorbed or gets out: the surfaces around the "
        "lamps (object \"{}\", for one) keep {:.6g} % of it on average. All values are in inverse proportion "
        "to the rest, {:.2g} %: the smallest error of a reflectance changes them much, and a run takes long. "
        "{}",
        1 / losses->mean(), most_met(*losses, scene), 100 * (1 - losses->mean()), 100 * losses->mean(),
        kRealSurfaces)};
}

}  // namespace stilb::checks
