// The view-independent light of a scene: computed by solve(), stored in files, rendered to pictures.
//
// It is kept at the vertices of patches that are finer where surfaces come close to each other, as the first
// terms of a series over the incident directions (incoming_light.h), apart for groups of lights, and without
// direct light: that is computed where it is seen.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/half.h"
#include "patches/patches.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"

namespace stilb::estimators {

using stilb::to_rgb;  // beside those of other precisions

/// Plain values, which belong to a scene with the same objects, materials and lights.
struct PatchSolution {
    patches::Patches patches;
    /// The names of the groups of lights (scene/light_groups.h).
    std::vector<std::string> groups;
    /// The degree of the basis of the light.
    int degree = 0;
    /// The sides of vertices that carry light, ascending (light_vertices.h).
    std::vector<std::uint32_t> lit_vertices;
    /// For each group: the terms [lx / sqrt(sr)] of all lit vertices, one after the other.
    std::vector<std::vector<HalfRgb>> terms;
    /// For each independent replicate: the illuminance of each lit vertex, by all groups, as a share of the
    /// mean of all replicates.
    std::vector<std::vector<Half>> replicates;
    /// Per lit vertex: the illuminance that the patches add or lack at most, as a share of the whole.
    std::vector<Half> bias;
};

/// What a solution's file may hold before compression. A damaged or hostile one may claim to hold more.
inline constexpr std::uint64_t kMostStoredBytes = std::uint64_t{1} << 31;

/// Sizes of a solution.
struct SolutionSizes {
    std::size_t patches = 0, vertices = 0, lit_vertices = 0;
    std::size_t terms = 0;  ///< of all lit vertices
    std::size_t groups = 0, replicates = 0;
};
/// Throws InputError where the file would hold more: before the light is computed.
void require_storable(const SolutionSizes& sizes);

/// The same light as one group, each group's multiplied by its factor.
PatchSolution relit(PatchSolution solution, std::span<const Rgb> factors);

/// Throws InputError where the parts do not fit one another or the scene: indices out of range would
/// address other data.
void require_consistency(const PatchSolution& solution, const Scene& scene);

}  // namespace stilb::estimators
