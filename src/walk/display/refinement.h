// Refinement of the displayed surface where the direct light at its vertices is not linear between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.h"
#include "walk/display/display_mesh.h"
#include "walk/display/display_surface.h"
#include "walk/display/vertex_light.h"

namespace stilb::walk {

/// The direct light at vertices.
struct VertexLights {
    std::size_t lights = 0;
    std::vector<float> lx;                 ///< vertex x lights + light
    std::vector<float> squared_error_lx2;  ///< per vertex: standard error of the sum over lights
    std::vector<std::uint8_t> is_covered;  ///< per vertex

    void resize(std::size_t vertices);
    std::span<const float> of(std::uint32_t vertex) const {
        return std::span(lx).subspan(vertex * lights, lights);
    }
    double sum_lx(std::uint32_t vertex) const;
};

/// The scene that is refined. Refinement keeps references to all three.
struct RefinementScene {
    const Scene& scene;
    const patches::Patches& patches;
    const VertexLight& light;

    ObjectId object_of(std::uint32_t side) const { return patches.object_of(patches.patch_of(side)); }
    const Shape& shape_of(std::uint32_t side) const { return scene.object(object_of(side)).shape; }
    bool is_specular(std::uint32_t side) const {
        return materials::is_specular(scene.material(patches.material_of(scene, side)));
    }
};

/// The light at the vertices `first` and following of the surface. `around`: per vertex from `first` on; no
/// light where it is empty.
void light_vertices(const RefinementScene& scene, const DisplaySurface& surface, std::size_t first,
                    const std::vector<std::vector<Adjoining>>& around, VertexLights& lights,
                    const Monitor& monitor);

/// Halves edges as display_mesh.h says, and adds the new vertices with their light; some of these belong to
/// no triangle. Returns for each vertex the largest error of linear interpolation around it [lx].
/// `typical_lx`: a mean illuminance; errors that are small against it do not matter.
std::vector<float> refine(const RefinementScene& scene, const DisplayOptions& options, double typical_lx,
                          double extent_m, DisplaySurface& surface, VertexLights& lights,
                          const Monitor& monitor);

}  // namespace stilb::walk
