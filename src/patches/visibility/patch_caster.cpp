#include "patches/visibility/patch_caster.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "rays/embree_geometry.h"

namespace stilb::patches {
namespace {

static_assert(sizeof(RayPacket) == sizeof(RTCRay16));
static_assert(offsetof(RayPacket, end) == offsetof(RTCRay16, tfar));

void throw_error(void*, RTCError, const char* message) {
    throw std::runtime_error(fmt::format("Embree: {}", message));
}

bool count_bytes(void* sum, ssize_t bytes, bool) {
    static_cast<std::atomic<std::int64_t>*>(sum)->fetch_add(bytes);
    return true;
}

std::uint32_t side_met(const Patches& patches, std::uint32_t front, float direction_along_normal) {
    return direction_along_normal < 0 ? front : patches.other_side(front);
}

/// The rays of the lanes. Where the processor has no packets of sixteen, Embree 3.13 traces all rays,
/// whatever the mask of lanes says, but for those that end before they start.
RTCRayHit16 unanswered(const RayPacket& packet, const LaneMask& lanes) {
    RTCRayHit16 rays;
    std::memcpy(&rays.ray, &packet, sizeof packet);
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (lanes[i] == 0) rays.ray.tfar[i] = -std::numeric_limits<float>::infinity();
    }
    std::ranges::fill(rays.hit.geomID, RTC_INVALID_GEOMETRY_ID);
    return rays;
}

struct CollectingContext : RTCIntersectContext {
    const Patches& patches;
    PacketCrossings& crossings;
};

/// Records the crossings and continues the rays.
void collect(const RTCFilterFunctionNArguments* args) {
    const auto& context = *static_cast<const CollectingContext*>(args->context);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        args->valid[i] = 0;
        const float along_normal =
            RTCRayN_dir_x(args->ray, args->N, i) * RTCHitN_Ng_x(args->hit, args->N, i) +
            RTCRayN_dir_y(args->ray, args->N, i) * RTCHitN_Ng_y(args->hit, args->N, i) +
            RTCRayN_dir_z(args->ray, args->N, i) * RTCHitN_Ng_z(args->hit, args->N, i);
        const std::uint32_t front = RTCHitN_primID(args->hit, args->N, i);
        context.crossings[RTCRayN_id(args->ray, args->N, i)].push_back(
            {RTCRayN_tfar(args->ray, args->N, i), side_met(context.patches, front, along_normal)});
    }
}

}  // namespace

struct PatchCaster::Implementation {
    const Patches& patches;
    std::atomic<std::int64_t> bytes = 0;
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<std::unique_ptr<rays::EmbreeGeometry>> exact_surfaces;

    /// `exact`: the scene of the patches where exact surfaces replace theirs; else null.
    Implementation(const Patches& all, const Scene* exact) : patches(all) {
        device = rtcNewDevice(nullptr);
        if (device == nullptr) throw std::runtime_error("Embree: no device could be created");
        rtcSetDeviceErrorFunction(device, throw_error, nullptr);
        rtcSetDeviceMemoryMonitorFunction(device, count_bytes, &bytes);
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
        if (patches.count() > 0) add_patches(exact);
        if (exact != nullptr) {
            for (const Object& object : exact->objects) add_exact(object.shape);
        }
        rays::commit(scene);
    }

    ~Implementation() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }

    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;

    /// Geometry 0, whose primitives are the patches.
    void add_patches(const Scene* exact) const {
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                 sizeof(Float3), patches.vertices.size());
        std::ranges::copy(patches.vertices, static_cast<Float3*>(vertices));
        auto* corners = static_cast<Triangle*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), patches.count()));
        std::ranges::copy(patches.corners, corners);
        for (std::size_t object = 0; exact != nullptr && object < exact->objects.size(); ++object) {
            if (!geometry::is_exact(exact->objects[object].shape)) continue;
            // No ray meets a triangle without area.
            std::fill(corners + patches.first_of_object[object],
                      corners + patches.first_of_object[object + 1], Triangle{});
        }
        attach(geometry);
    }

    void add_exact(const Shape& shape) {
        if (!geometry::is_exact(shape)) return;
        exact_surfaces.push_back(std::make_unique<rays::EmbreeGeometry>());
        attach(rays::new_geometry(device, shape, patches.center, *exact_surfaces.back()));
    }

    void attach(RTCGeometry geometry) const {
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
    }
};

PatchCaster::PatchCaster(const Patches& patches)
    : implementation_(std::make_unique<Implementation>(patches, nullptr)) {}
PatchCaster::PatchCaster(const Patches& patches, const Scene& scene)
    : implementation_(std::make_unique<Implementation>(patches, &scene)) {}
PatchCaster::~PatchCaster() = default;

const Patches& PatchCaster::patches() const { return implementation_->patches; }
std::size_t PatchCaster::bytes() const { return static_cast<std::size_t>(implementation_->bytes.load()); }

PatchHits PatchCaster::closest(RayPacket& packet, const LaneMask& lanes, rays::Coherence coherence) const {
    RTCRayHit16 found = unanswered(packet, lanes);
    RTCIntersectContext context = context_for(coherence);
    rtcIntersect16(lanes.data(), implementation_->scene, &context, &found);
    PatchHits hits;
    std::ranges::copy(found.hit.u, hits.b1.begin());
    std::ranges::copy(found.hit.v, hits.b2.begin());
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (lanes[i] != 0) packet.end[i] = found.ray.tfar[i];
        const float along_normal = packet.direction_x[i] * found.hit.Ng_x[i] +
                                   packet.direction_y[i] * found.hit.Ng_y[i] +
                                   packet.direction_z[i] * found.hit.Ng_z[i];
        const bool is_met = lanes[i] != 0 && found.hit.geomID[i] == 0;
        if (lanes[i] != 0 && !is_met && found.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
            hits.exact_lanes |= 1u << i;
        hits.sides[i] =
            is_met ? side_met(implementation_->patches, found.hit.primID[i], along_normal) : kNoSide;
    }
    return hits;
}

void PatchCaster::all(const RayPacket& packet, const LaneMask& lanes, PacketCrossings& crossings) const {
    for (auto& of_lane : crossings) of_lane.clear();
    RTCRayHit16 rays = unanswered(packet, lanes);
    std::iota(std::begin(rays.ray.id), std::end(rays.ray.id), 0u);
    CollectingContext context{context_for(rays::Coherence::coherent), implementation_->patches, crossings};
    context.filter = collect;
    rtcIntersect16(lanes.data(), implementation_->scene, &context, &rays);
    for (auto& of_lane : crossings) std::ranges::sort(of_lane, std::less<>{});
}

}  // namespace stilb::patches
