#include "estimators/patch_light/patch_solution.h"

#include <algorithm>

#include "base/error.h"
#include "estimators/patch_light/first_shot/surface.h"
#include "math/zernike.h"

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

/// A table of where rows begin, from 0 to `end`.
bool is_row_table(std::span<const std::uint32_t> rows, std::size_t count, std::size_t end) {
    return rows.size() == count + 1 && rows.front() == 0 && rows.back() == end && ascend(rows, false);
}

bool is_finite(const FloatRgb& rgb) { return to_rgb(rgb).is_finite(); }
bool is_finite(const patches::Float3& v) { return stilb::is_finite(Vec3(v)); }

void require_patches(const patches::Patches& patches, const Scene& scene) {
    const std::size_t count = patches.count();
    require(count > 0 && count <= patches::kMostPatches, "the number of patches");
    require(patches.normals.size() == count && patches.areas_m2.size() == count &&
                patches.materials.size() == count,
            "the lengths of the patches' lists differ");
    require(is_row_table(patches.first_of_object, scene.objects.size(), count), "the objects");
    for (const Triangle& corners : patches.corners) {
        require(all_below(corners, patches.vertices.size()), "a corner is none of the vertices");
    }
    for (const MaterialId material : patches.materials) {
        require(index_of(material) < scene.materials.size(), "a material is none of the scene's");
    }
    const auto finite = [](const patches::Float3& v) { return is_finite(v); };
    require(stilb::is_finite(patches.center) && std::ranges::all_of(patches.vertices, finite) &&
                std::ranges::all_of(patches.normals, finite) &&
                std::ranges::all_of(patches.areas_m2, [](float area) { return area > 0; }),
            "places and areas must be numbers");
}

void require_factors(const FirstShotFactors& factors, std::size_t sides, std::size_t samples) {
    require(is_row_table(factors.rows(), sides, factors.all().size()), "the rows of first shot's factors");
    for (const auto& factor : factors.all()) {
        require(factor.sample < samples && std::isfinite(factor.illuminance_lx), "a factor of first shot");
    }
}

void require_light(const PatchSolution& solution, const Scene& scene) {
    const patches::Patches& patches = solution.patches;
    require(solution.degree >= 0 && solution.degree <= math::ZernikeBasis::kMostDegree,
            "the degree of the basis");
    require(all_below(solution.lit_sides, 2 * patches.count()) && ascend(solution.lit_sides, true),
            "the sides with light");
    std::size_t terms = 0;
    for (const std::uint32_t side : solution.lit_sides) {
        terms += reflects_alike(material_of(scene, patches, side))
                     ? 1
                     : math::ZernikeBasis(solution.degree).count();
    }
    require(solution.replicates.size() >= 2, "the number of replicates");
    for (const auto& replicate : solution.replicates) {
        require(replicate.size() == terms, "the number of terms");
        require(std::ranges::all_of(replicate, [](const FloatRgb& rgb) { return is_finite(rgb); }),
                "light must be numbers");
    }
}

}  // namespace

void require_consistency(const PatchSolution& solution, const Scene& scene, const rays::RayCaster& caster) {
    require_patches(solution.patches, scene);
    if (solution.factors) {
        const auto lights = choose_first_shot_lights(scene, caster, solution.patches.center);
        require_factors(*solution.factors, 2 * solution.patches.count(), lights.samples.size());
    }
    require_light(solution, scene);
}

}  // namespace stilb::estimators
