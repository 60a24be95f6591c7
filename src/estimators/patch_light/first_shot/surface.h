// Sides of patches as surfaces that reflect, for all variants of first shot.
#pragma once

#include <span>
#include <variant>

#include "materials/material.h"
#include "patches/patches.h"
#include "scene/scene.h"

namespace stilb::estimators {

inline const Material& material_of(const Scene& scene, const patches::Patches& patches, std::uint32_t side) {
    return scene.material(patches.materials[patches.patch_of(side)]);
}

/// The frame that the material of a side knows directions in, by world coordinates.
inline Frame frame_of(const patches::Patches& patches, std::uint32_t side) {
    return Frame::of_surface(patches.normal_of(side));
}

/// Bands in single precision, for what is stored per side.
inline patches::Float3 in_floats(const Rgb& s) {
    return {static_cast<float>(s[0]), static_cast<float>(s[1]), static_cast<float>(s[2])};
}
inline Rgb to_spectrum(const patches::Float3& bands) { return {{bands.x, bands.y, bands.z}}; }

/// Mirrors, glass and panes too: they have no BRDF.
inline bool reflects_nothing(const Material& material) {
    return std::holds_alternative<Black>(material) || is_specular(material);
}
/// Whether what is reflected, if anything, is the same in all directions.
inline bool reflects_alike(const Material& material) {
    return std::holds_alternative<Diffuse>(material) || reflects_nothing(material);
}

/// Adds to each of `sums` what the material reflects towards the unit world direction in `outs` at the same
/// place [cd/m2]. `for_each_arrival(visit)` calls `visit(in, illuminance_lx)` for all light that arrives,
/// `in` being the unit world direction that it comes from.
template <typename ForEachArrival>
void reflect(const Material& any, const Frame& frame, const ForEachArrival& for_each_arrival,
             std::span<const Vec3> outs, std::span<Rgb> sums) {
    std::visit(
        [&](const auto& material) {
            for_each_arrival([&](const Vec3& in, const Rgb& illuminance_lx) {
                const Vec3 local_in = frame.to_local(in);
                for (std::size_t i = 0; i < outs.size(); ++i) {
                    const Vec3 out = frame.to_local(outs[i]);
                    sums[i] += evaluate_brdf_per_sr(material, local_in, out) * illuminance_lx;
                }
            });
        },
        any);
}

}  // namespace stilb::estimators
