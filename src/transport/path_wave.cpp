#include "transport/path_wave.h"

#include <algorithm>
#include <limits>

namespace stilb::transport {
namespace {

Rgb rgb_at(const Bands& bands, std::size_t lane) {
    return {{bands[0][lane], bands[1][lane], bands[2][lane]}};
}

void set_rgb(Bands& bands, std::size_t lane, const Rgb& rgb) {
    for (std::size_t b = 0; b < kBands; ++b) bands[b][lane] = static_cast<float>(rgb[b]);
}

bool any(const LaneMask& lanes) {
    std::int32_t set = 0;
    for (const std::int32_t lane : lanes) set |= lane;
    return set != 0;
}

bool all(const LaneMask& lanes) {
    std::int32_t set = -1;
    for (const std::int32_t lane : lanes) set &= lane;
    return set != 0;
}

}  // namespace

LaneMask PathWave::lanes_of(std::size_t p) const {
    LaneMask lanes;
    for (std::size_t i = 0; i < kPacketWidth; ++i) lanes[i] = p * kPacketWidth + i < count_ ? -1 : 0;
    return lanes;
}

void PathWave::trace_from_rays(std::span<PathPacket> packets, std::span<const LaneMask> lanes,
                               rays::Coherence coherence) {
    packets_ = packets;
    count_ = packets.size() * kPacketWidth;
    remove_ended(lanes);
    arrive(coherence);
    follow(coherence);
}

void PathWave::trace_from_hits(std::span<const Path> paths, rays::Coherence coherence) {
    count_ = paths.size();
    if (paths[0].parts) asked_ = paths;
    std::vector<PathPacket> packets(packets_in_use());
    packets_ = packets;
    for (std::size_t n = 0; n < paths.size(); ++n) {
        const Path& path = paths[n];
        PathPacket& packet = packet_of(n);
        const std::size_t lane = n % kPacketWidth;
        packet.number[lane] = static_cast<std::uint32_t>(n);
        set_state(packet, lane, path);
        packet.surface.set(lane, path.hit, tracer_.caster_.center());
        packet.general[lane] = PathPacket::kPlain;
        if (!tracer_.is_plain(packet.surface, lane)) make_general(packet, lane, path);
    }
    follow(coherence);
}

void PathWave::follow(rays::Coherence coherence) {
    for (; count_ > 0; coherence = rays::Coherence::scattered) {
        tracer_.add_stored_reflection(general_, coherence);
        going_.clear();
        for (std::size_t p = 0; p < packets_in_use(); ++p) {
            LaneMask& lanes = going_.emplace_back(lanes_of(p));
            reflect(packets_[p], lanes, coherence);
        }
        general_.clear();
        remove_ended(going_);
        arrive(rays::Coherence::scattered);
    }
}

void PathWave::reflect(PathPacket& paths, LaneMask& lanes, rays::Coherence coherence) {
    LaneMask plain;
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        plain[i] = paths.general[i] == PathPacket::kPlain ? lanes[i] : 0;
    }
    ConnectionPacket connections{};  // Embree computes with unused lanes, too
    LaneMask going = plain;
    if (any(plain)) reflect_plain(paths, going, connections);
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (lanes[i] != plain[i]) reflect_generally(paths, i, going, connections);
    }
    connect(paths, connections, coherence);
    lanes = going;
}

void PathWave::reflect_plain(PathPacket& paths, LaneMask& lanes, ConnectionPacket& connections) const {
    Bands reflectance;
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (lanes[i] == 0) continue;
        const std::array<float, kBands>& of_material =
            tracer_.plain_materials_[paths.surface.material[i]].reflectance;
        for (std::size_t b = 0; b < kBands; ++b) reflectance[b][i] = of_material[b];
        if (paths.reflections_left[i]-- == 0) lanes[i] = 0;
    }
    LightPacket light{};
    const math::NumberPacket numbers =
        tracer_.packet_lights_.sample(paths.surface, lanes, paths.streams, sobol_dimensions_, light);
    connect_diffuse(paths, reflectance, light, lanes, connections);
    connections.light = light.light;
    reflect_diffuse(numbers, reflectance, lanes, paths);
    paths.previous_in_packet.fill(1);
}

void PathWave::reflect_generally(PathPacket& paths, std::size_t lane, LaneMask& lanes,
                                 ConnectionPacket& connections) {
    const Vec3& center = tracer_.caster_.center();
    Path& path = general_[paths.general[lane]];
    const PathTracer::Step step = tracer_.take_step(path);
    luminances_cd_m2_[paths.number[lane]] += path.luminance_cd_m2;
    paths.reflections_left[lane] = static_cast<std::uint32_t>(path.reflections_left);
    if (step.connection) {
        const auto& [from, to] = step.connection->segment;
        connections.segments.set(lane, from - center, to - from, 1);
        connections.lanes[lane] = -1;
        set_rgb(connections.luminance_cd_m2, lane, step.connection->luminance_cd_m2);
        connections.light[lane] = step.connection->light;
    }
    lanes[lane] = step.ray ? -1 : 0;
    if (!step.ray) return;
    set_state(paths, lane, path);
    paths.set_ray(lane, step.ray->origin - center, step.ray->direction);
}

void PathWave::connect(const PathPacket& paths, ConnectionPacket& connections, rays::Coherence coherence) {
    if (!any(connections.lanes)) return;
    const rays::RayCaster& caster = tracer_.caster_;
    RayPacket& segments = connections.segments;
    caster.occlude(segments, connections.lanes, coherence);
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (connections.lanes[i] == 0) continue;
        Rgb luminance = rgb_at(connections.luminance_cd_m2, i);
        if (segments.end[i] < 0) {
            if (!caster.has_panes()) continue;
            const Vec3 from =
                Vec3{segments.origin_x[i], segments.origin_y[i], segments.origin_z[i]} + caster.center();
            const Vec3 offset{segments.direction_x[i], segments.direction_y[i], segments.direction_z[i]};
            luminance *= caster.transmittance({from, from + offset});
        }
        add(paths, i, luminance, connections.light[i]);
    }
}

void PathWave::arrive(rays::Coherence coherence) {
    going_.clear();
    for (std::size_t p = 0; p < packets_in_use(); ++p) {
        arrive(packets_[p], going_.emplace_back(lanes_of(p)), coherence);
    }
    remove_ended(going_);
}

void PathWave::arrive(PathPacket& paths, LaneMask& lanes, rays::Coherence coherence) {
    RayPacket& ray = hits_.ray;
    ray.origin_x = paths.origin.x, ray.origin_y = paths.origin.y, ray.origin_z = paths.origin.z;
    ray.direction_x = paths.direction.x, ray.direction_y = paths.direction.y;
    ray.direction_z = paths.direction.z;
    ray.end.fill(std::numeric_limits<float>::infinity());
    tracer_.caster_.closest(hits_, lanes, coherence);
    tracer_.caster_.surfaces(hits_, paths.surface);
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (lanes[i] == 0) continue;
        const auto add_arriving = [&](const Rgb& arriving_cd_m2, std::size_t light) {
            add(paths, i, rgb_at(paths.throughput, i) * arriving_cd_m2, light);
        };
        if (hits_.object[i] == rays::kNothing) {
            const Vec3 direction = normalized(paths.direction.at(i));
            tracer_.visit_outside_light_towards(previous_vertex(paths, i), direction, add_arriving);
            lanes[i] = 0;
            continue;
        }
        const bool emits = tracer_.may_emit_[hits_.object[i]], is_plain = tracer_.is_plain(paths.surface, i);
        paths.general[i] = PathPacket::kPlain;
        if (is_plain && !emits) continue;
        const rays::Hit hit = tracer_.caster_.hit(hits_, i);
        if (emits)
            tracer_.for_each_emission_towards(previous_vertex(paths, i), hit, -paths.direction.at(i),
                                              add_arriving);
        if (!is_plain) make_general(paths, i, hit);
    }
}

void PathWave::add(const PathPacket& paths, std::size_t lane, const Rgb& luminance_cd_m2, std::size_t light) {
    const std::uint32_t number = paths.number[lane];
    luminances_cd_m2_[number] += luminance_cd_m2;
    if (asked_.empty()) return;
    const int reflections = asked_[number].reflections_left - static_cast<int>(paths.reflections_left[lane]);
    asked_[number].parts->push_back({luminance_cd_m2, static_cast<std::uint32_t>(light), reflections});
}

PreviousVertex PathWave::previous_vertex(const PathPacket& paths, std::size_t lane) const {
    return {paths.previous_pdf_per_sr[lane],
            {paths.previous_position.at(lane) + tracer_.caster_.center(), paths.previous_normal.at(lane)},
            paths.previous_in_packet[lane] != 0};
}

void PathWave::set_state(PathPacket& paths, std::size_t lane, const Path& path) const {
    paths.streams.set(lane, path.stream);
    paths.reflections_left[lane] = static_cast<std::uint32_t>(path.reflections_left);
    set_rgb(paths.throughput, lane, path.throughput);
    const PreviousVertex& previous = path.previous_vertex;
    paths.previous_pdf_per_sr[lane] = static_cast<float>(previous.pdf_per_sr);
    paths.previous_position.set(lane, previous.point.position - tracer_.caster_.center());
    paths.previous_normal.set(lane, previous.point.normal);
    paths.previous_in_packet[lane] = previous.in_packet ? 1 : 0;
}

void PathWave::make_general(PathPacket& paths, std::size_t lane, const rays::Hit& hit) {
    Path path{hit, -normalized(paths.direction.at(lane)), paths.streams.stream(lane, sobol_dimensions_),
              static_cast<int>(paths.reflections_left[lane])};
    path.throughput = rgb_at(paths.throughput, lane);
    path.previous_vertex = previous_vertex(paths, lane);
    make_general(paths, lane, path);
}

void PathWave::make_general(PathPacket& paths, std::size_t lane, const Path& path) {
    paths.general[lane] = static_cast<std::uint32_t>(general_.size());
    general_.push_back(path);
}

void PathWave::remove_ended(std::span<const LaneMask> going) {
    const auto goes_on = [&](std::size_t n) { return going[n / kPacketWidth][n % kPacketWidth] != 0; };
    for (std::size_t first = 0; first < count_; first += kPacketWidth) {
        if (all(going[first / kPacketWidth])) continue;
        for (std::size_t n = first; n < std::min(first + kPacketWidth, count_); ++n) {
            if (goes_on(n)) continue;
            do --count_;
            while (count_ > n && !goes_on(count_));
            if (count_ > n)
                packet_of(n).copy_lane(n % kPacketWidth, packet_of(count_), count_ % kPacketWidth);
        }
    }
}

}  // namespace stilb::transport
