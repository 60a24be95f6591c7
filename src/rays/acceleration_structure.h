// Embree's scene of all objects. Casters whose lights or measured points differ may share it.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/monitor.h"
#include "base/vec.h"
#include "rays/embree_geometry.h"
#include "rays/grazed_edges.h"
#include "scene/scene.h"

namespace stilb::rays {

/// The part of an object's data that RayCaster::surfaces() needs, close together.
struct MetObject {
    const std::array<float, 3>* vertices;  ///< null for curved surfaces and mirrored instances
    const Triangle* triangles;
    const std::uint32_t* parents;          ///< null where no triangle is part of a larger one
    const MaterialId* materials;           ///< one, or one for each triangle
    const geometry::Transform* placement;  ///< of instances; else null
    bool has_one_material;
    bool is_smooth;

    MetObject(const EmbreeGeometry& geometry, const SharedList<MaterialId>& materials_of_object);

    MaterialId material_of(std::uint32_t primitive) const {
        if (has_one_material) return materials[0];
        return materials[parents == nullptr ? primitive : parents[primitive]];
    }
};

/// Immutable after construction. It refers to the meshes of the scene that it was built of.
struct AccelerationStructure {
    /// What it depends on beside the objects.
    struct Precision {
        Vec3 center;  ///< the origin of Embree's coordinates
        bool is_for_fine_things = false;
        bool operator==(const Precision&) const = default;
    };

    /// The monitor takes the share that is built. Throws std::runtime_error where Embree fails.
    AccelerationStructure(const Scene& scene, const Precision& precision, const Monitor& monitor);
    ~AccelerationStructure();
    AccelerationStructure(const AccelerationStructure&) = delete;
    AccelerationStructure& operator=(const AccelerationStructure&) = delete;

    Precision precision;
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    int packet_width = 4;  ///< widest that the processor takes natively
    SharedMeshes shared_meshes;
    std::vector<std::unique_ptr<EmbreeGeometry>> geometries;  ///< by object
    std::vector<MetObject> met_objects;
    std::optional<GrazedEdges> grazed_edges;

  private:
    void add(const Object& object);
};

}  // namespace stilb::rays
