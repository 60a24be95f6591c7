#include "estimators/patch_light/solution/patch_solution.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "estimators/patch_light/first_shot/shadow_rays.h"
#include "math/zernike.h"
#include "scene/light_groups.h"
#include "stilb/error.h"

namespace stilb::estimators {
namespace {

void require(bool holds, const char* what) {
    if (!holds) throw InputError(std::string("the solution does not fit the scene: ") + what);
}

bool ascend(std::span<const std::uint32_t> numbers, bool strictly) {
    return std::ranges::adjacent_find(numbers, [&](std::uint32_t a, std::uint32_t b) {
               return strictly ? a >= b : a > b;
           }) == numbers.end();
}

bool all_below(std::span<const std::uint32_t> numbers, std::size_t limit) {
    return std::ranges::all_of(numbers, [&](std::uint32_t number) { return number < limit; });
}

/// A table of the starts of rows, from 0 to `end`.
bool is_row_table(std::span<const std::uint32_t> rows, std::size_t count, std::size_t end) {
    return rows.size() == count + 1 && rows.front() == 0 && rows.back() == end && ascend(rows, false);
}

bool is_finite(const patches::Float3& v) { return stilb::is_finite(Vec3(v)); }
bool are_shares(std::span<const Half> values) {
    return std::ranges::all_of(
        values, [](Half value) { return std::isfinite(to_float(value)) && to_float(value) >= 0; });
}

/// Rays start at the vertices, along the normals: what is far from the scene, or no direction, ends Embree.
void require_near(const patches::Patches& patches, const Scene& scene) {
    const Bounds bounds = scene::bounds_of(scene);
    // Curved surfaces have vertices a little outside of their bounds.
    const Vec3 margin = 0.1 * length(bounds.max - bounds.min) * Vec3{1, 1, 1};
    const Vec3 least = bounds.min - margin, most = bounds.max + margin;
    for (const patches::Float3& vertex : patches.vertices) {
        const Vec3 position = patches.center + Vec3(vertex);
        require(position.x >= least.x && position.y >= least.y && position.z >= least.z &&
                    position.x <= most.x && position.y <= most.y && position.z <= most.z,
                "a vertex lies outside of the scene");
    }
    constexpr double tolerance = 1e-3;
    for (const patches::Float3& normal : patches.normals)
        require(std::abs(length(Vec3(normal)) - 1) < tolerance, "a normal is no unit vector");
}

void require_patches(const patches::Patches& patches, const Scene& scene) {
    const std::size_t count = patches.count();
    require(count > 0 && count <= patches::kMostPatches, "the number of patches");
    require(patches.normals.size() == count && patches.areas_m2.size() == count &&
                patches.materials.size() == count,
            "the lengths of the patches' lists differ");
    require(is_row_table(patches.first_of_object, scene.objects.size(), count), "the objects");
    std::vector<bool> is_corner(patches.vertices.size());
    for (const Triangle& corners : patches.corners) {
        require(all_below(corners, patches.vertices.size()), "a corner is none of the vertices");
        for (const std::uint32_t corner : corners) is_corner[corner] = true;
    }
    require(std::ranges::find(is_corner, false) == is_corner.end(), "a vertex belongs to no patch");
    for (const MaterialId material : patches.materials) {
        require(index_of(material) < scene.materials.size(), "a material is none of the scene's");
    }
    const auto finite = [](const patches::Float3& v) { return is_finite(v); };
    require(stilb::is_finite(patches.center) && std::ranges::all_of(patches.vertices, finite) &&
                std::ranges::all_of(patches.normals, finite) &&
                std::ranges::all_of(patches.areas_m2, [](float area) { return area > 0; }),
            "positions and areas must be finite numbers");
    require_near(patches, scene);
}

/// The number of terms of all lit vertices.
std::size_t terms_of(const PatchSolution& solution, const Scene& scene) {
    const patches::Patches& patches = solution.patches;
    std::vector<MaterialId> materials(patches.vertices.size());
    for (std::size_t p = 0; p < patches.count(); ++p) {
        for (const std::uint32_t corner : patches.corners[p]) materials[corner] = patches.materials[p];
    }
    std::size_t terms = 0;
    for (const std::uint32_t side : solution.lit_vertices) {
        const MaterialId material =
            scene.on_side(materials[side % materials.size()], side < materials.size());
        terms += reflects_alike(scene.material(material)) ? 1 : math::ZernikeBasis(solution.degree).count();
    }
    return terms;
}

void require_light(const PatchSolution& solution, const Scene& scene) {
    require(solution.degree >= 0 && solution.degree <= math::ZernikeBasis::kMostDegree,
            "the degree of the basis");
    const std::size_t lit = solution.lit_vertices.size();
    require(all_below(solution.lit_vertices, 2 * solution.patches.vertices.size()) &&
                ascend(solution.lit_vertices, true),
            "the vertices with light");
    require(solution.groups == scene::light_groups(scene).names, "the groups of lights");
    require(solution.terms.size() == solution.groups.size(), "the number of groups");
    const std::size_t terms = terms_of(solution, scene);
    for (const auto& group : solution.terms) {
        require(group.size() == terms, "the number of terms");
        require(std::ranges::all_of(group, [](const HalfRgb& rgb) { return to_rgb(rgb).is_finite(); }),
                "light must be finite numbers");
    }
    require(solution.replicates.size() >= 2, "the number of replicates");
    for (const auto& replicate : solution.replicates)
        require(replicate.size() == lit && are_shares(replicate), "the shares of the replicates");
    require(solution.bias.size() == lit && are_shares(solution.bias), "the bias of the patches");
}

}  // namespace

void require_storable(const SolutionSizes& sizes) {
    constexpr std::uint64_t rest = std::uint64_t{1} << 20;  // names and counts
    constexpr std::size_t patch_bytes =
        sizeof(Triangle) + sizeof(patches::Float3) + sizeof(float) + sizeof(MaterialId);
    constexpr std::size_t exponent_bytes = 2, number_bytes = 4;
    const std::uint64_t lit_bytes = sizeof(std::uint32_t) + (sizes.replicates + 1) * sizeof(Half);
    const std::uint64_t term_bytes = exponent_bytes + kBands * number_bytes * sizes.groups;
    const std::uint64_t bytes = rest + sizes.patches * patch_bytes +
                                sizes.vertices * sizeof(patches::Float3) + sizes.lit_vertices * lit_bytes +
                                sizes.terms * term_bytes;
    if (bytes <= kMostStoredBytes) return;
    throw InputError(
        fmt::format("the solution would take {:.2g} GB, but its file can hold {:.2g} GB: {} patches, {} "
                    "groups of lights, {} "
                    "numbers for the light of each. Take larger patches (--patch), a lower --degree for "
                    "glossy surfaces, or fewer "
                    "groups of lights.",
                    1e-9 * static_cast<double>(bytes), 1e-9 * static_cast<double>(kMostStoredBytes),
                    sizes.patches, sizes.groups, sizes.terms));
}

PatchSolution relit(PatchSolution solution, std::span<const Rgb> factors) {
    std::vector<HalfRgb> sums(solution.terms.empty() ? 0 : solution.terms[0].size());
    for (std::size_t t = 0; t < sums.size(); ++t) {
        Rgb sum;
        for (std::size_t g = 0; g < factors.size(); ++g) sum += to_rgb(solution.terms[g][t]) * factors[g];
        sums[t] = to_half_rgb(sum);
    }
    solution.terms = {std::move(sums)};
    solution.groups = {"all"};
    return solution;
}

void require_consistency(const PatchSolution& solution, const Scene& scene) {
    require_patches(solution.patches, scene);
    require_light(solution, scene);
}

}  // namespace stilb::estimators
