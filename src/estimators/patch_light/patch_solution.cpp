#include "estimators/patch_light/patch_solution.h"

#include <algorithm>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "estimators/limits.h"
#include "estimators/patch_light/first_shot/variants.h"
#include "estimators/patch_light/incoming_light.h"
#include "estimators/patch_light/patch_readings.h"
#include "math/zernike.h"
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
            "positions and areas must be finite numbers");
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
                "light must be finite numbers");
    }
}

/// Pictures: the light that patches reflect towards the camera is computed before the first pass.
class SolutionPicture final : public Estimator {
  public:
    SolutionPicture(const Problem& problem, PatchSolution solution)
        : transport_(problem.scene, problem.caster, std::move(solution.patches), std::move(solution.factors)),
          tracing_(problem, transport_.lights),
          replicates_cd_m2_(solution.replicates.size()) {
        const TermLayout layout(transport_, solution.degree, std::move(solution.lit_sides));
        reflect(layout, solution.replicates);
    }

    // There are no readings.
    void run_batch(const Batch&, ReadingSums&) const override {}
    std::span<const Rgb> known_part() const override { return {}; }
    std::span<const std::optional<Vec3>> sight_ends() const override { return {}; }
    std::uint64_t batch_granularity() const override { return 1; }
    double rays_per_sample() const override { return 1; }

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<PatchPass>(tracing_, transport_, pass, replicates_cd_m2_[pass.replicate]);
    }
    std::vector<std::string> warnings() const override {
        return patch_warnings(transport_.scene, "ray-bundle");
    }

  private:
    void reflect(const TermLayout& layout, const std::vector<std::vector<FloatRgb>>& replicates) {
        struct VisibleSide {
            std::uint32_t side = 0;
            Vec3 out;
        };
        const VisibleSides sides(transport_, tracing_.view.position());
        std::vector<VisibleSide> seen;
        sides.for_each([&](std::uint32_t side, const Vec3& out) { seen.push_back({side, out}); });
        std::ranges::fill(replicates_cd_m2_, std::vector<FloatRgb>(sides.count()));
        parallel_for(seen.size(), [&](std::size_t i) {
            const auto& [side, out] = seen[i];
            const std::vector<FloatRgb> factors = reflection_factors(transport_, layout, side, out);
            for (std::size_t r = 0; r < replicates.size(); ++r) {
                const auto terms = std::span(replicates[r]).subspan(layout.first_of(side), factors.size());
                replicates_cd_m2_[r][side] = to_float_rgb(reflected_cd_m2(terms, factors));
            }
        });
        for (auto& sides_cd_m2 : replicates_cd_m2_) sides_cd_m2 = sides.mean_cd_m2(sides_cd_m2, 1);
    }

    PatchTransport transport_;
    PictureTracing tracing_;
    std::vector<std::vector<FloatRgb>> replicates_cd_m2_;  ///< of every side, towards the camera
};

}  // namespace

void require_consistency(const PatchSolution& solution, const Scene& scene, const rays::RayCaster& caster) {
    require_patches(solution.patches, scene);
    if (solution.factors) {
        const auto lights = choose_first_shot_lights(scene, caster, solution.patches.center);
        require_factors(*solution.factors, 2 * solution.patches.count(), lights.samples.size());
    }
    require_light(solution, scene);
}

std::unique_ptr<Estimator> make_solution_picture(const Problem& problem, PatchSolution solution) {
    require_consistency(solution, problem.scene, problem.caster);
    return std::make_unique<SolutionPicture>(problem, std::move(solution));
}

}  // namespace stilb::estimators
