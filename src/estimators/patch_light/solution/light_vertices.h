// The vertices of patches at which a solution keeps light: one for each side of a smooth part of surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/vec.h"
#include "patches/patches.h"
#include "scene/scene.h"

namespace stilb::estimators {

/// The sides of vertices: vertex v on the front of its patches is v, on their back v + vertices.size().
/// Immutable. Keeps a reference to the patches.
class LightVertices {
  public:
    /// `lit`: the sides that carry light, ascending.
    LightVertices(const Scene& scene, const patches::Patches& patches, int degree,
                  std::vector<std::uint32_t> lit);

    static constexpr std::uint32_t kDark = ~0u;

    std::size_t count() const { return lit_.size(); }
    /// The number of the light vertex at a patch's corner, for one side of the patch; kDark where that side
    /// carries no light.
    std::uint32_t number_of(std::uint32_t vertex, std::uint32_t side) const {
        return numbers_[patches_->is_front(side) ? vertex : vertex + patches_->vertices.size()];
    }
    std::span<const std::uint32_t> sides() const { return lit_; }
    bool is_front(std::uint32_t number) const { return lit_[number] < patches_->vertices.size(); }
    std::uint32_t vertex(std::uint32_t number) const {
        const auto vertices = static_cast<std::uint32_t>(patches_->vertices.size());
        return is_front(number) ? lit_[number] : lit_[number] - vertices;
    }

    Vec3 position(std::uint32_t number) const {
        return patches_->center + Vec3(patches_->vertices[vertex(number)]);
    }
    /// The frame of its material: the z axis is the mean normal of the patches around, on the lit side.
    const Frame& frame(std::uint32_t number) const { return frames_[number]; }
    MaterialId material(std::uint32_t number) const { return materials_[number]; }
    /// The first of its terms among those of all vertices; for count() their number.
    std::uint32_t first_term(std::uint32_t number) const { return first_terms_[number]; }
    std::uint32_t terms_of(std::uint32_t number) const {
        return first_terms_[number + 1] - first_terms_[number];
    }
    std::uint32_t terms() const { return first_terms_.back(); }

  private:
    const patches::Patches* patches_;
    std::vector<std::uint32_t> lit_;
    std::vector<std::uint32_t> numbers_;  ///< per side of all vertices
    std::vector<Frame> frames_;
    std::vector<MaterialId> materials_;
    std::vector<std::uint32_t> first_terms_;
};

}  // namespace stilb::estimators
