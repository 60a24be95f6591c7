#include "rays/acceleration_structure.h"

#include <fmt/format.h>

#include <exception>
#include <mutex>
#include <stdexcept>

namespace stilb::rays {
namespace {

/// Passes the progress of a build on to a monitor. What the monitor throws must not pass through Embree,
/// which would make an error of its own of it.
struct BuildReport {
    const Monitor& monitor;
    std::mutex mutex{};
    std::exception_ptr thrown{};

    /// Embree's threads call it while they build; false ends the build. Interruptions come between stages,
    /// not from here.
    static bool pass_on(void* report, double share) {
        auto& [monitor, mutex, thrown] = *static_cast<BuildReport*>(report);
        const std::lock_guard lock(mutex);
        if (thrown) return false;
        try {
            monitor.report("acceleration structure", share);
        } catch (const Cancelled&) {
        } catch (...) {
            thrown = std::current_exception();
        }
        return thrown == nullptr;
    }
};

/// Builds what rays need, and throws what the monitor throws meanwhile.
void build(RTCScene scene, const Monitor& monitor) {
    BuildReport report{monitor};
    rtcSetSceneProgressMonitorFunction(scene, BuildReport::pass_on, &report);
    try {
        commit(scene);
    } catch (...) {
        if (!report.thrown) throw;
    }
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);  // the monitor may end now
    if (report.thrown) std::rethrow_exception(report.thrown);
}

void throw_error(void*, RTCError, const char* message) {
    throw std::runtime_error(fmt::format("Embree: {}", message));
}

}  // namespace

MetObject::MetObject(const EmbreeGeometry& geometry, const SharedList<MaterialId>& materials_of_object)
    : vertices(geometry.is_mirrored ? nullptr : geometry.vertices),
      triangles(geometry.triangles),
      parents(geometry.parents.empty() ? nullptr : geometry.parents.data()),
      materials(materials_of_object.data()),
      placement(geometry.instance == nullptr ? nullptr : &geometry.placement),
      has_one_material(materials_of_object.size() == 1),
      is_smooth(geometry.smooth != nullptr) {}

AccelerationStructure::AccelerationStructure(const Scene& objects, const Precision& wanted,
                                             const Monitor& monitor)
    : precision(wanted) {
    device = rtcNewDevice(nullptr);
    if (device == nullptr) throw std::runtime_error("Embree: no device could be created");
    rtcSetDeviceErrorFunction(device, throw_error, nullptr);
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0) packet_width = 8;
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0) packet_width = 16;
    scene = new_scene(device);
    grazed_edges.emplace(scene, geometries);
    for (const Object& object : objects.objects) add(object);
    build(scene, monitor);
}

AccelerationStructure::~AccelerationStructure() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}

void AccelerationStructure::add(const Object& object) {
    geometries.push_back(std::make_unique<EmbreeGeometry>());
    const auto* instance = std::get_if<Instance>(&object.shape);
    const RTCGeometry embree_geometry =
        instance == nullptr
            ? new_geometry(device, object.shape, precision.center, *geometries.back())
            : shared_meshes.new_instance(device, *instance, precision.center, *geometries.back());
    if (precision.is_for_fine_things && geometries.back()->vertices != nullptr && instance == nullptr) {
        rtcSetGeometryUserData(embree_geometry, &*grazed_edges);
        rtcSetGeometryOccludedFilterFunction(embree_geometry, GrazedEdges::drop_from_occlusion);
    }
    rtcCommitGeometry(embree_geometry);
    rtcAttachGeometryByID(scene, embree_geometry, static_cast<unsigned>(geometries.size() - 1));
    met_objects.emplace_back(*geometries.back(), object.materials);
    rtcReleaseGeometry(embree_geometry);
}

}  // namespace stilb::rays
