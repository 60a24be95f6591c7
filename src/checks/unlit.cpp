#include <algorithm>

#include "checks/checks.h"
#include "math/sampling.h"
#include "transport/light_sampler.h"

namespace stilb::checks {
namespace {

constexpr std::uint64_t kParticles = 4096;
constexpr int kReflections = 3;
constexpr std::uint64_t kPointsOnObject = 64;
/// Lit positions that are tested for each point on an object.
constexpr std::size_t kLocationsTried = 64;
enum Purpose : std::uint64_t { kTracing, kConnecting };

/// A lifted point and the normal on its side.
struct Location {
    Vec3 position, normal;
};

struct Traced {
    std::vector<Location> locations;  ///< of particles, in random order
    std::vector<bool> is_object_hit;
};

/// All surfaces count as diffuse reflectors here, even black ones: only the geometry matters.
Traced trace_particles(const Scene& scene, const rays::RayCaster& caster) {
    const transport::LightSampler lights(scene, caster);
    Traced traced{{}, std::vector<bool>(scene.objects.size())};
    for (std::uint64_t i = 0; i < kParticles; ++i) {
        math::SampleStream stream(math::RandomKey{}.derived(kTracing), i);
        const transport::EmittedParticle particle = lights.sample_emission(stream);
        Location from{particle.origin, particle.direction};
        Vec3 direction = particle.direction;
        for (int reflection = 0; reflection <= kReflections; ++reflection) {
            traced.locations.push_back(from);
            const auto hit = caster.closest(from.position, direction);
            if (!hit) break;
            traced.is_object_hit[index_of(hit->object)] = true;
            from = {hit->lifted, hit->normal};
            const auto [u1, u2] = stream.next_two();
            direction = Frame::around(hit->normal).to_world(math::sample_cosine_hemisphere(u1, u2).direction);
        }
    }
    return traced;
}

Location location_on(const Mesh& mesh, math::SampleStream& stream) {
    const auto count = static_cast<double>(mesh.triangles.size());
    const auto [i, j, k] = mesh.triangles[static_cast<std::size_t>(stream.next() * count)];
    const auto [u1, u2] = stream.next_two();
    const math::Barycentric w = math::sample_triangle(u1, u2);
    const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    return {w.b0 * a + w.b1 * b + w.b2 * c, normalized(cross(b - a, c - a))};
}
Location location_on(const Rectangle& rectangle, math::SampleStream& stream) {
    return location_on(triangulated(rectangle), stream);
}
Location location_on(const Box& box, math::SampleStream& stream) {
    return location_on(triangulated(box), stream);
}
Location location_on(const Sphere& sphere, math::SampleStream& stream) {
    const auto [u1, u2] = stream.next_two();
    const Vec3 normal = math::sample_sphere(u1, u2).direction;
    return {sphere.center + sphere.radius * normal, normal};
}
Location location_on(const Harmonics& harmonics, math::SampleStream& stream) {
    const auto [u1, u2] = stream.next_two();
    const Vec3 direction = math::sample_sphere(u1, u2).direction;
    return {harmonics.point_towards(direction), harmonics.normal_towards(direction)};
}
Location location_on(const Disk& disk, math::SampleStream& stream) {
    const auto [u1, u2] = stream.next_two();
    const math::DiskPoint p = math::sample_unit_disk(u1, u2);
    const Frame frame = Frame::around(disk.normal);
    return {disk.center + disk.radius * (p.x * frame.u + p.y * frame.v), disk.normal};
}

bool sees(const Location& from, const Location& to, const rays::RayCaster& caster) {
    const Vec3 offset = to.position - from.position;
    return dot(offset, from.normal) > 0 && dot(offset, to.normal) < 0 &&
           !caster.occluded(from.position, to.position);
}

bool is_seen(const Object& object, const std::vector<Location>& lit, const rays::RayCaster& caster) {
    const std::size_t stride = std::max<std::size_t>(1, lit.size() / kLocationsTried);
    for (std::uint64_t i = 0; i < kPointsOnObject; ++i) {
        math::SampleStream stream(math::RandomKey{}.derived(kConnecting), i);
        const Location location =
            std::visit([&](const auto& s) { return location_on(s, stream); }, object.shape);
        const double offset = caster.offset_m(location.position, caster.half_extent_m());
        for (const Vec3& normal : {location.normal, -location.normal}) {
            const Location lifted{location.position + offset * normal, normal};
            for (std::size_t j = i % stride; j < lit.size(); j += stride) {
                if (sees(lifted, lit[j], caster)) return true;
            }
        }
    }
    return false;
}

}  // namespace

std::vector<ObjectId> unlit_objects(const Scene& scene, const rays::RayCaster& caster) {
    if (scene.lights.empty()) return {};  // all objects are dark; the scene reader warns of it
    Traced traced = trace_particles(scene, caster);
    for (const Light& light : scene.lights) {
        if (const auto surface = lights::surface_emission(light))
            traced.is_object_hit[index_of(surface->object)] = true;
    }
    std::vector<ObjectId> unlit;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        if (traced.is_object_hit[i] || is_seen(scene.objects[i], traced.locations, caster)) continue;
        unlit.push_back(ObjectId{i});
    }
    return unlit;
}

}  // namespace stilb::checks
