#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "checks/checks.h"
#include "checks/streams.h"
#include "checks/walks.h"
#include "math/sampling.h"
#include "transport/light_sampler.h"

namespace stilb::checks {
namespace {

constexpr std::uint64_t kParticles = 4096, kParticlesAtOnce = 64;
constexpr int kReflections = 3;
constexpr std::uint64_t kPointsOnObject = 64;
/// Lit points that are tested for each point on an object.
constexpr std::size_t kPointsTried = 64;

/// Tests of pairs of points for all objects: a few tenths of a second at most. Objects that are left then are
/// not named.
constexpr std::size_t kMostTests = 200'000;

/// Particles from all lights, until every object is met. Emitters count as met.
Trail trace_particles(const Scene& scene, const rays::RayCaster& caster) {
    const transport::LightSampler lights(scene, caster);
    Trail trail(scene);
    for (const Light& light : scene.lights) {
        if (const auto surface = lights::emitting_object(light))
            trail.is_object_met[index_of(*surface)] = true;
    }
    for (std::uint64_t i = 0; i < kParticles; ++i) {
        if (i % kParticlesAtOnce == 0 && std::ranges::all_of(trail.is_object_met, std::identity{})) break;
        math::SampleStream stream(kCheckKey.derived(CheckStream::unlit_particles), i);
        const transport::EmittedParticle particle = lights.sample_emission(stream);
        trail.points.push_back({particle.origin, particle.direction});
        follow_walk(scene, caster, {particle.origin, particle.direction}, kReflections, stream, trail);
    }
    return trail;
}

/// On a mesh or an instance.
template <typename Triangles>
SurfacePoint point_on(const Triangles& shape, std::size_t count, math::SampleStream& stream) {
    const auto [a, b, c] =
        shape.corners_of(static_cast<std::size_t>(stream.next() * static_cast<double>(count)));
    const auto [u1, u2] = stream.next_two();
    const math::Barycentric w = math::sample_triangle(u1, u2);
    return {w.b0 * a + w.b1 * b + w.b2 * c, normalized(cross(b - a, c - a))};
}
SurfacePoint point_on(const Mesh& mesh, math::SampleStream& stream) {
    return point_on(mesh, mesh.triangles.size(), stream);
}
SurfacePoint point_on(const Instance& instance, math::SampleStream& stream) {
    return point_on(instance, instance.mesh->triangles.size(), stream);
}
SurfacePoint point_on(const Rectangle& rectangle, math::SampleStream& stream) {
    return point_on(triangulated(rectangle), stream);
}
SurfacePoint point_on(const Box& box, math::SampleStream& stream) {
    return point_on(triangulated(box), stream);
}
SurfacePoint point_on(const Sphere& sphere, math::SampleStream& stream) {
    const auto [u1, u2] = stream.next_two();
    const Vec3 normal = math::sample_sphere(u1, u2).direction;
    return {sphere.center + sphere.radius * normal, normal};
}
SurfacePoint point_on(const Harmonics& harmonics, math::SampleStream& stream) {
    const auto [u1, u2] = stream.next_two();
    const Vec3 direction = math::sample_sphere(u1, u2).direction;
    return {harmonics.point_towards(direction), harmonics.normal_towards(direction)};
}
SurfacePoint point_on(const Disk& disk, math::SampleStream& stream) {
    const auto [u1, u2] = stream.next_two();
    const math::DiskPoint p = math::sample_unit_disk(u1, u2);
    const Frame frame = Frame::around(disk.normal);
    return {disk.center + disk.radius * (p.x * frame.u + p.y * frame.v), disk.normal};
}

/// `tests` counts the pairs of points that were tested.
bool is_seen(const Object& object, const std::vector<SurfacePoint>& lit, const rays::RayCaster& caster,
             std::size_t& tests) {
    const std::size_t stride = std::max<std::size_t>(1, lit.size() / kPointsTried);
    for (std::uint64_t i = 0; i < kPointsOnObject; ++i) {
        math::SampleStream stream(kCheckKey.derived(CheckStream::unlit_connections), i);
        const SurfacePoint point =
            std::visit([&](const auto& s) { return point_on(s, stream); }, object.shape);
        const double offset = caster.offset_m(point.position, caster.lift().largest_size_m());
        for (const Vec3& normal : {point.normal, -point.normal}) {
            const SurfacePoint side{point.position, normal, point.position + offset * normal};
            for (std::size_t j = i % stride; j < lit.size(); j += stride) {
                ++tests;
                if (sees(side, lit[j], caster)) return true;
            }
        }
    }
    return false;
}

}  // namespace

std::vector<ObjectId> unlit_objects(const Scene& scene, const rays::RayCaster& caster) {
    if (scene.lights.empty()) return {};  // all objects are dark; the scene reader warns of it
    const Trail trail = trace_particles(scene, caster);
    std::vector<ObjectId> unlit;
    std::size_t tests = 0;
    for (std::uint32_t i = 0; i < scene.objects.size() && tests < kMostTests; ++i) {
        if (trail.is_object_met[i] || is_seen(scene.objects[i], trail.points, caster, tests)) continue;
        unlit.push_back(ObjectId{i});
    }
    return unlit;
}

std::vector<std::string> unlit_warnings(const Scene& scene, const rays::RayCaster& caster) {
    std::vector<std::string> names;
    for (const ObjectId object : unlit_objects(scene, caster)) names.push_back(scene.object(object).name);
    if (names.empty()) return {};
    return {names.size() == 1 ? fmt::format("object \"{}\": no light reaches it.", names[0])
                              : fmt::format("objects {}: no light reaches them.", list_of(names))};
}

}  // namespace stilb::checks
