#include "transport/direct/direct_light.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "transport/direct/tile_choice.h"

namespace stilb::transport {
namespace {

lights::LitPoint lit_point(const Receiver& receiver) { return {receiver.position(), receiver.normal()}; }

}  // namespace

/// Light that shadow rays of a tile bring in.
struct DirectLight::ShadowRays {
    std::array<rays::Segment, kPacketWidth> segments;
    std::array<Rgb, kPacketWidth> received;  ///< without shadows
    std::array<std::size_t, kPacketWidth> lanes;
    std::size_t count = 0;

    void add(std::size_t lane, const rays::Segment& segment, const Rgb& unshadowed) {
        segments[count] = segment;
        received[count] = unshadowed;
        lanes[count++] = lane;
    }
    void trace(const rays::RayCaster& caster, TileLight& light) const {
        if (count == 0) return;
        std::array<Rgb, kPacketWidth> transmittances;
        caster.transmittances(std::span(segments).first(count), rays::Coherence::coherent,
                              std::span(transmittances).first(count));
        for (std::size_t i = 0; i < count; ++i) light[lanes[i]] += received[i] * transmittances[i];
    }
};

double DirectLight::Remainder::rays(std::size_t receivers) const {
    int of_lamps = 0;
    for (const std::uint32_t bits : lamps) of_lamps += std::popcount(bits);
    const double each = (by_directions ? 1 : 0) + (points ? double{kChosen} : 0);
    return of_lamps + each * static_cast<double>(receivers);
}

DirectLight::DirectLight(const Scene& scene, const rays::RayCaster& caster, const LightSampler& lights)
    : scene_(scene), caster_(caster), lights_(lights) {
    std::vector<LightTree::Light> leaves;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (const auto origin = lights::point_origin(light)) {
            points_.push_back(i);
            const double intensity_cd = flux_lm(scene, light).luminance() / (4 * kPi);
            leaves.push_back({static_cast<std::uint32_t>(i), {}, intensity_cd, true});
            leaves.back().bounds.include(origin->position);
        } else if (auto lamp = UniformLamp::of(scene, light, caster.lift())) {
            lamps_.push_back(std::move(*lamp));
        } else if (auto opening = OpeningLamp::of(scene, light, caster.lift())) {
            openings_.push_back(std::move(*opening));
        } else {
            others_.push_back(i);
        }
    }
    if (points_.size() > kFewPoints) tree_of_points_ = LightTree(std::move(leaves));
    chooses_lamps_ = lights.chooses_extended();
    if (chooses_lamps_) lamps_.clear(), openings_.clear();
    if (lamp_count() > 0) shafts_.emplace(scene, caster.center());
}

DirectLight::Prepared DirectLight::prepare(std::span<const Receiver> receivers,
                                           const Monitor& monitor) const {
    const std::size_t tiles = (receivers.size() + kPacketWidth - 1) / kPacketWidth;
    const bool exact_points = points_.size() <= kFewPoints || points_.size() * receivers.size() <= kMostExact;
    Prepared prepared{std::vector<Rgb>(receivers.size()), std::vector<Remainder>(tiles)};
    parallel_for(tiles, [&](std::size_t t) {
        monitor.require_more();
        const std::size_t first = t * kPacketWidth;
        const auto tile =
            receivers.subspan(first, std::min<std::size_t>(kPacketWidth, receivers.size() - first));
        TileLight light{};
        prepared.remainders[t] = add_known(tile, light);
        settle_one_by_one(tile, prepared.remainders[t], light);
        // The tree chooses for surfaces.
        prepared.remainders[t].points = !exact_points && std::ranges::none_of(tile, &Receiver::is_body);
        if (!prepared.remainders[t].points) add_points(tile, light);
        std::copy_n(light.begin(), tile.size(), prepared.known.begin() + static_cast<std::ptrdiff_t>(first));
    });
    return prepared;
}

auto DirectLight::add_certain(std::span<const Receiver> tile, TileLight& light) const -> Remainder {
    Remainder remainder = add_known(tile, light);
    remainder.points = points_.size() > kFewPoints;
    if (!remainder.points) add_points(tile, light);
    return remainder;
}

const LampHull& DirectLight::hull_of(std::size_t lamp) const {
    return lamp < lamps_.size() ? lamps_[lamp].hull() : openings_[lamp - lamps_.size()].hull();
}

/// Of all of the lamp, where that is known.
std::optional<Rgb> DirectLight::whole_lx(std::size_t lamp, const lights::LitPoint& at) const {
    if (lamp < lamps_.size()) return lamps_[lamp].illuminance_lx(at);
    return openings_[lamp - lamps_.size()].illuminance_lx(at);
}

std::optional<LampSample> DirectLight::sample_lamp(std::size_t lamp, const lights::LitPoint& at,
                                                   math::SampleStream& stream) const {
    if (lamp < lamps_.size()) return lamps_[lamp].sample(at, stream);
    return openings_[lamp - lamps_.size()].sample(at, stream);
}

/// Uniform lamps that are seen for certain; the others, unless they give no light, remain.
DirectLight::Remainder DirectLight::add_known(std::span<const Receiver> tile, TileLight& light) const {
    Remainder remainder;
    for (const Receiver& receiver : tile) {
        remainder.by_directions |=
            has_closed_form(receiver) ? !others_.empty() : lights_.has_visible_lights();
    }
    for (std::size_t l = 0; l < lamps_.size(); ++l) {
        std::array<Rgb, kPacketWidth> whole_lx{};
        std::array<Vec3, kPacketWidth> lit;
        std::size_t count = 0;
        for (std::size_t i = 0; i < tile.size(); ++i) {
            if (!has_closed_form(tile[i])) continue;
            whole_lx[i] = lamps_[l].illuminance_lx(lit_point(tile[i]));
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
            if (whole_lx[i].max() > 0) light[i] += whole_lx[i] * *tile[i].constant_response();
        }
    }
    for (std::size_t o = 0; o < openings_.size(); ++o) {
        for (std::size_t i = 0; i < tile.size(); ++i) {
            if (has_closed_form(tile[i]) && openings_[o].may_light(lit_point(tile[i])))
                remainder.lamps[i] |= 1u << (lamps_.size() + o);
        }
    }
    return remainder;
}

/// From one receiver the shaft to a lamp is narrower than from all of them, and one face may hide the lamp.
/// The light of openings that are seen for certain is integrated here.
void DirectLight::settle_one_by_one(std::span<const Receiver> tile, Remainder& remainder,
                                    TileLight& light) const {
    for (std::size_t i = 0; i < tile.size(); ++i) {
        for (std::size_t l = 0; l < lamp_count(); ++l) {
            const std::uint32_t bit = 1u << l;
            if ((remainder.lamps[i] & bit) == 0) continue;
            std::optional<Rgb> received_lx;
            if (hull_of(l).is_hidden_from(tile[i].lifted(), scene_, caster_))
                received_lx = Rgb{};
            else if (hull_of(l).is_seen_from(std::span(&tile[i].lifted(), 1), *shafts_))
                received_lx = whole_lx(l, lit_point(tile[i]));
            if (!received_lx) continue;
            remainder.lamps[i] &= ~bit;
            light[i] += *received_lx * *tile[i].constant_response();
        }
    }
}

void DirectLight::add_sample(std::span<const Receiver> tile, const Remainder& remainder,
                             std::span<math::SampleStream> streams, TileLight& light) const {
    if (remainder.has_lamps()) {
        for (std::size_t l = 0; l < lamp_count(); ++l) add_shadowed(tile, l, remainder, streams, light);
    }
    if (remainder.by_directions) add_by_directions(tile, streams, light);
    if (remainder.points) add_chosen_points(tile, streams[0], light);
}

void DirectLight::add_shadowed(std::span<const Receiver> tile, std::size_t lamp, const Remainder& remainder,
                               std::span<math::SampleStream> streams, TileLight& light) const {
    ShadowRays shadow_rays;
    for (std::size_t i = 0; i < tile.size(); ++i) {
        if ((remainder.lamps[i] >> lamp & 1u) == 0) continue;
        if (const auto sample = sample_lamp(lamp, lit_point(tile[i]), streams[i]))
            shadow_rays.add(i, {tile[i].lifted(), sample->lifted},
                            sample->illuminance_lx * *tile[i].constant_response());
    }
    shadow_rays.trace(caster_, light);
}

/// Lights that add_known() leaves out.
void DirectLight::add_by_directions(std::span<const Receiver> tile, std::span<math::SampleStream> streams,
                                    TileLight& light) const {
    for (std::size_t i = 0; i < tile.size(); ++i) {
        if (samples_all(tile[i])) light[i] += sample_direct_from_areas(tile[i], caster_, lights_, streams[i]);
    }
    if (chooses_lamps_) return;
    for (const std::size_t other : others_) {
        ShadowRays shadow_rays;
        for (std::size_t i = 0; i < tile.size(); ++i) {
            if (!samples_all(tile[i])) add_ray(tile, i, other, streams[i].next_two(), 1, shadow_rays);
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
    const auto incident = lights_.sample_incident(light, receiving_point(receiver), u);
    if (!incident) return;
    const double sensitivity = receiver.sensitivity(incident->direction);
    if (!(sensitivity > 0) || !(incident->normal_illuminance_lx.max() > 0)) return;
    shadow_rays.add(lane, {receiver.lifted(), incident->source_point},
                    factor * sensitivity * incident->normal_illuminance_lx *
                        receiver.response(incident->direction).value);
}

/// Neighbouring choices often are the same light.
void DirectLight::add_chosen_points(std::span<const Receiver> tile, math::SampleStream& stream,
                                    TileLight& light) const {
    const double first = stream.next();
    const TileChoice lights(tree_of_points_, lights_, tile, caster_.center());
    if (lights.is_empty()) return;
    std::size_t previous = ~std::size_t{0};
    double factor = 0;
    for (std::size_t i = 0; i < kChosen; ++i) {
        const auto choice = lights.choose((static_cast<double>(i) + first) / kChosen);
        if (choice.index != previous) {
            if (factor > 0) add_point(tile, previous, factor, light);
            previous = choice.index, factor = 0;
        }
        factor += 1 / (kChosen * choice.probability);
    }
    add_point(tile, previous, factor, light);
}

}  // namespace stilb::transport
