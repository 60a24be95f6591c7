#include "estimators/patch_light/solution/light_vertices.h"

#include <utility>

#include "estimators/patch_light/first_shot/shadow_rays.h"
#include "math/zernike.h"

namespace stilb::estimators {

LightVertices::LightVertices(const Scene& scene, const patches::Patches& patches, int degree,
                             std::vector<std::uint32_t> lit)
    : patches_(&patches), lit_(std::move(lit)), numbers_(2 * patches.vertices.size(), kDark) {
    std::vector<Vec3> normals(patches.vertices.size());
    std::vector<MaterialId> materials(patches.vertices.size());
    for (std::size_t p = 0; p < patches.count(); ++p) {
        for (const std::uint32_t corner : patches.corners[p]) {
            normals[corner] += double{patches.areas_m2[p]} * Vec3(patches.normals[p]);
            materials[corner] = patches.materials[p];
        }
    }
    const auto all_terms = static_cast<std::uint32_t>(math::ZernikeBasis(degree).count());
    first_terms_.push_back(0);
    for (std::uint32_t i = 0; i < lit_.size(); ++i) {
        numbers_[lit_[i]] = i;
        const Vec3 normal = normalized(normals[vertex(i)]);
        frames_.push_back(Frame::of_surface(is_front(i) ? normal : -normal));
        materials_.push_back(scene.on_side(materials[vertex(i)], is_front(i)));
        const bool is_alike = reflects_alike(scene.material(materials_.back()));
        first_terms_.push_back(first_terms_.back() + (is_alike ? 1 : all_terms));
    }
}

}  // namespace stilb::estimators
