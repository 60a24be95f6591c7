// Straight lines through panes, which let light pass without bending it.
#include <algorithm>

#include "rays/ray_caster.h"

namespace stilb::rays {
namespace {

bool is_pane(const Hit& hit, const Scene& scene) { return passes_straight(scene.material(hit.material)); }

/// The transmittance for light along `direction`.
Rgb transmittance_of_pane(const Hit& hit, const Vec3& direction, const Scene& scene) {
    return straight_transmittance(scene.material(hit.material), -dot(direction, hit.normal));
}

}  // namespace

Rgb RayCaster::transmittance(const Segment& segment) const {
    if (!occluded(segment.from, segment.to)) return Rgb::grey(1);
    return has_panes() ? transmittance_of_panes(segment) : Rgb{};
}

void RayCaster::transmittances(std::span<const Segment> segments, Coherence coherence,
                               std::span<Rgb> transmittances) const {
    for (std::size_t first = 0; first < segments.size(); first += kPacketWidth) {
        const std::size_t count = std::min<std::size_t>(kPacketWidth, segments.size() - first);
        RayPacket packet;
        LaneMask lanes{};
        for (std::size_t i = 0; i < count; ++i) {
            const Segment& segment = segments[first + i];
            packet.set(i, segment.from - center(), segment.to - segment.from, 1);
            lanes[i] = -1;
        }
        occlude(packet, lanes, coherence);
        for (std::size_t i = 0; i < count; ++i) {
            Rgb& left = transmittances[first + i] = Rgb::grey(packet.end[i] < 0 ? 0 : 1);
            if (packet.end[i] < 0 && has_panes()) {
                left = transmittance_of_panes(segments[first + i]);
            }
        }
    }
}

Rgb RayCaster::transmittance_of_panes(const Segment& segment) const {
    Rgb left = Rgb::grey(1);
    const Vec3 direction = normalized(segment.to - segment.from);
    Vec3 from = segment.from;
    while (occluded(from, segment.to)) {
        const auto hit = closest(from, direction);
        if (!hit || !is_pane(*hit, scene())) return {};
        left *= transmittance_of_pane(*hit, direction, scene());
        from = hit->lifted_behind();
    }
    return left;
}

RayCaster::FirstHit RayCaster::seen(const Ray& ray) const {
    FirstHit seen;
    Vec3 origin = ray.origin;
    for (;;) {
        const auto hit = closest(origin, ray.direction);
        if (!hit || !is_pane(*hit, scene())) {
            seen.hit = hit;
            return seen;
        }
        seen.transmittance *= transmittance_of_pane(*hit, ray.direction, scene());
        origin = hit->lifted_behind();
    }
}

}  // namespace stilb::rays
