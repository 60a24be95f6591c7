// Whether the light of each lamp gets to any sensor, and any light to each sensor.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>

#include "checks/checks.h"
#include "checks/streams.h"
#include "checks/walks.h"
#include "math/sampling.h"
#include "sensors/place.h"
#include "transport/light_sampler.h"

namespace stilb::checks {
namespace {

constexpr int kReachReflections = 4;
/// Places of all sensors at which walks start, and the fewest and the most of one sensor.
constexpr std::size_t kStarts = 512, kFewestStarts = 4, kMostStarts = 64;
/// Particles of a light that does not seem to reach a sensor: enough to find a door that is ajar.
constexpr std::uint64_t kMostParticles = 512;
/// Places near sensors that each place of a particle is connected to.
constexpr std::size_t kConnections = 8;
/// Connections that are tried for all lights, and for all sensors: less than a tenth of a second each. What
/// is not judged by then is not named.
constexpr std::size_t kMostConnections = 400'000;

/// The places around one sensor from which it receives light.
struct Surroundings {
    std::string name;
    Trail trail;
    Vec3 first;  ///< where the first walk starts
};

/// The start of a walk against the light, and whether light that arrives there is measured.
struct WalkStart {
    SurfacePoint at;
    Vec3 direction;
    bool receives_light = false;
};

std::optional<WalkStart> start_of(const Measurand& measurand, const rays::RayCaster& caster,
                                  math::SampleStream& stream) {
    const auto [u1, u2] = stream.next_two();
    const MeasuringPoint point = viewpoint_of(measurand);
    if (const auto* body = std::get_if<BodyPoint>(&measurand)) {
        const Vec3 direction = math::sample_sphere(u1, u2).direction;
        return WalkStart{{body->position, direction, place_of(*body, caster).lifted}, direction, true};
    }
    const SurfacePoint at = place_of(point, caster);
    if (std::holds_alternative<LineOfSight>(measurand)) return WalkStart{at, point.normal};
    const Vec3 direction =
        Frame::around(point.normal).to_world(math::sample_cosine_hemisphere(u1, u2).direction);
    return WalkStart{at, direction, true};
}

std::optional<WalkStart> start_of(const Camera& camera, math::SampleStream& stream) {
    const auto [u1, u2] = stream.next_two();
    const auto direction =
        sensors::CameraView(camera).direction_at(u1 * camera.resolution[0], u2 * camera.resolution[1]);
    if (!direction) return std::nullopt;
    return WalkStart{{camera.position, *direction}, *direction};
}

Surroundings surroundings_of(const Sensor& sensor, std::size_t starts, const Scene& scene,
                             const rays::RayCaster& caster) {
    const Camera* camera = sensor.camera();
    Surroundings around{sensor.name, Trail(scene), {}};
    if (camera) around.first = camera->position;
    for (std::size_t i = 0; i < starts; ++i) {
        math::SampleStream stream(kCheckKey.derived(CheckStream::from_sensors), i);
        const auto start = camera ? start_of(*camera, stream)
                                  : start_of(sensor.measurand(i * sensor.size() / starts), caster, stream);
        if (!start) continue;
        if (i == 0) around.first = start->at.lifted;
        if (start->receives_light) around.trail.points.push_back(start->at);
        follow_walk(scene, caster, {start->at.lifted, start->direction}, kReachReflections, stream,
                    around.trail);
    }
    return around;
}

/// A light, and the places that its particles have reached.
struct Shining {
    lights::Emitter emitter;
    std::optional<ObjectId> object;  ///< that shines
    bool is_outside = false;
    Trail trail;

    Shining(const Light& light, const Scene& scene, const rays::RayCaster& caster)
        : emitter(lights::make_emitter(light, scene::LightSurroundings(scene), caster.lift())),
          is_outside(location_of(light) == LightLocation::infinity),
          trail(scene) {
        if (const auto surface = lights::emitting_object(light)) object = *surface;
    }

    lights::Emission emit(math::SampleStream& stream) const {
        return std::visit([&](const auto& own) { return own.emit(stream); }, emitter);
    }

    std::optional<lights::IncidentLight> sample_incident(const SurfacePoint& at,
                                                         const std::array<double, 2>& u) const {
        return std::visit([&](const auto& own) { return own.sample_incident(at, u); }, emitter);
    }

    /// Whether a walk of a sensor has met the light itself.
    bool is_met_by(const Trail& walks) const {
        return object ? walks.is_object_met[index_of(*object)] : is_outside && walks.leaves_scene;
    }
};

bool meets_nothing(const Trail& trail) { return std::ranges::none_of(trail.is_object_met, std::identity{}); }

/// A sentence for the lights that shine past everything: where there are no sensors.
std::vector<std::string> lost_light_warnings(const Scene& scene, const rays::RayCaster& caster) {
    constexpr std::uint64_t particles = 64;
    std::vector<std::string> lost;
    for (const Light& light : scene.lights) {
        Shining shining(light, scene, caster);
        if (shining.is_outside) continue;
        for (std::uint64_t i = 0; i < particles && meets_nothing(shining.trail); ++i) {
            math::SampleStream stream(kCheckKey.derived(CheckStream::from_lights), i);
            const lights::Emission particle = shining.emit(stream);
            follow_walk(scene, caster, {particle.origin, particle.direction}, 0, stream, shining.trail);
        }
        if (meets_nothing(shining.trail)) lost.push_back(light.name);
    }
    if (lost.empty()) return {};
    const bool is_one = lost.size() == 1;
    return {fmt::format("{} {}: none of {} light meets a surface. Turn {} towards the scene.",
                        is_one ? "light" : "lights", list_of(lost), is_one ? "its" : "their",
                        is_one ? "it" : "them")};
}

class ReachCheck {
  public:
    ReachCheck(const Scene& scene, const rays::RayCaster& caster, std::span<const Sensor> sensors,
               const Explained& explained)
        : scene_(scene), caster_(caster), explained_(explained), all_places_(scene) {
        are_cameras_ =
            std::ranges::all_of(sensors, [](const Sensor& sensor) { return sensor.camera() != nullptr; });
        std::vector<const Sensor*> unexplained;
        for (std::size_t i = 0; i < sensors.size() && unexplained.size() < kStarts; ++i) {
            if (!explained.sensors[i]) unexplained.push_back(&sensors[i]);
        }
        for (const Sensor* sensor : unexplained) {
            around_.push_back(
                surroundings_of(*sensor, std::clamp(kStarts / unexplained.size(), kFewestStarts, kMostStarts),
                                scene, caster));
            add_to_all(around_.back().trail);
        }
    }

    std::vector<std::string> warnings() {
        if (around_.empty() || unexplained_lights() == 0) return {};
        std::vector<std::string> dark;
        std::string in_the_way;
        std::size_t judged = 0;
        for (; judged < scene_.lights.size(); ++judged) {
            if (explained_.lights[judged]) continue;
            const Light& light = scene_.lights[judged];
            Shining shining(light, scene_, caster_);
            const auto reaches = reaches_a_sensor(shining);
            if (!reaches) break;
            if (!*reaches) {
                if (dark.empty()) in_the_way = obstacle_of(shining);
                dark.push_back(light.name);
            }
            keep(shining);
        }
        const bool all_are_judged = judged == scene_.lights.size();
        if (all_are_judged && !dark.empty() && dark.size() == unexplained_lights())
            return {fmt::format("no light reaches {}{}.",
                                are_cameras_ ? "what the camera sees" : "any sensor", in_the_way)};
        std::vector<std::string> warnings;
        if (!dark.empty()) {
            const bool is_one = dark.size() == 1;
            warnings.push_back(fmt::format(
                "{} {}: none of {} light reaches {}{}.", is_one ? "light" : "lights",
                list_of(dark, all_are_judged ? Listed::all : Listed::some), is_one ? "its" : "their",
                are_cameras_ ? "what the camera sees" : "a sensor", in_the_way));
        }
        if (all_are_judged) add_dark_sensors(warnings);
        return warnings;
    }

  private:
    void add_to_all(const Trail& trail) {
        all_places_.points.insert(all_places_.points.end(), trail.points.begin(), trail.points.end());
        all_places_.leaves_scene = all_places_.leaves_scene || trail.leaves_scene;
        for (std::size_t i = 0; i < trail.is_object_met.size(); ++i) {
            if (trail.is_object_met[i]) all_places_.is_object_met[i] = true;
        }
    }

    void keep(const Shining& shining) {
        if (shining.object) lamps_.push_back(*shining.object);
        has_outside_ = has_outside_ || shining.is_outside;
    }

    std::size_t unexplained_lights() const {
        return static_cast<std::size_t>(std::ranges::count(explained_.lights, false));
    }

    /// Nothing where the number of connections is used up.
    std::optional<bool> reaches_a_sensor(Shining& shining) {
        if (shining.is_met_by(all_places_)) return true;
        for (std::uint64_t i = 0; i < kMostParticles; ++i) {
            math::SampleStream stream(kCheckKey.derived(CheckStream::from_lights), i);
            const lights::Emission particle = shining.emit(stream);
            const std::size_t known = shining.trail.points.size();
            if (is_lit_directly(all_places_.points, shining)) return true;
            follow_walk(scene_, caster_, {particle.origin, particle.direction}, kReachReflections, stream,
                        shining.trail);
            for (std::size_t j = known; j < shining.trail.points.size(); ++j) {
                if (is_connected(shining.trail.points[j], all_places_.points)) return true;
            }
            if (connections_ > kMostConnections) return std::nullopt;
        }
        return false;
    }

    /// Whether a sample of the light itself, not of a reflection, gets to one of some places.
    bool is_lit_directly(const std::vector<SurfacePoint>& places, const Shining& shining) {
        for (std::size_t k = 0; k < std::min(kConnections, places.size()); ++k) {
            math::SampleStream stream(kCheckKey.derived(CheckStream::pairs), connections_++);
            const SurfacePoint& place =
                places[static_cast<std::size_t>(stream.next() * static_cast<double>(places.size()))];
            const auto [u1, u2] = stream.next_two();
            const auto sample = transport::direct_sample(shining.sample_incident(place, {u1, u2}), place);
            if (sample && caster_.transmittance(sample->segment).max() > 0) return true;
        }
        return false;
    }

    bool is_connected(const SurfacePoint& place, const std::vector<SurfacePoint>& others) {
        for (std::size_t k = 0; k < std::min(kConnections, others.size()); ++k) {
            math::SampleStream stream(kCheckKey.derived(CheckStream::pairs), connections_++);
            const auto other = static_cast<std::size_t>(stream.next() * static_cast<double>(others.size()));
            if (sees(place, others[other], caster_)) return true;
        }
        return false;
    }

    /// Whether walks of a sensor have met a lamp, or the light from outside.
    bool meets_light(const Trail& walks) const {
        return (has_outside_ && walks.leaves_scene) ||
               std::ranges::any_of(
                   lamps_, [&](ObjectId lamp) -> bool { return walks.is_object_met[index_of(lamp)]; });
    }

    void add_dark_sensors(std::vector<std::string>& warnings) {
        std::vector<std::string> dark;
        connections_ = 0;
        std::vector<SurfacePoint> lit;  // found for the first sensor that meets no light: it takes time
        for (const Surroundings& around : around_) {
            if (meets_light(around.trail)) continue;
            if (lit.empty()) lit = lit_places(scene_, caster_);
            if (std::ranges::any_of(around.trail.points,
                                    [&](const SurfacePoint& place) { return is_connected(place, lit); }))
                continue;
            if (connections_ > kMostConnections) break;
            dark.push_back(around.name);
        }
        if (dark.empty()) return;
        warnings.push_back(fmt::format(
            "{} {}: no light reaches {}. Is the normal turned into a wall, or is everything else "
            "behind a closed surface?",
            dark.size() == 1 ? "sensor" : "sensors", list_of(dark), dark.size() == 1 ? "it" : "them"));
    }

    /// Why no light reaches the first sensor: the object that stands between; empty where none does.
    std::string obstacle_of(const Shining& shining) const {
        if (meets_nothing(shining.trail)) return ": it meets no surface. Turn it towards the scene";
        math::SampleStream stream(kCheckKey.derived(CheckStream::from_lights), 0);
        const Vec3 origin = shining.emit(stream).origin, to_sensor = around_.front().first - origin;
        if (!(length(to_sensor) > 0)) return "";
        const auto hit = caster_.closest(origin, normalized(to_sensor));
        if (!hit || hit->distance_m >= length(to_sensor)) return "";
        if (hit->object == shining.object) {
            return fmt::format(": the front of object \"{}\", which alone emits light, is turned away",
                               scene_.object(hit->object).name);
        }
        return fmt::format(": object \"{}\" is in the way", scene_.object(hit->object).name);
    }

    const Scene& scene_;
    const rays::RayCaster& caster_;
    const Explained& explained_;
    std::vector<Surroundings> around_;  ///< by sensor
    Trail all_places_;                  ///< of all sensors
    std::vector<ObjectId> lamps_;       ///< whose light walks may meet
    bool has_outside_ = false, are_cameras_ = false;
    std::size_t connections_ = 0;
};

}  // namespace

std::vector<std::string> reach_warnings(const Scene& scene, const rays::RayCaster& caster,
                                        std::span<const Sensor> sensors, const Explained& explained) {
    if (sensors.empty()) return lost_light_warnings(scene, caster);
    return ReachCheck(scene, caster, sensors, explained).warnings();
}

}  // namespace stilb::checks
