// The estimator's inner loop (Connections::collect) against its bound: a bare rtcOccluded16 loop over the
// same rays, which are ready in memory and of which nothing is made. One thread.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "estimators/local/connection.h"
#include "rooms.h"

namespace stilb {
namespace {

double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The scene as Embree has it in RayCaster, built here once more so that the loop sees nothing of Stilb.
RTCScene bare_scene(RTCDevice device, const Scene& scene, const Vec3& center) {
    const RTCScene result = rtcNewScene(device);
    rtcSetSceneFlags(result, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(result, RTC_BUILD_QUALITY_HIGH);
    for (const Object& object : scene.objects) {
        const auto* box = std::get_if<Box>(&object.shape);
        const Mesh mesh = box != nullptr ? triangulated(*box) : std::get<Mesh>(object.shape);
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
        for (const Vec3& vertex : mesh.vertices) {
            const Vec3 p = vertex - center;
            for (const double coordinate : {p.x, p.y, p.z}) *vertices++ = static_cast<float>(coordinate);
        }
        auto* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                sizeof(Triangle), mesh.triangles.size());
        std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<Triangle*>(indices));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(result, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(result);
    return result;
}

struct PreparedRays {
    std::vector<RayPacket> packets;
    std::vector<LaneMask> lanes;
};

/// The shadow rays of the connections, in their order: by packets of points, then vertices.
PreparedRays prepare_rays(const std::vector<transport::Receiver>& points,
                          const std::vector<transport::LightVertex>& nodes, const Vec3& center) {
    PreparedRays rays;
    for (std::size_t first = 0; first < points.size(); first += kPacketWidth) {
        for (const transport::LightVertex& node : nodes) {
            RayPacket packet;
            LaneMask lanes{};
            bool any = false;
            for (std::size_t i = 0; i < kPacketWidth; ++i) {
                const transport::Receiver& point = points[first + i];
                const Vec3 segment = point.lifted() - node.lifted;
                const Vec3 origin = node.lifted - center;
                packet.origin_x[i] = static_cast<float>(origin.x);
                packet.origin_y[i] = static_cast<float>(origin.y);
                packet.origin_z[i] = static_cast<float>(origin.z);
                packet.direction_x[i] = static_cast<float>(segment.x);
                packet.direction_y[i] = static_cast<float>(segment.y);
                packet.direction_z[i] = static_cast<float>(segment.z);
                packet.end[i] = 1;
                const Vec3 exact = point.position() - node.position;
                lanes[i] = dot(node.normal, exact) > 0 && dot(point.normal(), exact) < 0 ? -1 : 0;
                any = any || lanes[i] != 0;
            }
            if (!any) continue;
            rays.packets.push_back(packet);
            rays.lanes.push_back(lanes);
        }
    }
    return rays;
}

void compare(const Scene& scene) {
    const rays::RayCaster caster(scene);
    const transport::LightSampler lights(scene, caster);
    std::vector<transport::LightVertex> nodes =
        trace_light_paths(scene, caster, lights, 100, math::RandomKey{1}, 0, 256);
    nodes.resize(std::min<std::size_t>(nodes.size(), 256));
    std::vector<transport::Receiver> points;
    for (const Measurand& measurand : make_grid(32)) {
        points.emplace_back(static_cast<std::uint32_t>(points.size()), viewpoint_of(measurand), caster);
    }
    points = sorted_receivers(std::move(points));
    const std::vector<double> k(points.size(), 1.0);
    const std::vector<estimators::PointTile> tiles =
        estimators::tiles_of(points, k, caster, transport::kUnlimited);
    const estimators::Connections connections(caster, tiles);
    PreparedRays rays = prepare_rays(points, nodes, caster.center());

    const RTCDevice device = rtcNewDevice(nullptr);
    const RTCScene bare = bare_scene(device, scene, caster.center());
    double best_connections_s = 1e30, best_bare_s = 1e30;
    std::uint64_t traced = 0;
    constexpr int repetitions = 15;  // in turn, so that a change of the machine's speed meets both
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        estimators::Tally sums(points.size());
        double start = now_s();
        connections.collect(nodes, sums);
        best_connections_s = std::min(best_connections_s, now_s() - start);
        traced = sums.rays;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        for (RayPacket& packet : rays.packets) packet.end.fill(1);
        start = now_s();
        for (std::size_t p = 0; p < rays.packets.size(); ++p) {
            rtcOccluded16(rays.lanes[p].data(), bare, &context,
                          reinterpret_cast<RTCRay16*>(&rays.packets[p]));
        }
        best_bare_s = std::min(best_bare_s, now_s() - start);
    }
    rtcReleaseScene(bare);
    rtcReleaseDevice(device);
    const double million = static_cast<double>(traced) / 1e6;
    fmt::print("{:18} {:10.1f} {:10.1f} {:8.2f}\n", scene.name, million / best_connections_s,
               million / best_bare_s, best_bare_s / best_connections_s);
}

}  // namespace
}  // namespace stilb

int main() {
    fmt::print("Connections, one thread, best of 15   [million rays / s]\n{:18} {:>10} {:>10} {:>8}\n", "",
               "collect", "bare", "ratio");
    stilb::compare(stilb::make_room(0));
    stilb::compare(stilb::make_room(30));
}
