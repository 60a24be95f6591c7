#include "rays/ray_caster.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <optional>
#include <thread>
#include <tuple>
#include <vector>

#include "base/parallel.h"
#include "geometry/harmonics/surface.h"
#include "geometry/transform.h"
#include "materials/black.h"
#include "materials/diffuse.h"
#include "math/sampling.h"
#include "stilb/error.h"
#include "support/closed_meshes.h"
#include "support/harmonic_shapes.h"
#include "support/random_pairs.h"

namespace stilb::rays {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The first surface that a ray meets, in double precision.
struct ExactHit {
    double distance = kInfinity;
    std::size_t object = 0, triangle = 0;
    Vec3 front;
};

void meet(const Mesh& mesh, const Vec3& origin, const Vec3& direction, std::size_t object, ExactHit& hit) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        const Vec3 e1 = mesh.vertices[b] - mesh.vertices[a], e2 = mesh.vertices[c] - mesh.vertices[a];
        const Vec3 p = cross(direction, e2), s = origin - mesh.vertices[a], q = cross(s, e1);
        const double determinant = dot(e1, p);
        const double u = dot(s, p) / determinant, v = dot(direction, q) / determinant;
        const double t = dot(e2, q) / determinant;
        if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < hit.distance) {
            hit = {t, object, i, normalized(cross(e1, e2))};
        }
    }
}
void meet(const Instance& instance, const Vec3& origin, const Vec3& direction, std::size_t object,
          ExactHit& hit) {
    meet(triangulated(instance), origin, direction, object, hit);
}
void meet(const Box& box, const Vec3& origin, const Vec3& direction, std::size_t object, ExactHit& hit) {
    meet(triangulated(box), origin, direction, object, hit);
}
void meet(const Rectangle& r, const Vec3& origin, const Vec3& direction, std::size_t object, ExactHit& hit) {
    meet(triangulated(r), origin, direction, object, hit);
}
void meet(const Sphere& s, const Vec3& origin, const Vec3& direction, std::size_t object, ExactHit& hit) {
    const Vec3 from_center = origin - s.center;
    const double b = dot(from_center, direction);
    const double root = b * b - squared_length(from_center) + s.radius * s.radius;
    if (root < 0) return;
    for (const double t : {-b - std::sqrt(root), -b + std::sqrt(root)}) {
        if (t <= 0 || t >= hit.distance) continue;
        hit = {t, object, 0, normalized(from_center + t * direction)};
        return;
    }
}
void meet(const Disk& d, const Vec3& origin, const Vec3& direction, std::size_t object, ExactHit& hit) {
    const double t = dot(d.center - origin, d.normal) / dot(direction, d.normal);
    if (t <= 0 || t >= hit.distance || length(origin + t * direction - d.center) > d.radius) return;
    hit = {t, object, 0, d.normal};
}
/// By the other method than the caster's own.
void meet(const Harmonics& h, const Vec3& origin, const Vec3& direction, std::size_t object, ExactHit& hit) {
    const auto found =
        h.surface->first_crossing(h.to_own(origin), h.axes.to_local(direction), 0, hit.distance / h.scale);
    if (!found) return;
    hit = {found->distance * h.scale, object, 0, h.axes.to_world(h.surface->normal_at(found->direction))};
}

ExactHit exact_closest(const Scene& scene, const Vec3& origin, const Vec3& direction) {
    ExactHit hit;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        std::visit([&](const auto& shape) { meet(shape, origin, direction, i, hit); },
                   scene.objects[i].shape);
    }
    return hit;
}

Vec3 random_point(RandomPairs& random) {
    const auto [x, y] = random.next_pair();
    return Vec3{x, y, random.next()} * 4;
}

/// Some of every shape in a cube of 4 m, far from the origin; a mesh with a material for each triangle.
class Clutter : public testing::Test {
  protected:
    Clutter() {
        RandomPairs random(11);
        Mesh mesh;
        std::vector<MaterialId> materials;
        for (std::uint32_t i = 0; i < 60; ++i) {
            const Vec3 at = place(random_point(random));
            for (int k = 0; k < 3; ++k) mesh.vertices.push_back(at + 0.25 * random_point(random));
            mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
            materials.push_back(add_material(scene_, diffuse(0.01 * i)));
        }
        scene_.objects.push_back({"mesh", mesh, materials});
        for (int i = 0; i < 5; ++i) {
            const Vec3 at = place(random_point(random));
            add_object(scene_, Box{at, at + Vec3{0.3, 0.4, 0.1}}, Black{});
            add_object(scene_, Sphere{place(random_point(random)), 0.2 + 0.05 * i}, Black{});
            add_object(
                scene_,
                Disk{place(random_point(random)), normalized(random_point(random) - Vec3{2, 2, 2}), 0.3},
                Black{});
            add_object(scene_, Rectangle{place(random_point(random)), {0.5, 0.1, 0}, {0.1, 0.2, 0.4}},
                       Black{});
        }
        // Turned, mirrored and small.
        const geometry::Transform turned = geometry::Transform::rotation(normalized(Vec3{1, 2, 3}), 130);
        const geometry::Transform mirrored{{0, 0.4, 0}, {0.4, 0, 0}, {0, 0, 0.4}, place({1.2, 2.7, 3.1})};
        add_object(scene_, transformed(Harmonics(rough_surface(9, 3)), compose(mirrored, turned)), Black{});
        const auto shared = std::make_shared<const Mesh>(triangulated(Box{{-1, -1, -1}, {1, 0.5, 0.2}}));
        add_object(scene_, Instance{shared, mirrored}, Black{});
        geometry::Transform placed = turned;
        placed.translation = place({3.1, 1.1, 2.2});
        add_object(scene_, Instance{shared, placed}, Black{});
    }
    static Vec3 place(const Vec3& p) { return p + Vec3{100, -200, 50}; }

    Scene scene_;
};

/// Edges blur by the rounding of single precision, some 1e-6 of an object: of so many rays a few at most.
constexpr int kRays = 50'000;
constexpr int kMostAtEdges = 5;

TEST_F(Clutter, ClosestHitsAreThoseOfDoublePrecision) {
    const RayCaster caster(scene_);
    RandomPairs random(12);
    int hits = 0, at_edges = 0;
    for (int i = 0; i < kRays; ++i) {
        const Vec3 origin = place(random_point(random));
        const auto [u1, u2] = random.next_pair();
        const Vec3 direction = math::sample_sphere(u1, u2).direction;
        const ExactHit exact = exact_closest(scene_, origin, direction);
        const auto hit = caster.closest(origin, direction);
        const bool is_hit = exact.distance < kInfinity;
        const double cosine = std::abs(dot(exact.front, direction));
        if (hit.has_value() != is_hit ||
            (is_hit && std::abs(hit->distance_m - exact.distance) * cosine > 1e-5)) {
            ++at_edges;
            continue;
        }
        if (!is_hit) continue;
        ++hits;
        const Object& object = scene_.objects[exact.object];
        ASSERT_EQ(index_of(hit->object), exact.object);
        EXPECT_EQ(hit->material, object.materials[object.materials.size() > 1 ? exact.triangle : 0]);
        EXPECT_EQ(hit->on_front, dot(exact.front, direction) < 0);
        EXPECT_LT(dot(hit->normal, direction), 0);
        EXPECT_GT(std::abs(dot(hit->normal, exact.front)), 1 - 1e-6);
        EXPECT_LT(std::abs(dot(hit->position - origin - exact.distance * direction, exact.front)), 1e-5);
        const double lift = dot(hit->lifted - hit->position, hit->normal);
        EXPECT_GT(lift, 0);
        EXPECT_LT(lift, 1.01 * caster.offset_m(hit->position, 4));
    }
    EXPECT_GT(hits, kRays / 10);
    EXPECT_LE(at_edges, kMostAtEdges);
}

TEST_F(Clutter, OcclusionIsThatOfDoublePrecision) {
    const RayCaster caster(scene_);
    RandomPairs random(13);
    int occluded = 0, at_edges = 0;
    for (int i = 0; i < kRays; ++i) {
        const Vec3 from = place(random_point(random)), to = place(random_point(random));
        const bool exact = exact_closest(scene_, from, normalized(to - from)).distance < length(to - from);
        at_edges += caster.occluded(from, to) != exact;
        occluded += exact;
    }
    EXPECT_GT(occluded, kRays / 10);
    EXPECT_LE(at_edges, kMostAtEdges);
}

TEST_F(Clutter, PacketsAgreeWithSingleRays) {
    const RayCaster caster(scene_);
    RandomPairs random(14);
    int occluded = 0, different = 0;
    for (int i = 0; i < kRays / kPacketWidth; ++i) {
        const Vec3 from = place(random_point(random));
        const Vec3 o = from - caster.center();
        RayPacket packet;
        LaneMask lanes{};
        std::array<Vec3, kPacketWidth> to;
        for (std::size_t k = 0; k < kPacketWidth; ++k) {
            to[k] = place(random_point(random));
            const Vec3 d = to[k] - from;
            packet.origin_x[k] = static_cast<float>(o.x), packet.origin_y[k] = static_cast<float>(o.y);
            packet.origin_z[k] = static_cast<float>(o.z), packet.end[k] = 1;
            packet.direction_x[k] = static_cast<float>(d.x);
            packet.direction_y[k] = static_cast<float>(d.y);
            packet.direction_z[k] = static_cast<float>(d.z);
            lanes[k] = random.next() < 0.8 ? -1 : 0;
        }
        caster.occlude(packet, lanes);
        for (std::size_t k = 0; k < kPacketWidth; ++k) {
            const bool expected = lanes[k] != 0 && caster.occluded(from, to[k]);
            different += (packet.end[k] < 0) != expected;
            occluded += expected;
        }
    }
    EXPECT_GT(occluded, kRays / 20);
    EXPECT_LE(different, kMostAtEdges);
}

/// A hit has the material of the side that was met: of flat surfaces, of a mesh with a material for each
/// triangle, of curved ones.
TEST(RayCaster, HitsHaveTheMaterialOfTheirSide) {
    Scene scene;
    constexpr std::uint32_t kOthers = 4;  // from there on, materials of backs
    for (std::uint32_t i = 0; i < 2 * kOthers; ++i) {
        scene.materials.push_back({fmt::format("m{}", i), materials::Black{}});
        if (i < kOthers && i != 1) scene.materials.back().back = MaterialId{i + kOthers};
    }
    const Mesh two{{{0, 0, 2}, {4, 0, 2}, {4, 4, 2}, {0, 4, 2}}, {{{0, 1, 2}}, {{0, 2, 3}}}};
    scene.objects = {{"flat", Rectangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {MaterialId{0}}},
                     {"mesh", two, {MaterialId{1}, MaterialId{2}}},
                     {"ball", Sphere{{2, 2, 1}, 0.5}, {MaterialId{3}}}};
    const RayCaster caster(scene);
    RandomPairs random(3);
    std::array<int, 2 * kOthers> met{};
    for (int round = 0; round < 100; ++round) {
        RayHitPacket packet;
        LaneMask lanes;
        lanes.fill(-1);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            const auto [u1, u2] = random.next_pair();
            const Vec3 origin{4 * random.next(), 4 * random.next(), 4 * random.next() - 1};
            packet.ray.set(i, origin - caster.center(), math::sample_sphere(u1, u2).direction,
                           std::numeric_limits<float>::infinity());
        }
        caster.closest(packet, lanes, Coherence::scattered);
        SurfacePacket surfaces;
        caster.surfaces(packet, surfaces);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            if (surfaces.object[i] == kNothing) continue;
            const Hit hit = caster.hit(packet, i);
            const std::uint32_t front = index_of(hit.object) == 1   ? 1 + hit.triangle
                                        : index_of(hit.object) == 2 ? 3
                                                                    : 0;
            const std::uint32_t expected = hit.on_front || front == 1 ? front : front + kOthers;
            EXPECT_EQ(index_of(hit.material), expected);
            EXPECT_EQ(surfaces.material[i], expected);
            ++met[expected];
        }
    }
    for (std::uint32_t i = 0; i < met.size(); ++i)
        EXPECT_EQ(met[i] > 10, i != 1 + kOthers) << i << ": " << met[i];
}

class ClosedMeshes : public testing::TestWithParam<std::tuple<std::size_t, double>> {};

TEST_P(ClosedMeshes, LoseNoRay) {
    const auto [place, size_m] = GetParam();
    for (const Queries queries : {Queries::single, Queries::packets})
        EXPECT_EQ(lost_rays(kClosedMeshes[place].make(size_m), queries, 500'000, 5), 0u);
}

std::string name_of(const testing::TestParamInfo<std::tuple<std::size_t, double>>& parameter) {
    const auto [place, size_m] = parameter.param;
    return std::string(kClosedMeshes[place].name) + (size_m < 0.1 ? "1mm" : size_m < 10 ? "1m" : "10km");
}

INSTANTIATE_TEST_SUITE_P(Sizes, ClosedMeshes,
                         testing::Combine(testing::Range<std::size_t>(0, kClosedMeshes.size()),
                                          testing::Values(1e-3, 1.0, 1e4)),
                         name_of);

TEST(RayCaster, FlatSurfacesDoNotShadowThemselves) {
    // Many triangles in one tilted plane, which rounding makes uneven.
    constexpr std::uint32_t kCells = 60;
    const geometry::Transform tilt = geometry::Transform::rotation(normalized(Vec3{1, 2, 3}), 23.4);
    for (const double size_m : {1e-3, 8.0, 1e4}) {
        RandomPairs random(15);
        Mesh mesh;
        for (std::uint32_t i = 0; i <= kCells; ++i) {
            for (std::uint32_t j = 0; j <= kCells; ++j) {
                const auto [x, y] = random.next_pair();
                mesh.vertices.push_back(tilt.point(size_m / kCells * Vec3{i + 0.8 * x, j + 0.8 * y, 0}));
                if (i == 0 || j == 0) continue;
                const std::uint32_t d = i * (kCells + 1) + j, b = d - kCells - 1, c = d - 1, a = b - 1;
                mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
            }
        }
        Scene scene;
        add_object(scene, mesh, diffuse(0.5));
        const RayCaster caster(scene);
        int tested = 0, occluded = 0;
        for (int i = 0; i < 100'000; ++i) {
            const auto [x, y] = random.next_pair();
            const Vec3 eye = tilt.point(size_m * Vec3{0.1 + 0.8 * x, 0.1 + 0.8 * y, 0.5});
            const auto [u1, u2] = random.next_pair();
            const auto hit =
                caster.closest(eye, tilt.point(-math::sample_cosine_hemisphere(u1, u2).direction));
            if (!hit) continue;
            // Lights from far above to one thousandth of the size above the plane.
            const double height = std::pow(10, -3 * random.next());
            ++tested;
            occluded += caster.occluded(hit->lifted, tilt.point(size_m * Vec3{y, x, height}));
        }
        EXPECT_GT(tested, 40'000);
        EXPECT_EQ(occluded, 0) << size_m << " m";
    }
}

TEST(RayCaster, LiftsPointsOfAHouseAsFarFromTheMiddleOfItsGround) {
    // In a room of 8 m, points are lifted by 8 micrometres; here by no more than the ground's parts of 8 m.
    constexpr double kMost_m = 16e-6;
    Scene scene;
    scene.materials.push_back({"white", Material{Diffuse{Rgb::grey(0.5)}}});
    const Vec3 house{2900, -3300, 0};
    const auto add = [&](Shape shape) { scene.objects.push_back({"", std::move(shape), {MaterialId{0}}}); };
    add(Rectangle{{-4000, -4000, 0}, {8000, 0, 0}, {0, 8000, 0}});
    add(Box{house - Vec3{4, 4, 0}, house + Vec3{4, 4, 3}});
    add(Box{house + Vec3{1, 1, 0}, house + Vec3{2, 2, 1}});
    const RayCaster caster(scene);
    for (const Vec3& start : {Vec3{-2.2, 0.3, 1}, Vec3{1.4, 1.3, 1.5}, Vec3{6.1, 1.2, 1}}) {
        const auto hit = caster.closest(house + start, {0, 0, -1});
        ASSERT_TRUE(hit);
        EXPECT_GT(hit->lift_m, 0);
        EXPECT_LE(hit->lift_m, kMost_m);
    }
}

TEST(RayCaster, SpheresDoNotShadowThemselves) {
    for (const double radius : {1e-3, 5.0, 1e4}) {
        Scene scene;
        add_object(scene, Sphere{{}, radius}, diffuse(0.5));
        const RayCaster caster(scene);
        RandomPairs random(16);
        for (int i = 0; i < 100'000; ++i) {
            const auto [u1, u2] = random.next_pair();
            const Vec3 up = math::sample_sphere(u1, u2).direction;
            const auto hit = caster.closest(2 * radius * up, -up);
            ASSERT_TRUE(hit);
            const auto [v1, v2] = random.next_pair();
            const Vec3 towards = Frame::around(up).to_world(math::sample_cosine_hemisphere(v1, v2).direction);
            if (dot(towards, up) < 0.01) continue;
            ASSERT_FALSE(caster.occluded(hit->lifted, hit->lifted + radius * towards));
        }
    }
}

/// Directions about right angles, as rotations make them: components of either sign, next to nothing.
TEST(RayCaster, LosesNoPacketsAlongAxes) {
    Scene scene;
    add_object(scene, icosphere({{0.01, 0.02, 0.03}, 1}, 5), Black{});
    const RayCaster caster(scene);
    RandomPairs random(5);
    for (int i = 0; i < 6000; ++i) {
        const double small = std::pow(10, -20 * random.next());
        const Vec3 origin = 0.02 * random_point(random);
        std::vector<Ray> rays;
        for (int k = 0; k < kPacketWidth; ++k) {
            const auto [u1, u2] = random.next_pair();
            const Vec3 direction = normalized(Vec3{small * (2 * u1 - 1), 1, 1e-2 * u2});
            rays.push_back({origin, i % 2 == 0 ? direction : Vec3{direction.y, direction.z, direction.x}});
        }
        std::vector<std::optional<Hit>> hits(rays.size());
        caster.closest(rays, Coherence::coherent, hits);
        for (const auto& hit : hits) ASSERT_TRUE(hit.has_value()) << small;
    }
}

TEST(RayCaster, InterpolatesVertexNormals) {
    const Sphere sphere{{1, 2, 3}, 0.7};
    Scene scene;
    add_object(scene, smooth_icosphere(sphere, 2), diffuse(0.5));
    const RayCaster caster(scene);
    RandomPairs random(12);
    for (int i = 0; i < 2000; ++i) {
        const auto [u1, u2] = random.next_pair();
        const Vec3 direction = math::sample_sphere(u1, u2).direction;
        // From outside, and from within.
        for (const double distance_m : {2.0, 0.0}) {
            const auto hit = caster.closest(sphere.center + distance_m * direction,
                                            distance_m > 0 ? -direction : direction);
            ASSERT_TRUE(hit);
            const Vec3 outside = distance_m > 0 ? direction : -direction;
            EXPECT_GT(dot(hit->normal, outside), 0.97);
            EXPECT_GT(dot(hit->shading_normal, outside), 0.9997);
            EXPECT_NEAR(length(hit->shading_normal), 1, 1e-14);
        }
    }
}

TEST(RayCaster, HasNoShadingNormalWhereNormalsAreOfNoUse) {
    const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const auto hit_of = [](const Mesh& mesh) {
        Scene scene;
        add_object(scene, mesh, diffuse(0.5));
        return *RayCaster(scene).closest({0.25, 0.25, 1}, {0, 0, -1});
    };
    const std::vector<Mesh> meshes{{vertices, {{0, 1, 2}}},
                                   {vertices, {{0, 1, 2}}, {{0, 0.6, 0.8}}, {{0, 0, kNoNormal}}},
                                   {vertices, {{0, 1, 2}}, {{}, {}, {}}},
                                   {vertices, {{0, 1, 2}}, {{1, 0, 0}}, {{0, 0, 0}}}};
    for (const Mesh& mesh : meshes) EXPECT_EQ(hit_of(mesh).shading_normal, (Vec3{0, 0, 1}));
    // A file whose normals point behind the front: the surface that they mean is the same.
    const Hit hit = hit_of({vertices, {{0, 1, 2}}, {{0, 0.6, -0.8}}, {{0, 0, 0}}});
    EXPECT_LT(length(hit.shading_normal - Vec3{0, -0.6, 0.8}), 1e-15);
}

TEST(RayCaster, RefusesWhatIsTooFarForSinglePrecision) {
    const auto message_of = [](const Scene& scene) -> std::string {
        try {
            const RayCaster caster(scene);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {1, 1, 1e9}}, diffuse(0.5));
    EXPECT_EQ(message_of(scene), "");
    add_object(scene, Box{{0, 0, 0}, {1, 1, 1.0001e9}}, diffuse(0.5));
    EXPECT_NE(message_of(scene).find("object \"1\" reaches a coordinate of 1e+09 m"), std::string::npos);
    scene.objects.pop_back();
    add_object(scene, Sphere{{0, 0, 0}, 2e9}, diffuse(0.5));
    EXPECT_NE(message_of(scene).find("object \"1\" reaches a coordinate of 2e+09 m"), std::string::npos);
    scene.objects.pop_back();
    add_point_light(scene, {0, -1e18, 0}, Rgb::grey(1));
    EXPECT_NE(message_of(scene).find("light \"0\" reaches"), std::string::npos);
}

/// Boxes of 1 m in a row: packets meet few of them without Embree, and many by it.
Scene boxes(int count) {
    Scene scene;
    scene.materials.push_back({"wall", Diffuse{Rgb::grey(0.5)}});
    for (int i = 0; i < count; ++i) {
        const Vec3 corner{2.0 * i, 0, 0};
        scene.objects.push_back(
            {fmt::format("box {}", i), Box{corner, corner + Vec3{1, 1, 1}}, {MaterialId{0}}});
    }
    return scene;
}

TEST(TracedRays, AreCountedOneByOneAndByLanes) {
    for (const int count : {1, 20}) {
        const Scene scene = boxes(count);
        const RayCaster caster(scene);
        const auto traced_by = [](const auto& action) {
            const std::uint64_t before = traced_rays();
            action();
            return traced_rays() - before;
        };
        const Vec3 above{0.5, 0.5, 3}, below{0.5, 0.5, -1}, down{0, 0, -1};
        EXPECT_EQ(traced_by([&] { EXPECT_TRUE(caster.closest(above, down)); }), 1u);
        EXPECT_EQ(traced_by([&] { EXPECT_TRUE(caster.occluded(above, below)); }), 1u);
        const std::vector<Ray> rays(kPacketWidth + 3, Ray{above, down});
        std::vector<std::optional<Hit>> hits(rays.size());
        const std::vector<Segment> segments(3, Segment{above, below});
        std::vector<Rgb> transmittances(segments.size());
        for (const Coherence coherence : {Coherence::coherent, Coherence::scattered}) {
            EXPECT_EQ(traced_by([&] { caster.closest(rays, coherence, hits); }), rays.size());
            EXPECT_EQ(traced_by([&] { caster.transmittances(segments, coherence, transmittances); }), 3u);
        }
        std::thread([] { EXPECT_EQ(traced_rays(), 0u) << "of another thread"; }).join();
    }
}

/// A thread of its own: what TBB keeps for it is not there before.
TEST(RayCaster, LetsLaterLoopsOfItsThreadKeepDenormalNumbers) {
    std::thread([] {
        const Scene scene = boxes(1);
        const RayCaster caster(scene);
        const volatile double least_normal = std::numeric_limits<double>::min();
        double half = 0;
        parallel_for(1, [&](std::size_t) { half = least_normal / 2; });
        EXPECT_GT(half, 0);
    }).join();
}

}  // namespace
}  // namespace stilb::rays
