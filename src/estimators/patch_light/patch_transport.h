// The common part of the methods on patches: the patches, their reflection, and the light known in advance.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "estimators/patch_light/first_shot/first_shot.h"
#include "patches/vertex_interpolation.h"
#include "patches/visibility/bundle.h"
#include "patches/visibility/patch_caster.h"
#include "rays/ray_caster.h"

namespace stilb::estimators {

/// Single precision, for data of every side.
using FloatRgb = std::array<float, kBands>;

inline FloatRgb to_float_rgb(const Rgb& rgb) {
    return {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
}
inline Rgb to_rgb(const FloatRgb& rgb) { return {{rgb[0], rgb[1], rgb[2]}}; }
inline void add_to(FloatRgb& sum, const Rgb& value) {
    for (std::size_t b = 0; b < kBands; ++b) sum[b] += static_cast<float>(value[b]);
}

/// The number of sides.
inline void add_to(std::vector<FloatRgb>& sums, const std::vector<FloatRgb>& others) {
    for (std::size_t side = 0; side < sums.size(); ++side) add_to(sums[side], to_rgb(others[side]));
}

/// Keeps references to scene and caster. Immutable after construction.
struct PatchTransport : FirstShotPatches {
    /// As FirstShotPatches.
    PatchTransport(const Scene& scene, const rays::RayCaster& caster, const PatchOptions& options,
                   const Monitor& monitor = Monitor::none());

    const Material& material_of(std::uint32_t side) const {
        return scene.material(patches.material_of(scene, side));
    }
    bool reflects_alike(std::uint32_t side) const { return glossy_number[side] == kConstant; }

    /// The light of first shot that a side reflects, as a mean over the patch; nothing where it depends on
    /// the position.
    Rgb first_reflected(std::uint32_t side, const Vec3& out) const;
    /// The part that depends on the position.
    Rgb first_reflected_at(std::uint32_t side, const Vec3& position, math::RandomKey key,
                           const Vec3& out) const {
        return first_shot.needs_position(side) ? first_shot.reflected(side, position, key, out) : Rgb{};
    }

    patches::VertexInterpolation interpolation{patches};
    std::unique_ptr<patches::Bundles> bundles =
        make_bundles(options.first_shot.shooting.backend, patch_caster);
    double spacing_m = 0;  ///< of bundles' rays

    static constexpr std::uint32_t kConstant = ~0u;
    /// Per side: its index in `glossy_sides`, or kConstant for reflection that is equal in all directions.
    std::vector<std::uint32_t> glossy_number;
    std::vector<std::uint32_t> glossy_sides;
    std::vector<FloatRgb> constant_brdf;  ///< per side [1/sr]; 0 where it depends on direction
    std::vector<FloatRgb>
        first_reflection;            ///< per side [cd/m2]; 0 where it depends on direction or position
    std::vector<FloatRgb> emission;  ///< per patch, of its front; 0 where first shot replaces it
    double mean_reflectance = 0;     ///< by area

  private:
    void describe_patches();
    void add_reflection(std::uint32_t side);
    void add_emission(std::size_t light);
};

// Patch locations of points on the true surfaces.

struct PatchLocation {
    std::uint32_t side = 0;
    math::Barycentric barycentric;
};

/// A point of a true surface, seen from the unit direction `outgoing`.
struct ViewedHit {
    rays::Hit hit;
    Vec3 outgoing;
};

/// The patch locations of points. Where the patches of a curved surface do not cover a point, at its
/// outline, the surface behind it takes its place; nothing where there is none. `coherence`: of the
/// directions that neighbouring points are seen from.
std::vector<std::optional<PatchLocation>> find_patch_locations(
    const patches::PatchCaster& caster, std::span<const ViewedHit> points,
    rays::Coherence coherence = rays::Coherence::coherent);

}  // namespace stilb::estimators
