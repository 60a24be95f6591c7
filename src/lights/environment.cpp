#include "lights/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lights/luminaire.h"

namespace stilb::lights {
namespace {

Vec3 with_components(std::size_t first_axis, double first, double second, double third) {
    std::array<double, 3> v{};
    v[first_axis] = first, v[(first_axis + 1) % 3] = second, v[(first_axis + 2) % 3] = third;
    return {v[0], v[1], v[2]};
}

/// The scene's bounding box, enlarged so that rays can start from its faces, in which surfaces often lie.
Bounds enlarged(const Bounds& bounds) {
    constexpr double share = 1e-3, least_m = 1e-6;
    const double margin = std::max(share * bounds.half_extent(), least_m);
    const Vec3 room{margin, margin, margin};
    return {bounds.min - room, bounds.max + room};
}

std::vector<Entry> entries_into(const Surroundings& surroundings) {
    std::vector<Entry> entries{{enlarged(surroundings.bounds())}};
    for (const Entry& entry : surroundings.entries()) {
        entries.push_back(entry);
        entries.front().share -= entry.share;
    }
    return entries;
}

math::DiscreteDistribution choice_of(std::span<const Entry> entries) {
    std::vector<double> shares;
    for (const Entry& entry : entries) shares.push_back(entry.share);
    return math::DiscreteDistribution(shares);
}

/// The lengths along a line at which it enters and leaves a box; the first is larger where it misses it.
std::array<double, 2> lengths_within(const Bounds& box, const Vec3& point, const Vec3& direction) {
    std::array<double, 2> within{-Bounds::kInfinity, Bounds::kInfinity};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = box.min[axis] - point[axis], high = box.max[axis] - point[axis];
        const double along = direction[axis];
        if (along == 0) {
            if (low > 0 || high < 0) return {1, -1};
            continue;
        }
        within[0] = std::max(within[0], (along > 0 ? low : high) / along);
        within[1] = std::min(within[1], (along > 0 ? high : low) / along);
    }
    return within;
}

/// On a box's face across an axis, on its upper or lower side.
Vec3 on_face(const Bounds& box, std::size_t axis, bool is_upper, const std::array<double, 2>& u) {
    const std::size_t second = (axis + 1) % 3, third = (axis + 2) % 3;
    const auto between = [&](std::size_t along, double share) {
        return box.min[along] + share * (box.max[along] - box.min[along]);
    };
    return with_components(axis, (is_upper ? box.max : box.min)[axis], between(second, u[0]),
                           between(third, u[1]));
}

/// The areas of the faces across x, y and z.
std::array<double, 3> face_areas_m2(const Bounds& box) {
    const Vec3 e = box.max - box.min;
    return {e.y * e.z, e.z * e.x, e.x * e.y};
}

/// The projected areas of the box along a unit direction, face by face: one of each pair.
std::array<double, 3> projected_areas_m2(const Bounds& box, const Vec3& direction) {
    std::array<double, 3> areas = face_areas_m2(box);
    for (std::size_t axis = 0; axis < 3; ++axis) areas[axis] *= std::abs(direction[axis]);
    return areas;
}

double projected_area_m2(const Bounds& box, const Vec3& direction) {
    const auto areas = projected_areas_m2(box, direction);
    return areas[0] + areas[1] + areas[2];
}

Rgb flux_into(const Bounds& box, const EnvironmentLight& light) {
    if (!light.panorama) return kPi * box.surface_m2() * light.luminance_cd_m2;
    Rgb flux;
    for (const Panorama::Part& part : light.panorama->parts())
        flux += projected_area_m2(box, light.axes.to_world(part.direction)) * part.normal_illuminance_lx;
    return flux;
}

std::array<double, 6> rough_illuminances_lx(const EnvironmentLight& light) {
    std::array<double, 6> sums{};
    if (!light.panorama) {
        sums.fill(kPi * light.luminance_cd_m2.luminance());
        return sums;
    }
    for (const Panorama::Part& part : light.panorama->parts()) {
        const Vec3 direction = light.axes.to_world(part.direction);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double cosine = direction[axis];
            sums[2 * axis + (cosine < 0 ? 1 : 0)] +=
                std::abs(cosine) * part.normal_illuminance_lx.luminance();
        }
    }
    // Never 0: parts are larger than pixels, and some light may come from above the horizon wherever their
    // middles are.
    constexpr double least = 1e-3;
    const double mean_lx = light.panorama->total_lx().luminance() / 4;
    for (double& sum : sums) sum = std::max(sum, least * mean_lx);
    return sums;
}

}  // namespace

void EnvironmentLight::scale(const Rgb& by) {
    luminance_cd_m2 *= by;
    if (!panorama) return;
    if (!(by.max() > 0)) {  // a panorama is never black
        panorama.reset();
        luminance_cd_m2 = {};
        return;
    }
    Panorama::Image image = panorama->image();
    for (auto& rgb : image.rgb_cd_m2) {
        for (std::size_t b = 0; b < kBands; ++b) rgb[b] *= static_cast<float>(by[b]);
    }
    panorama = std::make_shared<const Panorama>(std::move(image));
}

Rgb EnvironmentLight::flux_lm(const Surroundings& surroundings) const {
    return flux_into(enlarged(surroundings.bounds()), *this);
}

std::vector<LightDetail> EnvironmentLight::details(const Surroundings&) const {
    const Vec3 up{0, 0, 1};
    if (!panorama) {
        return {{"luminance_cd_m2", luminance_cd_m2.luminance()},
                {"horizontal_illuminance_lx", kPi * luminance_cd_m2.luminance()}};
    }
    return {{"mean_luminance_cd_m2", panorama->total_lx().luminance() / (4 * kPi)},
            {"horizontal_illuminance_lx", panorama->illuminance_lx(axes.to_local(up)).luminance()},
            {"panorama", fmt::format("{} x {} pixels", panorama->width(), panorama->height())}};
}

Frame panorama_axes(const Vec3& unit_up, double rotation_deg) {
    // The shortest turn from a picture whose top is +z is that of a luminaire which hangs below it.
    const LuminaireFrame frame = aim_luminaire(-unit_up, rotation_deg);
    return {frame.c0, frame.c90, unit_up};
}

EnvironmentEmitter::EnvironmentEmitter(const EnvironmentLight& light, const Surroundings& surroundings,
                                       const Lift&)
    : light_(light),
      entries_(entries_into(surroundings)),
      choice_(choice_of(entries_)),
      flux_lm_(flux_into(entries_.front().box, light)),
      illuminance_lx_(rough_illuminances_lx(light)) {}

Emission EnvironmentEmitter::emit(math::SampleStream& stream) const {
    return light_.panorama ? emit_panorama(stream) : emit_constant(stream);
}

template <typename Area>
Emission EnvironmentEmitter::through(std::size_t entry, const Vec3& point, const Vec3& direction,
                                     const Rgb& share, const Area& area_m2) const {
    if (entries_.size() == 1) return {point, direction, share};
    const auto meets = [&](const Bounds& box) {
        const auto [enters, leaves] = lengths_within(box, point, direction);
        return enters <= leaves;
    };
    // The density of this line over the one that it has if all particles go through the scene's box.
    double density = 0;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const auto& [box, share_of_box] = entries_[i];
        if (i == 0 || i == entry || meets(box))
            density += share_of_box * area_m2(entries_.front().box) / area_m2(box);
    }
    // It starts outside of the scene.
    const double back_m =
        entry == 0 ? 0 : std::min(lengths_within(entries_.front().box, point, direction)[0], 0.0);
    return {point + back_m * direction, direction, share * (1 / density), density};
}

Emission EnvironmentEmitter::emit_constant(math::SampleStream& stream) const {
    const auto [u1, u2] = stream.next_two();
    const auto [v1, v2] = stream.next_two();
    const auto entry = choice_.choose(u1);
    const Bounds& box = entries_[entry.index].box;
    const auto areas = face_areas_m2(box);
    const std::array<double, 3> sums{areas[0], areas[0] + areas[1], areas[0] + areas[1] + areas[2]};
    const auto choice = math::choose_by_sums(sums, entry.remainder);
    const bool is_upper = choice.remainder < 0.5;
    const double rest = 2 * choice.remainder - (is_upper ? 0 : 1);
    const Vec3 inwards = with_components(choice.index, is_upper ? -1 : 1, 0, 0);
    return through(entry.index, on_face(box, choice.index, is_upper, {rest, u2}),
                   Frame::around(inwards).to_world(math::sample_cosine_hemisphere(v1, v2).direction),
                   Rgb::grey(1), [](const Bounds& of) { return of.surface_m2(); });
}

Emission EnvironmentEmitter::emit_panorama(math::SampleStream& stream) const {
    const auto [u1, u2] = stream.next_two();
    const auto [v1, v2] = stream.next_two();
    const Panorama::Sample sample = light_.panorama->sample(u1, u2);
    const Vec3 towards = light_.axes.to_world(sample.direction);
    const auto entry = choice_.choose(v1);
    const Bounds& box = entries_[entry.index].box;
    const auto areas = projected_areas_m2(box, towards);
    const std::array<double, 3> sums{areas[0], areas[0] + areas[1], areas[0] + areas[1] + areas[2]};
    const auto choice = math::choose_by_sums(sums, entry.remainder);
    const auto projected = [&](const Bounds& of) { return projected_area_m2(of, towards); };
    Rgb share = sample.luminance_cd_m2 * (projected(entries_.front().box) / sample.pdf_per_sr);
    for (std::size_t b = 0; b < kBands; ++b) share[b] = flux_lm_[b] > 0 ? share[b] / flux_lm_[b] : 0;
    return through(entry.index, on_face(box, choice.index, towards[choice.index] > 0, {choice.remainder, v2}),
                   -towards, share, projected);
}

IncidentLight EnvironmentEmitter::incident(const Vec3& from, const Vec3& direction, const Rgb& luminance,
                                           double pdf_per_sr) const {
    // All surfaces are in a sphere around the box; the segment ends beyond it.
    const Bounds& box = entries_.front().box;
    const Vec3 center = 0.5 * (box.min + box.max);
    const double radius_m = length(box.max - box.min) / 2;
    const double reach_m = std::max(dot(center - from, direction), 0.0) + 2 * radius_m;
    return {from + reach_m * direction, direction, luminance * (1 / pdf_per_sr), pdf_per_sr};
}

std::optional<IncidentLight> EnvironmentEmitter::sample_incident(const SurfacePoint& at,
                                                                 const std::array<double, 2>& u) const {
    if (light_.panorama) {
        const Panorama::Sample sample = light_.panorama->sample(u[0], u[1]);
        return incident(at.position, light_.axes.to_world(sample.direction), sample.luminance_cd_m2,
                        sample.pdf_per_sr);
    }
    const auto [local, pdf_per_sr] =
        at.is_in_open() ? math::sample_sphere(u[0], u[1]) : math::sample_cosine_hemisphere(u[0], u[1]);
    if (!(pdf_per_sr > 0)) return std::nullopt;
    const Vec3 direction = at.is_in_open() ? local : Frame::around(at.normal).to_world(local);
    return incident(at.position, direction, light_.luminance_cd_m2, pdf_per_sr);
}

double EnvironmentEmitter::rough_illuminance_lx(const SurfacePoint& at) const {
    // The squares add up to 1; exact where light comes from all sides alike.
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        sum += at.normal[axis] * at.normal[axis] * illuminance_lx_[2 * axis + (at.normal[axis] < 0 ? 1 : 0)];
    return sum;
}

Rgb EnvironmentEmitter::luminance_cd_m2(const Vec3& direction) const {
    return light_.panorama ? light_.panorama->luminance_cd_m2(light_.axes.to_local(direction))
                           : light_.luminance_cd_m2;
}

double EnvironmentEmitter::pdf_per_sr(const Vec3& direction, const SurfacePoint& at) const {
    if (light_.panorama) return light_.panorama->pdf_per_sr(light_.axes.to_local(direction));
    return at.is_in_open() ? 1 / (4 * kPi) : math::cosine_hemisphere_pdf_per_sr(dot(direction, at.normal));
}

}  // namespace stilb::lights
