// Stand-in for the core until it is merged: the same names, in a namespace that walk calls `estimators`.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/half.h"
#include "base/vec.h"
#include "estimators/patch_light/first_shot/shadow_rays.h"
#include "math/zernike.h"
#include "patches/patches.h"
#include "scene/light_groups.h"
#include "scene/scene.h"

namespace stilb {

namespace walk_stand_in {

using ::stilb::HalfRgb;
using ::stilb::estimators::lifted_off;
using FloatRgb = std::array<float, 3>;

struct PatchSolution {
    patches::Patches patches;
    std::vector<std::string> groups;
    int degree = 0;
    std::vector<std::uint32_t> lit_vertices;
    std::vector<std::vector<HalfRgb>> terms;
    std::vector<float> error;
};

class LightVertices {
  public:
    LightVertices(const Scene& scene, const patches::Patches& patches, int degree,
                  std::vector<std::uint32_t> lit)
        : patches_(patches), lit_(std::move(lit)) {
        materials_.resize(patches.vertices.size());
        normals_.resize(patches.vertices.size());
        for (std::uint32_t p = 0; p < patches.count(); ++p) {
            for (const std::uint32_t corner : patches.corners[p]) {
                materials_[corner] = patches.materials[p];
                normals_[corner] += Vec3(patches.normals[p]);
            }
        }
        for (const std::uint32_t v : lit_) {
            const Material& m = scene.material(materials_[v % patches.vertices.size()]);
            const bool one = std::holds_alternative<Diffuse>(m) || std::holds_alternative<Black>(m);
            first_.push_back(first_.back() +
                             static_cast<std::uint32_t>(one ? 1 : math::ZernikeBasis(degree).count()));
        }
    }
    std::size_t count() const { return lit_.size(); }
    static constexpr std::uint32_t kDark = ~0u;
    std::uint32_t number_of(std::uint32_t vertex, bool is_front) const {
        const auto side = static_cast<std::uint32_t>(is_front ? vertex : vertex + patches_.vertices.size());
        const auto found = std::ranges::lower_bound(lit_, side);
        return found != lit_.end() && *found == side ? static_cast<std::uint32_t>(found - lit_.begin())
                                                     : kDark;
    }
    Vec3 position(std::uint32_t number) const {
        return patches_.center + Vec3(patches_.vertices[lit_[number] % patches_.vertices.size()]);
    }
    Frame frame(std::uint32_t number) const {
        const std::size_t count = patches_.vertices.size();
        const Vec3 normal = normalized(normals_[lit_[number] % count]);
        return Frame::of_surface(lit_[number] < count ? normal : -normal);
    }
    MaterialId material(std::uint32_t number) const {
        return materials_[lit_[number] % patches_.vertices.size()];
    }
    std::uint32_t first_term(std::uint32_t number) const { return first_[number]; }

  private:
    const patches::Patches& patches_;
    std::vector<std::uint32_t> lit_;
    std::vector<std::uint32_t> first_{0};
    std::vector<MaterialId> materials_;
    std::vector<Vec3> normals_;
};

struct ReflectionTable {
    int thetas = 0, phis = 0;
    std::vector<FloatRgb> factors;
};
inline ReflectionTable make_reflection_table(const Material& material, int degree) {
    const auto* ward = std::get_if<Ward>(&material);
    const bool anisotropic =
        ward != nullptr && ward->parameters().roughness[0] != ward->parameters().roughness[1];
    ReflectionTable table{33, anisotropic ? 32 : 1, {}};
    const auto count = static_cast<std::size_t>(table.thetas * table.phis);
    table.factors.resize(count * math::ZernikeBasis(degree).count());
    return table;
}

}  // namespace walk_stand_in

namespace walk {
namespace estimators = walk_stand_in;
}  // namespace walk

}  // namespace stilb
