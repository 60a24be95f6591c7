#include "transport/glare/glare.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "lights/emitter_surface.h"
#include "sensors/place.h"

namespace stilb::transport {
namespace {

/// Of each lamp: in all, and in each replicate at least.
constexpr std::uint64_t kSamples = 2048, kLeastSamples = 16;

/// Where CIE 117's table of position indices ends. Quotients of coordinates are rounded.
constexpr double kMostBeside = 3 * (1 + 1e-9), kMostAbove = 2 * (1 + 1e-9);

double degrees(double angle) { return angle * 180 / std::numbers::pi; }

/// The integrals over a lamp.
struct Seen {
    double solid_angle_sr = 0, intensity = 0, direct_lx = 0;
    Vec3 middle;

    void add(const Seen& other, double share) {
        solid_angle_sr += share * other.solid_angle_sr;
        intensity += share * other.intensity;
        direct_lx += share * other.direct_lx;
        middle += share * other.middle;
    }
    /// Of a lamp that is seen.
    GlareSource source(std::uint32_t light, const Vec3& line_of_sight) const {
        const Vec3 direction = normalized(middle);
        return {light,
                solid_angle_sr,
                intensity / solid_angle_sr,
                position_index(direction, line_of_sight),
                is_in_field(direction, line_of_sight),
                {}};
    }
};

/// A direction relative to a line of sight.
struct Place {
    Place(const Vec3& direction, const Vec3& line_of_sight) {
        const Vec3 right = normalized(cross(line_of_sight, {0, 0, 1}));
        ahead = dot(direction, line_of_sight);
        beside = dot(direction, right);
        above = dot(direction, cross(right, line_of_sight));
    }

    double ahead = 0, beside = 0, above = 0;
};

class Eye {
  public:
    Eye(const MeasuringPoint& at, const rays::RayCaster& caster, const LightSampler& lights)
        : position_(place_of(at, caster).lifted), sight_(at.normal), caster_(caster), lights_(lights) {}

    /// One replicate's samples of the lamp's surface.
    Seen see(std::size_t light, const lights::EmitterSurface& surface, math::RandomKey key,
             std::uint64_t samples) const {
        Seen seen;
        for (std::uint64_t i = 0; i < samples; ++i) {
            math::SampleStream stream(key, i);
            const auto point = surface.sample_seen(position_, stream.next_two());
            if (!point) continue;
            const double cosine = dot(point->direction, sight_);
            if (!(cosine > 0)) continue;
            const double visible = caster_.transmittance({position_, point->lifted}).luminance();
            if (!(visible > 0)) continue;
            const double solid_angle_sr = 1 / (point->pdf_per_sr * static_cast<double>(samples));
            const double luminance_cd_m2 =
                visible * lights_.front_luminance(light, -point->direction).luminance();
            seen.add({solid_angle_sr, solid_angle_sr * luminance_cd_m2,
                      solid_angle_sr * luminance_cd_m2 * cosine, solid_angle_sr * point->direction},
                     1);
        }
        return seen;
    }

    struct Point {
        Vec3 direction;
        double direct_lx = 0;
    };
    /// Nothing where the eye does not see the point.
    std::optional<Point> see_point(std::size_t light) const {
        const auto incident = lights_.sample_incident(light, {position_}, {});
        if (!incident) return std::nullopt;
        const double cosine = dot(incident->direction, sight_);
        if (!(cosine > 0)) return std::nullopt;
        const double visible = caster_.transmittance({position_, incident->source_point}).luminance();
        const double direct_lx = cosine * visible * incident->normal_illuminance_lx.luminance();
        if (!(direct_lx > 0)) return std::nullopt;
        return Point{incident->direction, direct_lx};
    }

    const Vec3& sight() const { return sight_; }

  private:
    Vec3 position_, sight_;
    const rays::RayCaster& caster_;
    const LightSampler& lights_;
};

void add_lamp(const Eye& eye, std::uint32_t light, const lights::EmitterSurface& surface, math::RandomKey key,
              Glare& glare) {
    const std::size_t replicates = glare.direct_of_replicates_lx.size();
    const std::uint64_t samples = std::max(kSamples / replicates, kLeastSamples);
    std::vector<Seen> of_replicates(replicates);
    Seen all;
    for (std::size_t r = 0; r < replicates; ++r) {
        of_replicates[r] = eye.see(light, surface, key.derived(r), samples);
        all.add(of_replicates[r], 1 / static_cast<double>(replicates));
        glare.direct_of_replicates_lx[r] += of_replicates[r].direct_lx;
    }
    if (!(all.solid_angle_sr > 0)) return;
    GlareSource& source = glare.sources.emplace_back(all.source(light, eye.sight()));
    for (const Seen& seen : of_replicates) {
        source.glare_of_replicates.push_back(seen.solid_angle_sr > 0 ? seen.source(light, eye.sight()).glare()
                                                                     : 0);
    }
}

void add_point(const Eye& eye, std::uint32_t light, Glare& glare) {
    const auto point = eye.see_point(light);
    if (!point) return;
    for (double& of_replicate : glare.direct_of_replicates_lx) of_replicate += point->direct_lx;
    glare.points.push_back({light,
                            0,
                            0,
                            position_index(point->direction, eye.sight()),
                            is_in_field(point->direction, eye.sight()),
                            {}});
}

/// Whether a part of a box is above the plane of an eye.
bool is_in_front(const Bounds& box, const MeasuringPoint& eye) {
    const Vec3 half = 0.5 * (box.max - box.min), &n = eye.normal;
    return dot(box.middle() - eye.position, n) + std::abs(n.x) * half.x + std::abs(n.y) * half.y +
               std::abs(n.z) * half.z >
           0;
}

}  // namespace

bool is_in_field(const Vec3& direction, const Vec3& line_of_sight) {
    const Place place(direction, line_of_sight);
    return place.ahead > 0 && std::abs(place.beside) <= kMostBeside * place.ahead &&
           std::abs(place.above) <= kMostAbove * place.ahead &&
           position_index(direction, line_of_sight) < kMostPositionIndex;
}

double position_index(const Vec3& direction, const Vec3& line_of_sight) {
    const auto [ahead, beside, above] = Place(direction, line_of_sight);
    const double across = std::hypot(beside, above);
    const double s = degrees(std::atan2(across, ahead));
    const double t = across > 0 ? degrees(std::acos(std::min(std::abs(above) / across, 1.0))) : 0;
    if (s >= 90) return kMostPositionIndex;
    if (above >= 0) {
        const double first = (35.2 - 0.31889 * t - 1.22 * std::exp(-2 * t / 9)) * 1e-3;
        const double second = (21 + 0.26667 * t - 0.002963 * t * t) * 1e-5;
        return std::min(std::exp(first * s + second * s * s), kMostPositionIndex);
    }
    const double cosine = std::abs(above) / across;
    const double b = degrees(std::atan(across / ahead * std::sqrt(1 + 0.3225 * cosine * cosine)));
    return std::min(std::exp(6.49e-3 * b + 21e-5 * b * b), kMostPositionIndex);
}

Glare find_glare(const MeasuringPoint& at, const Scene& scene, const rays::RayCaster& caster,
                 const LightSampler& lights, math::RandomKey key, std::size_t replicates) {
    Glare glare;
    glare.direct_of_replicates_lx.resize(replicates);
    const Eye eye(at, caster, lights);
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const bool is_diffuser = std::ranges::any_of(object.materials, [&](MaterialId material) {
            return scatters_through(scene.material(material));
        });
        if (is_diffuser && is_in_front(bounds_of(object.shape), at)) glare.diffusers.push_back(ObjectId{i});
    }
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        switch (location_of(scene.lights[i])) {
            case LightLocation::point:
                add_point(eye, i, glare);
                break;
            case LightLocation::surface: {
                const ObjectId object = *lights::emitting_object(scene.lights[i]);
                const lights::EmitterSurface surface(scene.object(object).shape, caster.lift());
                add_lamp(eye, i, surface, key.derived(i), glare);
                break;
            }
            case LightLocation::infinity:
                break;  // background
        }
    }
    return glare;
}

}  // namespace stilb::transport
