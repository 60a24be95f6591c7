#include "transport/direct/direct_light.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "transport/direct/one_receiver.h"
#include "transport/direct/tile_choice.h"

namespace stilb::transport {

/// Light that shadow rays of a tile bring in.
struct DirectLight::ShadowRays {
    struct Received {
        std::size_t lane, light;
        Rgb value;  ///< without shadows
    };
    std::array<rays::Segment, kPacketWidth> segments;
    std::array<Received, kPacketWidth> received;
    std::size_t count = 0;

    void add(std::size_t lane, const rays::Segment& segment, const Rgb& unshadowed, std::size_t light) {
        segments[count] = segment;
        received[count++] = {lane, light, unshadowed};
    }
    void trace(const rays::RayCaster& caster, TileLight& light) const {
        if (count == 0) return;
        std::array<Rgb, kPacketWidth> transmittances;
        caster.transmittances(std::span(segments).first(count), rays::Coherence::coherent,
                              std::span(transmittances).first(count));
        for (std::size_t i = 0; i < count; ++i)
            light.add(received[i].lane, received[i].value * transmittances[i], received[i].light);
    }
};

double DirectLight::Remainder::rays(std::size_t receivers) const {
    int of_lamps = 0;
    for (const std::uint32_t bits : lamps) of_lamps += std::popcount(bits);
    for (const OpenLamps& of_receiver : open) of_lamps += static_cast<int>(of_receiver.choices());
    const double directions = chooses_by_tree ? double{OpenLamps::kChosen} : by_directions ? 1 : 0;
    const double each = directions + (points ? double{kChosen} : 0);
    return of_lamps + each * static_cast<double>(receivers);
}

DirectLight::DirectLight(const Scene& scene, const rays::RayCaster& caster, const LightSampler& lights)
    : scene_(scene), caster_(caster), lights_(lights), has_many_lamps_(lights.chooses_extended()) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        if (lights.is_point(i)) {
            points_.push_back(i);
        } else if (auto lamp = UniformLamp::of(scene, i, caster.lift())) {
            lamps_.push_back(std::move(*lamp));
        } else if (auto opening = OpeningLamp::of(scene, i, lights, caster.lift())) {
            openings_.push_back(std::move(*opening));
        } else if (has_many_lamps_ && location_of(scene.lights[i]) == LightLocation::surface) {
            surfaces_.push_back(i);
        } else {
            others_.push_back(i);
        }
    }
    if (points_.size() > kFewPoints)
        tree_of_points_ =
            LightTree(lights.leaves(scene, [&](std::size_t light) { return lights.is_point(light); }));
    if (lamp_count() > 0) shafts_.emplace(scene, caster.center());
}

DirectLight::Prepared DirectLight::prepare(std::span<const Receiver> receivers, const Monitor& monitor,
                                           PartsOfLight parts) const {
    const std::size_t tiles = (receivers.size() + kPacketWidth - 1) / kPacketWidth;
    const bool exact_points = points_.size() <= kFewPoints || points_.size() * receivers.size() <= kMostExact;
    const std::size_t lamps = lamp_count() + surfaces_.size();
    const bool settles = has_many_lamps_ && lamps * receivers.size() <= kMostSettled;
    Prepared prepared{std::vector<Rgb>(receivers.size()), {}, std::vector<Remainder>(tiles)};
    if (parts == PartsOfLight::all) prepared.parts.resize(receivers.size());
    parallel_for(tiles, [&](std::size_t t) {
        monitor.require_more();
        const std::size_t first = t * kPacketWidth;
        const auto tile =
            receivers.subspan(first, std::min<std::size_t>(kPacketWidth, receivers.size() - first));
        std::array<LightParts, kPacketWidth> of_tile;
        TileLight light{{}, prepared.parts.empty() ? nullptr : &of_tile};
        prepared.remainders[t] = add_known(tile, settles, light);
        settle_one_by_one(tile, prepared.remainders[t], light);
        // The tree chooses for surfaces.
        prepared.remainders[t].points = !exact_points && std::ranges::none_of(tile, &Receiver::is_body);
        if (!prepared.remainders[t].points) add_points(tile, light);
        for (std::size_t i = 0; i < tile.size(); ++i) {
            prepared.known[first + i] = light[i];
            if (light.parts) prepared.parts[first + i] = std::move(of_tile[i]);
        }
    });
    return prepared;
}

auto DirectLight::add_certain(std::span<const Receiver> tile, TileLight& light) const -> Remainder {
    Remainder remainder = add_known(tile, false, light);
    remainder.points = points_.size() > kFewPoints;
    if (!remainder.points) add_points(tile, light);
    return remainder;
}

const LampHull& DirectLight::hull_of(std::size_t lamp) const {
    return lamp < lamps_.size() ? lamps_[lamp].hull() : openings_[lamp - lamps_.size()].hull();
}

std::size_t DirectLight::light_of(std::size_t lamp) const {
    if (lamp < lamps_.size()) return lamps_[lamp].light();
    return lamp < lamp_count() ? openings_[lamp - lamps_.size()].light() : surfaces_[lamp - lamp_count()];
}

/// Of all of the lamp, where that is known.
std::optional<Rgb> DirectLight::whole_lx(std::size_t lamp, const SurfacePoint& at) const {
    if (lamp < lamps_.size()) return lamps_[lamp].illuminance_lx(at);
    return openings_[lamp - lamps_.size()].illuminance_lx(at);
}

/// Of all of the lamp, or of a surface without closed form: 0 only where that gives no light.
double DirectLight::rough_lx(std::size_t lamp, const SurfacePoint& at) const {
    if (lamp < lamps_.size()) return lamps_[lamp].illuminance_lx(at).luminance();
    return lights_.rough_illuminance_lx(light_of(lamp), at);
}

std::optional<DirectSample> DirectLight::sample_lamp(std::size_t lamp, const SurfacePoint& at,
                                                     math::SampleStream& stream) const {
    if (lamp < lamps_.size()) return lamps_[lamp].sample(at, stream);
    return direct_sample(lights_.sample_incident(light_of(lamp), at, stream.next_two()), at);
}

DirectLight::Remainder DirectLight::add_known(std::span<const Receiver> tile, bool settles,
                                              TileLight& light) const {
    Remainder remainder;
    remainder.chooses_by_tree =
        has_many_lamps_ && !settles &&
        std::ranges::any_of(tile, [&](const Receiver& receiver) { return has_closed_form(receiver); });
    for (const Receiver& receiver : tile)
        remainder.by_directions |=
            samples_all(receiver, remainder) ? lights_.has_visible_lights() : !others_.empty();
    if (!has_many_lamps_) add_few_lamps(tile, remainder, light);
    if (settles) settle_many_lamps(tile, remainder, light);
    return remainder;
}

/// Uniform lamps that are seen for certain; the others, unless they give no light, remain.
void DirectLight::add_few_lamps(std::span<const Receiver> tile, Remainder& remainder,
                                TileLight& light) const {
    for (std::size_t l = 0; l < lamps_.size(); ++l) {
        std::array<Rgb, kPacketWidth> whole_lx{};
        std::array<Vec3, kPacketWidth> lit;
        std::size_t count = 0;
        for (std::size_t i = 0; i < tile.size(); ++i) {
            if (!has_closed_form(tile[i])) continue;
            whole_lx[i] = lamps_[l].illuminance_lx(tile[i].point());
            if (whole_lx[i].max() > 0) lit[count++] = tile[i].lifted();
        }
        if (count == 0) continue;
        if (!lamps_[l].hull().is_seen_from(std::span(lit).first(count), *shafts_)) {
            for (std::size_t i = 0; i < tile.size(); ++i) {
                if (whole_lx[i].max() > 0) remainder.lamps[i] |= 1u << l;
            }
            continue;
        }
        for (std::size_t i = 0; i < tile.size(); ++i) {
            if (whole_lx[i].max() > 0)
                light.add(i, whole_lx[i] * *tile[i].constant_response(), lamps_[l].light());
        }
    }
    for (std::size_t o = 0; o < openings_.size(); ++o) {
        for (std::size_t i = 0; i < tile.size(); ++i) {
            if (has_closed_form(tile[i]) && openings_[o].may_light(tile[i].point()))
                remainder.lamps[i] |= 1u << (lamps_.size() + o);
        }
    }
}

/// From one receiver the shaft to a lamp is narrower than from all of them, and one face may hide the lamp.
/// The light of openings that are seen for certain is integrated here.
std::optional<Rgb> DirectLight::settled_lx(std::size_t lamp, const Receiver& receiver) const {
    const LampHull& hull = hull_of(lamp);
    if (hull.is_hidden_from(receiver.lifted(), scene_, caster_)) return Rgb{};
    if (!hull.is_seen_from(std::span(&receiver.lifted(), 1), *shafts_)) return std::nullopt;
    return whole_lx(lamp, receiver.point());
}

void DirectLight::settle_one_by_one(std::span<const Receiver> tile, Remainder& remainder,
                                    TileLight& light) const {
    for (std::size_t i = 0; i < tile.size(); ++i) {
        for (std::size_t l = 0; remainder.lamps[i] != 0 && l < lamp_count(); ++l) {
            const std::uint32_t bit = 1u << l;
            if ((remainder.lamps[i] & bit) == 0) continue;
            const auto received_lx = settled_lx(l, tile[i]);
            if (!received_lx) continue;
            remainder.lamps[i] &= ~bit;
            light.add(i, *received_lx * *tile[i].constant_response(), light_of(l));
        }
    }
}

void DirectLight::settle_many_lamps(std::span<const Receiver> tile, Remainder& remainder,
                                    TileLight& light) const {
    std::vector<OpenLamps> open(tile.size());
    for (std::size_t l = 0; l < lamp_count() + surfaces_.size(); ++l) {
        std::array<double, kPacketWidth> rough{};
        std::array<Vec3, kPacketWidth> lit;
        std::size_t count = 0;
        for (std::size_t i = 0; i < tile.size(); ++i) {
            if (!has_closed_form(tile[i])) continue;
            rough[i] = rough_lx(l, tile[i].point());
            if (rough[i] > 0) lit[count++] = tile[i].lifted();
        }
        const bool may_settle = count > 0 && l < lamp_count();
        const bool all_see_it = may_settle && hull_of(l).is_seen_from(std::span(lit).first(count), *shafts_);
        for (std::size_t i = 0; i < tile.size(); ++i) {
            if (!(rough[i] > 0)) continue;
            std::optional<Rgb> received_lx;
            if (all_see_it)
                received_lx = whole_lx(l, tile[i].point());
            else if (may_settle)
                received_lx = settled_lx(l, tile[i]);
            if (received_lx) {
                light.add(i, *received_lx * *tile[i].constant_response(), light_of(l));
            } else {
                open[i].add(l, rough[i]);
            }
        }
    }
    for (OpenLamps& of_receiver : open) of_receiver.finish();
    if (std::ranges::any_of(open, [](const OpenLamps& lamps) { return lamps.choices() > 0; }))
        remainder.open = std::move(open);
}

void DirectLight::add_sample(std::span<const Receiver> tile, const Remainder& remainder,
                             std::span<math::SampleStream> streams, TileLight& light) const {
    if (remainder.has_lamps()) {
        for (std::size_t l = 0; l < lamp_count(); ++l) add_shadowed(tile, l, remainder, streams, light);
    }
    if (!remainder.open.empty()) add_chosen_lamps(tile, remainder, streams, light);
    if (remainder.by_directions) add_by_directions(tile, remainder, streams, light);
    if (remainder.points) add_chosen_points(tile, streams[0], light);
}

void DirectLight::add_shadowed(std::span<const Receiver> tile, std::size_t lamp, const Remainder& remainder,
                               std::span<math::SampleStream> streams, TileLight& light) const {
    ShadowRays shadow_rays;
    for (std::size_t i = 0; i < tile.size(); ++i) {
        if ((remainder.lamps[i] >> lamp & 1u) == 0) continue;
        if (const auto sample = sample_lamp(lamp, tile[i].point(), streams[i]))
            shadow_rays.add(i, sample->segment, sample->illuminance_lx * *tile[i].constant_response(),
                            light_of(lamp));
    }
    shadow_rays.trace(caster_, light);
}

void DirectLight::add_chosen_lamps(std::span<const Receiver> tile, const Remainder& remainder,
                                   std::span<math::SampleStream> streams, TileLight& light) const {
    std::array<double, kPacketWidth> first{};
    for (std::size_t i = 0; i < tile.size(); ++i) first[i] = streams[i].next();
    for (std::size_t choice = 0; choice < OpenLamps::kChosen; ++choice) {
        ShadowRays shadow_rays;
        for (std::size_t i = 0; i < tile.size(); ++i) {
            if (choice >= remainder.open[i].choices()) continue;
            const auto [lamp, factor] = remainder.open[i].choose(choice, first[i]);
            if (const auto sample = sample_lamp(lamp, tile[i].point(), streams[i]))
                shadow_rays.add(i, sample->segment,
                                factor * sample->illuminance_lx * *tile[i].constant_response(),
                                light_of(lamp));
        }
        shadow_rays.trace(caster_, light);
    }
}

/// Lights that add_known() leaves out.
void DirectLight::add_by_directions(std::span<const Receiver> tile, const Remainder& remainder,
                                    std::span<math::SampleStream> streams, TileLight& light) const {
    for (std::size_t i = 0; i < tile.size(); ++i) {
        if (samples_all(tile[i], remainder))
            light[i] += sample_direct_from_areas(tile[i], caster_, lights_, streams[i], light.parts_of(i));
    }
    if (remainder.chooses_by_tree) return;
    for (const std::size_t other : others_) {
        ShadowRays shadow_rays;
        for (std::size_t i = 0; i < tile.size(); ++i) {
            if (!samples_all(tile[i], remainder))
                add_ray(tile, i, other, streams[i].next_two(), 1, shadow_rays);
        }
        shadow_rays.trace(caster_, light);
    }
}

void DirectLight::add_points(std::span<const Receiver> tile, TileLight& light) const {
    for (const std::size_t point : points_) add_point(tile, point, 1, light);
}

void DirectLight::add_point(std::span<const Receiver> tile, std::size_t point, double factor,
                            TileLight& light) const {
    ShadowRays shadow_rays;
    for (std::size_t i = 0; i < tile.size(); ++i) add_ray(tile, i, point, {}, factor, shadow_rays);
    shadow_rays.trace(caster_, light);
}

/// A sample of a light at the receiver of a lane.
void DirectLight::add_ray(std::span<const Receiver> tile, std::size_t lane, std::size_t light,
                          const std::array<double, 2>& u, double factor, ShadowRays& shadow_rays) const {
    const Receiver& receiver = tile[lane];
    const auto incident = lights_.sample_incident(light, receiver.point(), u);
    if (!incident) return;
    const double sensitivity = receiver.sensitivity(incident->direction);
    if (!(sensitivity > 0) || !(incident->normal_illuminance_lx.max() > 0)) return;
    shadow_rays.add(
        lane, {receiver.lifted(), incident->source_point},
        factor * sensitivity * incident->normal_illuminance_lx * receiver.response(incident->direction).value,
        light);
}

/// Neighbouring choices often are the same light.
void DirectLight::add_chosen_points(std::span<const Receiver> tile, math::SampleStream& stream,
                                    TileLight& light) const {
    const double first = stream.next();
    const TileChoice lights(tree_of_points_, lights_, tile, caster_.center());
    if (lights.is_empty()) return;
    std::size_t previous = ~std::size_t{0};
    double factor = 0;
    choose_evenly(lights, kChosen, first, [&](const math::DiscreteChoice& choice, double expected) {
        if (choice.index != previous) {
            if (factor > 0) add_point(tile, previous, factor, light);
            previous = choice.index, factor = 0;
        }
        factor += 1 / expected;
    });
    add_point(tile, previous, factor, light);
}

}  // namespace stilb::transport
