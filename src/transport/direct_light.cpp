#include "transport/direct_light.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "transport/tile_choice.h"

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
        } else {
            others_.push_back(i);
        }
    }
    if (points_.size() > kFewPoints) tree_of_points_ = LightTree(std::move(leaves));
    chooses_lamps_ = lights.chooses_extended();
    if (chooses_lamps_) lamps_.clear();
    if (!lamps_.empty()) shafts_.emplace(scene, caster.center());
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

/// Lamps that are seen for certain; the others, unless they give no light, remain.
DirectLight::Remainder DirectLight::add_known(std::span<const Receiver> tile, TileLight& light) const {
    Remainder remainder;
    for (const Receiver& receiver : tile) {
        remainder.by_directions |=
            has_closed_form(receiver) ? !others_.empty() : lights_.has_visible_lights();
    }
    for (std::size_t l = 0; l < lamps_.size(); ++l) {
        std::array<double, kPacketWidth> projected_sr{};
        std::array<Vec3, kPacketWidth> lit;
        std::size_t count = 0;
        for (std::size_t i = 0; i < tile.size(); ++i) {
            if (!has_closed_form(tile[i])) continue;
            projected_sr[i] = lamps_[l].projected_solid_angle_sr(lit_point(tile[i]));
            if (projected_sr[i] > 0) lit[count++] = tile[i].lifted();
        }
        if (count == 0) continue;
        if (!lamps_[l].is_seen_from(std::span(lit).first(count), *shafts_)) {
            for (std::size_t i = 0; i < tile.size(); ++i) {
                if (projected_sr[i] > 0) remainder.lamps[i] |= 1u << l;
            }
            continue;
        }
        for (std::size_t i = 0; i < tile.size(); ++i) {
            if (projected_sr[i] > 0)
                light[i] += projected_sr[i] * lamps_[l].luminance_cd_m2() * *tile[i].constant_response();
        }
    }
    return remainder;
}

/// From one receiver the shaft to a lamp is narrower than from all of them, and one face may hide the lamp.
void DirectLight::settle_one_by_one(std::span<const Receiver> tile, Remainder& remainder,
                                    TileLight& light) const {
    for (std::size_t i = 0; i < tile.size(); ++i) {
        for (std::size_t l = 0; l < lamps_.size(); ++l) {
            const std::uint32_t bit = 1u << l;
            if ((remainder.lamps[i] & bit) == 0) continue;
            const bool is_hidden = lamps_[l].is_hidden_from(tile[i].lifted(), scene_, caster_);
            if (!is_hidden && !lamps_[l].is_seen_from(std::span(&tile[i].lifted(), 1), *shafts_)) continue;
            remainder.lamps[i] &= ~bit;
            if (is_hidden) continue;
            light[i] += lamps_[l].projected_solid_angle_sr(lit_point(tile[i])) * lamps_[l].luminance_cd_m2() *
                        *tile[i].constant_response();
        }
    }
}

void DirectLight::add_sample(std::span<const Receiver> tile, const Remainder& remainder,
                             std::span<math::SampleStream> streams, TileLight& light) const {
    if (remainder.has_lamps()) {
        for (std::size_t l = 0; l < lamps_.size(); ++l) add_shadowed(tile, l, remainder, streams, light);
    }
    if (remainder.by_directions) add_by_directions(tile, streams, light);
    if (remainder.points) add_chosen_points(tile, streams[0], light);
}

void DirectLight::add_shadowed(std::span<const Receiver> tile, std::size_t lamp, const Remainder& remainder,
                               std::span<math::SampleStream> streams, TileLight& light) const {
    const Rgb& luminance_cd_m2 = lamps_[lamp].luminance_cd_m2();
    ShadowRays shadow_rays;
    for (std::size_t i = 0; i < tile.size(); ++i) {
        if ((remainder.lamps[i] >> lamp & 1u) == 0) continue;
        const auto sample = lamps_[lamp].sample(lit_point(tile[i]), streams[i]);
        if (!sample) continue;
        shadow_rays.add(i, {tile[i].lifted(), sample->lifted},
                        sample->projected_solid_angle_sr * luminance_cd_m2 * *tile[i].constant_response());
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
