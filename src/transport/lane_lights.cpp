#include "transport/lane_lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace stilb::transport {
namespace {

using lights::LanePoint;
using lights::LaneRectangle;
using Floats = RayPacket::Floats;

LanePoint lane_point(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Nothing for other shapes.
std::optional<LaneRectangle> lane_rectangle(const Shape& shape, const Vec3& center) {
    constexpr double right_angle = 1e-6;
    const auto* rectangle = std::get_if<Rectangle>(&shape);
    if (rectangle == nullptr) return std::nullopt;
    const double width = length(rectangle->edge_u), depth = length(rectangle->edge_v);
    if (std::abs(dot(rectangle->edge_u, rectangle->edge_v)) > right_angle * width * depth)
        return std::nullopt;
    const Vec3 u = rectangle->edge_u / width, v = rectangle->edge_v / depth;
    return LaneRectangle{lane_point(rectangle->corner - center),
                         lane_point(u),
                         lane_point(v),
                         lane_point(cross(u, v)),
                         static_cast<float>(width),
                         static_cast<float>(depth)};
}

std::array<float, kBands> lane_rgb(const Rgb& rgb) {
    return {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
}

}  // namespace

struct alignas(64) LaneLights::Chosen {
    rays::LaneVectors corner, u, v, normal;
    Floats width, depth;
    std::array<Floats, kBands> emission;
    LaneMask is_point;
    Floats probability;
    RayPacket::Words number;

    void set(std::size_t lane, const Light& light, std::uint32_t own_number) {
        number[lane] = own_number;
        const auto copy = [lane](rays::LaneVectors& to, const LanePoint& from) {
            to.x[lane] = from.x, to.y[lane] = from.y, to.z[lane] = from.z;
        };
        const LaneRectangle& rectangle = light.rectangle;
        copy(corner, rectangle.corner), copy(u, rectangle.u), copy(v, rectangle.v);
        copy(normal, rectangle.normal);
        width[lane] = rectangle.width, depth[lane] = rectangle.depth;
        for (std::size_t b = 0; b < kBands; ++b) emission[b][lane] = light.emission[b];
        is_point[lane] = light.is_point ? -1 : 0;
    }
};

std::optional<LaneLights> LaneLights::of(const Scene& scene, const Lift& lift, const LightSampler& lights) {
    if (scene.lights.empty() || scene.lights.size() > kMost) return std::nullopt;
    const Vec3& center = lift.center();
    LaneLights all;
    all.least_size_m_ = static_cast<float>(lift.least_size_m());
    for (const stilb::Light& light : scene.lights) {
        Light lane{};
        lane.flux_lm = static_cast<float>(lights.choice_favour(all.lights_.size()) *
                                          scene::flux_lm(scene, light).luminance());
        const auto origin = lights::point_origin(light);
        if (origin && origin->intensity_cd) {
            lane.rectangle.corner = lane_point(origin->position - center);
            lane.emission = lane_rgb(*origin->intensity_cd);
            lane.is_point = true;
        } else if (const auto surface = lights::uniform_emission(light)) {
            const auto rectangle = lane_rectangle(scene.object(surface->object).shape, center);
            if (!rectangle) return std::nullopt;
            lane.rectangle = *rectangle;
            lane.emission = lane_rgb(surface->luminance_cd_m2);
            lane.squared_radius_m2 =
                (rectangle->width * rectangle->width + rectangle->depth * rectangle->depth) / 4;
        } else {
            return std::nullopt;
        }
        all.lights_.push_back(lane);
    }
    if (all.lights_.size() == 1) {
        Chosen only;
        for (std::size_t i = 0; i < kPacketWidth; ++i) only.set(i, all.lights_[0], 0);
        only.probability.fill(1);
        all.only_ = std::make_shared<const Chosen>(only);
    }
    return all;
}

/// The approximate unshadowed illuminance, in any unit; 0 only where it is exactly 0.
STILB_INLINED float LaneLights::rough_lx(const Light& light, const LanePoint& from, const LanePoint& normal) {
    const LaneRectangle& rectangle = light.rectangle;
    const LanePoint to_corner = rectangle.corner - from;
    const LanePoint to_middle =
        to_corner + (rectangle.width / 2) * rectangle.u + (rectangle.depth / 2) * rectangle.v;
    const float squared = dot(to_middle, to_middle);
    const float above = dot(to_middle, normal) / (4 * std::sqrt(squared));
    const float side = light.is_point ? above : rectangle.height(to_corner);
    const float factor = light.is_point ? above : 1;
    const float rough = light.flux_lm * factor / (squared + light.squared_radius_m2);
    return side > 0 ? rough : 0;
}

STILB_VECTORIZED void LaneLights::add_rough(const Light& __restrict light,
                                            const rays::SurfacePacket& __restrict at,
                                            Floats& __restrict rough, Floats& __restrict sum) {
    const Light own = light;
    for (int i = 0; i < kPacketWidth; ++i) {
        rough[i] = rough_lx(own, {at.position.x[i], at.position.y[i], at.position.z[i]},
                            {at.normal.x[i], at.normal.y[i], at.normal.z[i]});
        sum[i] += rough[i];
    }
}

void LaneLights::choose(const rays::SurfacePacket& at, const math::NumberPacket& numbers,
                        Chosen& chosen) const {
    std::array<Floats, kMost> rough;
    Floats total{};
    for (std::size_t light = 0; light < lights_.size(); ++light)
        add_rough(lights_[light], at, rough[light], total);
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        float left = math::lane_unit_interval(numbers.hashed(i, kChoiceOfLight)) * total[i];
        std::size_t light = 0;
        while (light + 1 < lights_.size() && left >= rough[light][i]) left -= rough[light++][i];
        chosen.set(i, lights_[light], static_cast<std::uint32_t>(light));
        chosen.probability[i] = total[i] > 0 ? rough[light][i] / total[i] : 0;
    }
}

STILB_VECTORIZED void LaneLights::sample_chosen(const Chosen& __restrict chosen,
                                                const rays::SurfacePacket& __restrict at,
                                                const math::NumberPacket& __restrict numbers,
                                                LightPacket& __restrict light) const {
    const float least_size_m = least_size_m_;
    light.light = chosen.number;
    for (int i = 0; i < kPacketWidth; ++i) {
        const LaneRectangle rectangle{{chosen.corner.x[i], chosen.corner.y[i], chosen.corner.z[i]},
                                      {chosen.u.x[i], chosen.u.y[i], chosen.u.z[i]},
                                      {chosen.v.x[i], chosen.v.y[i], chosen.v.z[i]},
                                      {chosen.normal.x[i], chosen.normal.y[i], chosen.normal.z[i]},
                                      chosen.width[i],
                                      chosen.depth[i]};
        const LanePoint from{at.position.x[i], at.position.y[i], at.position.z[i]};
        const auto [x, y, pdf_per_sr] = rectangle.sample(from, math::lane_unit_interval(numbers.words[0][i]),
                                                         math::lane_unit_interval(numbers.words[1][i]));
        // A point has no size: x = y = 0.
        const LanePoint on_light = x * rectangle.u + y * rectangle.v;
        const LanePoint offset = (rectangle.corner - from) + on_light, point = rectangle.corner + on_light;
        const bool is_point = chosen.is_point[i] != 0;
        const float squared = dot(offset, offset), distance = std::sqrt(squared);
        const float density = chosen.probability[i] * (is_point ? squared : pdf_per_sr);
        const float inverse_density = 1 / density;
        const float inverse = density > 0 ? inverse_density : 0;
        // As Lift::offset_m.
        const float of_ray = static_cast<float>(Lift::kShareOfRay) * distance;
        const float size =
            std::max(std::max(rectangle.width, rectangle.depth), std::max(least_size_m, of_ray));
        const float farthest = std::max(std::max(std::abs(point.x), std::abs(point.y)), std::abs(point.z));
        const float lift_m = is_point ? 0 : static_cast<float>(Lift::kShare) * std::max(farthest, size);
        light.source.x[i] = point.x + lift_m * rectangle.normal.x;
        light.source.y[i] = point.y + lift_m * rectangle.normal.y;
        light.source.z[i] = point.z + lift_m * rectangle.normal.z;
        const float per_distance = 1 / std::max(distance, std::numeric_limits<float>::min());
        light.direction.x[i] = per_distance * offset.x;
        light.direction.y[i] = per_distance * offset.y;
        light.direction.z[i] = per_distance * offset.z;
        light.normal_illuminance_lx[0][i] = inverse * chosen.emission[0][i];
        light.normal_illuminance_lx[1][i] = inverse * chosen.emission[1][i];
        light.normal_illuminance_lx[2][i] = inverse * chosen.emission[2][i];
        light.inverse_pdf_sr[i] = is_point ? 0 : inverse;
    }
}

void LaneLights::sample(const rays::SurfacePacket& at, const math::NumberPacket& numbers,
                        LightPacket& light) const {
    if (only_) return sample_chosen(*only_, at, numbers, light);
    Chosen chosen;
    choose(at, numbers, chosen);
    sample_chosen(chosen, at, numbers, light);
}

float LaneLights::pdf_per_sr(std::size_t light, const Vec3& position, const Vec3& from,
                             const Vec3& normal) const {
    const LanePoint at = lane_point(from);
    const Light& own = lights_[light];
    const float pdf = own.rectangle.pdf_per_sr(at, lane_point(position));
    if (only_) return pdf;
    float total = 0;
    for (const Light& other : lights_) total += rough_lx(other, at, lane_point(normal));
    return total > 0 ? pdf * rough_lx(own, at, lane_point(normal)) / total : 0;
}

PacketLights::PacketLights(const Scene& scene, const rays::RayCaster& caster, const LightSampler& lights)
    : caster_(caster), lights_(lights) {
    if (!lights.leaves_out_lights()) lane_lights_ = LaneLights::of(scene, caster.lift(), lights);
}

math::NumberPacket PacketLights::sample(const rays::SurfacePacket& at, const LaneMask& lanes,
                                        math::StreamPacket& streams, unsigned sobol_dimensions,
                                        LightPacket& light) const {
    if (!lane_lights_) {
        sample_one_by_one(at, lanes, streams, sobol_dimensions, light);
        skip_four(streams);
    }
    const math::NumberPacket numbers = next_four(streams, sobol_dimensions);
    if (lane_lights_) lane_lights_->sample(at, numbers, light);
    return numbers;
}

void PacketLights::sample_one_by_one(const rays::SurfacePacket& at, const LaneMask& lanes,
                                     const math::StreamPacket& streams, unsigned sobol_dimensions,
                                     LightPacket& light) const {
    const Vec3& center = caster_.center();
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        for (RayPacket::Floats& band : light.normal_illuminance_lx) band[i] = 0;
        if (lanes[i] == 0) continue;
        math::SampleStream stream = streams.stream(i, sobol_dimensions);
        const auto incident = lights_.sample_one_light({at.position.at(i) + center, at.normal.at(i)}, stream);
        if (!incident) continue;
        light.source.set(i, incident->source_point - center);
        light.direction.set(i, incident->direction);
        for (std::size_t b = 0; b < kBands; ++b)
            light.normal_illuminance_lx[b][i] = static_cast<float>(incident->normal_illuminance_lx[b]);
        light.inverse_pdf_sr[i] = static_cast<float>(1 / incident->pdf_per_sr);
        light.light[i] = incident->light;
    }
}

double PacketLights::pdf_per_sr(std::size_t light, const rays::Hit& hit, const SurfacePoint& at) const {
    if (!lane_lights_) return lights_.pdf_per_sr(light, hit, at);
    const Vec3& center = caster_.center();
    return double{lane_lights_->pdf_per_sr(light, hit.position - center, at.position - center, at.normal)};
}

}  // namespace stilb::transport
