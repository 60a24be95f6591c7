#include "estimators/patch_light/first_shot/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "math/random.h"
#include "patches/patches.h"
#include "transport/light_sampler.h"

namespace stilb::estimators {
namespace {

Mesh fan(const Vec3& middle, const std::vector<Vec3>& rim) {
    Mesh mesh{{middle}, {}};
    const auto count = static_cast<std::uint32_t>(rim.size());
    mesh.vertices.insert(mesh.vertices.end(), rim.begin(), rim.end());
    for (std::uint32_t i = 0; i < count; ++i) mesh.triangles.push_back({0, i + 1, (i + 1) % count + 1});
    return mesh;
}

/// The shape as the starting mesh of the light's own patches.
Shape coarse(const Shape& shape) {
    if (const auto* rectangle = std::get_if<Rectangle>(&shape)) {
        return fan(rectangle->corner + 0.5 * (rectangle->edge_u + rectangle->edge_v),
                   triangulated(*rectangle).vertices);
    }
    if (const auto* disk = std::get_if<Disk>(&shape)) {
        const Frame frame = Frame::around(disk->normal);
        std::vector<Vec3> rim;
        for (int i = 0; i < 6; ++i) {
            const double angle = i * kPi / 3;
            rim.push_back(disk->center +
                          disk->radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v));
        }
        return fan(disk->center, rim);
    }
    return shape;
}

/// The light alone. Positions are relative to the centre of all patches, because viewpoints are lifted the
/// more the farther they are from it.
patches::Patches light_patches(const Shape& shape, double longest_edge_m, const Vec3& center) {
    Scene alone;
    alone.objects.push_back({"", shape, {MaterialId{}}});
    patches::Patches patches = patches::make_patches(alone, longest_edge_m);
    for (patches::Float3& vertex : patches.vertices) {
        const Vec3 moved = Vec3(vertex) + (patches.center - center);
        vertex = {static_cast<float>(moved.x), static_cast<float>(moved.y), static_cast<float>(moved.z)};
    }
    patches.center = center;
    return patches;
}

/// The least distance that half of the flux of an area light travels; flux that leaves the scene counts as
/// travelling through all of it.
double median_flight_m(const Object& light, const rays::RayCaster& caster) {
    constexpr std::uint64_t kRays = 256;
    Scene alone;
    alone.objects.push_back(light);
    alone.lights.push_back({"", AreaLight{ObjectId{0}, Rgb::grey(1)}});
    const transport::LightSampler sampler(alone, caster);
    std::vector<double> flights_m;
    for (std::uint64_t i = 0; i < kRays; ++i) {
        math::SampleStream stream(math::RandomKey{}, i);
        const transport::EmittedParticle particle = sampler.sample_emission(stream);
        const auto hit = caster.closest(particle.origin, particle.direction);
        flights_m.push_back(hit ? hit->distance_m : 2 * caster.half_extent_m());
    }
    std::ranges::nth_element(flights_m, flights_m.begin() + kRays / 2);
    return flights_m[kRays / 2];
}

/// Turned by an arbitrary angle about w: otherwise rows of pixels would run along the edges of patches in
/// rooms, and from positions in the middle would all be counted to the same side.
Frame turned_about(const Vec3& w) {
    const Frame frame = Frame::around(w);
    const Vec3 u = std::cos(0.7) * frame.u + std::sin(0.7) * frame.v;
    return {u, cross(w, u), w};
}

/// For points, which have no preferred direction.
Frame turned() { return turned_about(normalized(Vec3{0.3, -0.5, 0.8})); }

/// Makes the samples of one light after the other.
class Chooser {
  public:
    Chooser(const Scene& scene, const rays::RayCaster& caster, const Vec3& center)
        : scene_(scene), caster_(caster), center_(center) {}

    FirstShotLights run() {
        for (const Light& light : scene_.lights) add(light);
        return std::move(chosen_);
    }

  private:
    void add(const Light& light) {
        FirstShotLight& decision = chosen_.lights.emplace_back();
        decision.name = light.name;
        const Rgb flux = flux_lm(scene_, light);
        if (!(flux.luminance() > 0)) {
            decision.why = "it is dark";
            return;
        }
        decision.colour = flux * (1 / flux.luminance());
        const std::size_t before = chosen_.samples.size();
        decision.why =
            std::visit([&](const auto& source) { return shoot_from(light, source); }, light.source);
        decision.samples = chosen_.samples.size() - before;
        decision.is_replaced = decision.samples > 0;
    }

    void add_sample(bool is_point, const patches::Viewpoint& viewpoint, SampleIntensity intensity) {
        const auto light = static_cast<std::uint32_t>(chosen_.lights.size() - 1);
        chosen_.samples.push_back({light, is_point, viewpoint, std::move(intensity)});
    }

    /// Adds the samples of a light, or none where it is not small, with the reason.
    template <lights::LightKind Source>
    std::string shoot_from(const Light& light, const Source& source) {
        if constexpr (Source::kLocation == LightLocation::point) {
            return shoot_from_point(
                typename Source::Emitter(source, scene::LightSurroundings(scene_), caster_.lift()));
        } else if constexpr (requires { source.luminaire; }) {
            return shoot_from_opening(source);
        } else if constexpr (Source::kLocation == LightLocation::surface) {
            static_assert(
                requires { source.luminance_cd_m2; }, "patches emit evenly: add samples of the kind");
            return shoot_from_surface(*uniform_emission(light));
        } else {
            static_assert(Source::kLocation == LightLocation::infinity);
            return "it surrounds the scene";
        }
    }

    template <lights::PointEmitterKind Emitter>
    std::string shoot_from_point(const Emitter& emitter) {
        const Frame frame = turned();
        add_sample(true, {emitter.lifted(), frame}, PointIntensity{emitter.turned_into(frame)});
        return std::string(Emitter::kNoun);
    }

    std::string shoot_from_surface(const lights::UniformEmission& light) {
        const Object& object = scene_.object(light.object);
        const Shape& shape = object.shape;
        const double luminance_cd_m2 = light.luminance_cd_m2.luminance();
        const double spacing_m = kVertexSpacing * median_flight_m(object, caster_);
        const auto* sphere = std::get_if<Sphere>(&shape);
        const bool is_small = sphere != nullptr ? shoot_from_sphere(*sphere, luminance_cd_m2, spacing_m)
                                                : shoot_from_vertices(shape, luminance_cd_m2, spacing_m);
        return is_small ? fmt::format("small: replaced by vertices {:.2g} m apart", spacing_m)
                        : fmt::format("large: it would take more than {} vertices {:.2g} m apart",
                                      kMostLightSamples, spacing_m);
    }

    std::string shoot_from_opening(const LuminousOpening& light) {
        const lights::EmitterSurface surface(scene_.object(light.object).shape, caster_.lift());
        const std::size_t count = points_of_opening(scene_.object(light.object));
        std::vector<lights::EmitterPoint> points;
        for (std::uint32_t i = 0; i < count; ++i) {
            const double u = (i + 0.5) / static_cast<double>(count);
            points.push_back(surface.sample_by_area({u, math::sobol(i, 0) * 0x1p-32}));
        }
        const lights::LuminaireEmitter emitter(light.luminaire, scene::LightSurroundings(scene_),
                                               caster_.lift());
        for (const auto& point : points) {
            const Frame frame = turned_about(point.normal);
            std::vector<Vec3> normals;
            for (const auto& other : points) normals.push_back(frame.to_local(other.normal));
            add_sample(false, {point.lifted, frame},
                       OpeningPointIntensity{{emitter.turned_into(frame)}, std::move(normals)});
        }
        return fmt::format("the opening of a luminaire: replaced by {} points", count);
    }

    std::size_t points_of_opening(const Object& opening) const {
        if (std::holds_alternative<Mesh>(opening.shape)) return kMostLightSamples;
        const double spacing_m = kVertexSpacing * median_flight_m(opening, caster_);
        const double count = std::ceil(area_m2(opening.shape) / (spacing_m * spacing_m));
        return static_cast<std::size_t>(
            std::clamp(count, double{kFewestOfOpening}, double{kMostLightSamples}));
    }

    bool shoot_from_sphere(const Sphere& sphere, double luminance_cd_m2, double spacing_m) {
        const std::vector<Vec3> vertices = inscribed_icosahedron(sphere).vertices;
        if (length(vertices[0] - vertices[1]) > spacing_m) return false;
        std::vector<Vec3> normals;
        for (const Vec3& vertex : vertices) normals.push_back((vertex - sphere.center) / sphere.radius);
        const double intensity_cd = kPi * sphere.radius * sphere.radius * luminance_cd_m2;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Frame frame = turned_about(normals[i]);
            std::vector<Vec3> local;
            for (const Vec3& normal : normals) local.push_back(frame.to_local(normal));
            const double lift_m = caster_.offset_m(vertices[i], sphere.radius);
            add_sample(false, {vertices[i] + lift_m * normals[i], frame},
                       SphereVertexIntensity{intensity_cd, std::move(local)});
        }
        return true;
    }

    bool shoot_from_vertices(const Shape& shape, double luminance_cd_m2, double spacing_m) {
        const double area = area_m2(shape);
        // No triangle is larger than the regular one, and there are at least half as many vertices.
        if (area / (std::sqrt(3) / 2 * spacing_m * spacing_m) > kMostLightSamples) return false;
        const patches::Patches light = light_patches(coarse(shape), spacing_m, center_);
        if (light.vertices.size() > kMostLightSamples) return false;
        double total_m2 = 0;
        for (const float patch_m2 : light.areas_m2) total_m2 += patch_m2;
        for (std::uint32_t v = 0; v < light.vertices.size(); ++v)
            shoot_from_vertex(light, v, luminance_cd_m2 * area / total_m2);
        return true;
    }

    void shoot_from_vertex(const patches::Patches& light, std::uint32_t vertex, double luminance_cd_m2) {
        double around_m2 = 0;
        Vec3 normal, position;
        for (std::uint32_t p = 0; p < light.count(); ++p) {
            const auto& [a, b, c] = light.corners[p];
            if (vertex != a && vertex != b && vertex != c) continue;
            around_m2 += light.areas_m2[p];
            normal += light.areas_m2[p] * Vec3(light.normals[p]);
            position =
                viewpoint_on(light, p, {vertex == a ? 1. : 0., vertex == b ? 1. : 0., vertex == c ? 1. : 0.})
                    .position;
        }
        const double normal_intensity_cd = luminance_cd_m2 * around_m2 / 3;
        add_sample(false, {position, turned_about(normalized(normal))}, VertexIntensity{normal_intensity_cd});
    }

    const Scene& scene_;
    const rays::RayCaster& caster_;
    Vec3 center_;
    FirstShotLights chosen_;
};

}  // namespace

double PointIntensity::operator()(const patches::BufferPixel& pixel) const {
    const Vec3 direction = normalized(pixel.direction);
    return std::visit(
        [&]<typename Emitter>(const Emitter& of) -> double {
            if constexpr (lights::PointEmitterKind<Emitter>) return of.luminous_intensity_cd(direction);
            return 0;
        },
        emitter);
}

double SphereVertexIntensity::operator()(const patches::BufferPixel& pixel) const {
    double all = 0;
    for (const Vec3& normal : normals) all += std::max(dot(normal, pixel.direction), 0.0);
    return sphere_cd * std::max(pixel.direction.z, 0.0) / all;
}

double OpeningPointIntensity::operator()(const patches::BufferPixel& pixel) const {
    double all = 0;
    for (const Vec3& normal : normals) all += std::max(dot(normal, pixel.direction), 0.0);
    return all > 0 ? luminaire(pixel) * std::max(pixel.direction.z, 0.0) / all : 0;
}

FirstShotLights choose_first_shot_lights(const Scene& scene, const rays::RayCaster& caster,
                                         const Vec3& center) {
    return Chooser(scene, caster, center).run();
}

double effective_number(const Scene& scene, const FirstShotLights& lights) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < lights.lights.size(); ++i) {
        if (!lights.lights[i].is_replaced) continue;
        const double flux = flux_lm(scene, scene.lights[i]).luminance();
        sum += flux;
        squares += flux * flux / static_cast<double>(lights.lights[i].samples);
    }
    return squares > 0 ? sum * sum / squares : 1;
}

}  // namespace stilb::estimators
