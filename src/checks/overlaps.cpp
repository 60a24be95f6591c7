#include "scene/overlaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "base/vec.h"
#include "checks/checks.h"
#include "checks/walks.h"
#include "materials/dielectric.h"
#include "math/sampling.h"

namespace stilb::checks {
namespace {

struct Found {
    std::size_t count = 0;
    Vec3 where;
};
std::string lamp_text(const std::string& lamp, const std::string& other, const Found& found) {
    return fmt::format(
        "lamp \"{}\" lies in the plane of object \"{}\", at ({:.4g}, {:.4g}, {:.4g}): the lamp is taken, the "
        "wall behind it is hidden there. Move the lamp by a millimetre to say which one is in front.",
        lamp, other, found.where.x, found.where.y, found.where.z);
}

std::string text_of(const std::string& first, const std::string& second, const Found& found,
                    bool all_are_known) {
    const std::string named = first == second ? fmt::format("object \"{}\": parts of it", first)
                                              : fmt::format("objects \"{}\" and \"{}\"", first, second);
    return fmt::format(
        "{} overlap in one plane ({}{} pair{} of triangles, one at ({:.4g}, {:.4g}, {:.4g})): rounding "
        "decides "
        "which of them light meets. Move one of them by a millimetre.",
        named, all_are_known ? "" : "at least ", found.count, found.count == 1 ? "" : "s", found.where.x,
        found.where.y, found.where.z);
}

/// Decides which overlaps matter.
class OverlapLight {
  public:
    OverlapLight(const Scene& scene, const rays::RayCaster& caster, std::span<const Sensor> sensors)
        : scene_(scene),
          caster_(caster),
          sensors_(sensors),
          lit_(lit_places(scene, caster)),
          is_lamp_(scene.objects.size()),
          is_opening_(scene.objects.size()) {
        for (const Light& light : scene.lights) {
            const auto surface = lights::emitting_object(light);
            if (!surface) continue;
            is_lamp_[index_of(*surface)] = true;
            is_opening_[index_of(*surface)] = lights::opening_of(light).has_value();
        }
    }

    /// Lamps in one place, whose light adds up: lamps.cpp warns of those that are alike.
    bool are_lamps_in_one_place(const Scene& scene, const Overlap& overlap) const {
        return is_lamp_[index_of(overlap.first)] && is_lamp_[index_of(overlap.second)] &&
               coincide(scene.object(overlap.first).shape, scene.object(overlap.second).shape,
                        caster_.offset_m(overlap.position, 0));
    }

    bool is_lamp_on(const Overlap& overlap) const {
        return is_lamp_[index_of(overlap.first)] && !is_lamp_[index_of(overlap.second)];
    }

    /// Whether light arrives there and anything is in sight. Of lamps only the fronts count: behind them the
    /// other surface is hidden anyway.
    bool matters(const Overlap& overlap) const {
        // A luminaire in the plane of a ceiling is placed as it should be (docs/photometry.md).
        if (is_opening_[index_of(overlap.first)] && is_lamp_on(overlap)) return false;
        // Light between two bodies of glass arrives there by refraction.
        if (is_glass(overlap.first) && is_glass(overlap.second)) return true;
        // Twice as far from the plane as a lamp that was put in front of it.
        const Vec3 off =
            4 * caster_.offset_m(overlap.position, caster_.lift().largest_size_m()) * overlap.normal;
        return is_lit({overlap.position + off, overlap.normal}) ||
               (!is_lamp_on(overlap) && is_lit({overlap.position - off, -overlap.normal}));
    }

  private:
    bool is_glass(ObjectId object) const {
        return std::ranges::any_of(scene_.object(object).materials, [&](MaterialId material) {
            return scene_.material(material).is<Dielectric>();
        });
    }

    bool is_lit(const SurfacePoint& side) const {
        return std::ranges::any_of(lit_, [&](const SurfacePoint& lit) { return sees(side, lit, caster_); }) &&
               is_looked_at(side);
    }

    /// Whether another surface or a sensor is on that side. Below the ground that a house stands on there is
    /// nothing, though light from infinity gets there.
    bool is_looked_at(const SurfacePoint& side) const {
        constexpr std::uint64_t rays = 16;
        constexpr std::size_t most_sensors = 64;
        if (sensors_.empty()) return true;
        const Frame frame = Frame::around(side.normal);
        for (std::uint64_t i = 0; i < rays; ++i) {
            math::SampleStream stream(math::RandomKey{}, i);
            const auto [u1, u2] = stream.next_two();
            const Vec3 direction = frame.to_world(math::sample_cosine_hemisphere(u1, u2).direction);
            if (caster_.closest(side.lifted, direction)) return true;
        }
        const auto some = sensors_.first(std::min(sensors_.size(), most_sensors));
        return std::ranges::any_of(some, [&](const Sensor& sensor) {
            const Vec3 at = sensor.camera() ? sensor.camera()->position : position_of(sensor.measurand(0));
            return dot(at - side.lifted, side.normal) > 0 && !caster_.occluded(side.lifted, at);
        });
    }

    const Scene& scene_;
    const rays::RayCaster& caster_;
    std::span<const Sensor> sensors_;
    std::vector<SurfacePoint> lit_;
    std::vector<bool> is_lamp_, is_opening_;  ///< by object
};

}  // namespace

std::vector<std::string> overlap_warnings(const Scene& scene, const rays::RayCaster& caster,
                                          std::span<const Overlap> overlaps,
                                          std::span<const Sensor> sensors) {
    if (overlaps.empty() || scene.lights.empty()) return {};
    std::map<std::pair<ObjectId, ObjectId>, std::vector<Overlap>> by_objects;
    for (const Overlap& overlap : overlaps) by_objects[{overlap.first, overlap.second}].push_back(overlap);
    const OverlapLight light(scene, caster, sensors);
    std::vector<std::string> of_lamps, undecided;
    for (const auto& [objects, of_pair] : by_objects) {
        if (light.are_lamps_in_one_place(scene, of_pair.front())) continue;
        const auto lit = std::ranges::find_if(of_pair, [&](const Overlap& o) { return light.matters(o); });
        if (lit == of_pair.end()) continue;
        const Found found{of_pair.size(), lit->position};
        const std::string &first = scene.object(objects.first).name,
                          &second = scene.object(objects.second).name;
        if (light.is_lamp_on(*lit)) {
            of_lamps.push_back(lamp_text(first, second, found));
        } else {
            undecided.push_back(text_of(first, second, found, overlaps.size() < kMostOverlaps));
        }
    }
    of_lamps.insert(of_lamps.end(), undecided.begin(), undecided.end());
    return of_lamps;
}

}  // namespace stilb::checks
