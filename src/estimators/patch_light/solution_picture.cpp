#include "estimators/patch_light/solution_picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <utility>

#include "estimators/limits.h"
#include "estimators/patch_light/incoming_light.h"
#include "estimators/patch_light/patch_picture.h"

namespace stilb::estimators {
namespace {

class SolutionPicture final : public PictureEstimator {
  public:
    SolutionPicture(const PictureInput& input, PatchSolution solution)
        : tracing_(input),
          transport_(input.scene, input.caster, std::move(solution.patches), std::move(solution.factors)),
          replicates_cd_m2_(solution.replicates.size()) {
        const TermLayout layout(transport_, solution.degree, std::move(solution.lit_sides));
        reflect(layout, solution.replicates);
    }

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<PatchPass>(tracing_, transport_, pass, replicates_cd_m2_[pass.replicate]);
    }
    std::vector<std::string> warnings() const override {
        return patch_warnings(transport_.scene, "ray-bundle");
    }

  private:
    void reflect(const TermLayout& layout, const std::vector<std::vector<FloatRgb>>& replicates) {
        struct Seen {
            std::uint32_t side = 0;
            Vec3 out;
        };
        const VisibleSides sides(transport_, tracing_.view.position());
        std::vector<Seen> seen;
        sides.for_each([&](std::uint32_t side, const Vec3& out) { seen.push_back({side, out}); });
        std::ranges::fill(replicates_cd_m2_, std::vector<FloatRgb>(sides.count()));
        tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t i) {
            const auto& [side, out] = seen[i];
            const std::vector<FloatRgb> factors = reflection_factors(transport_, layout, side, out);
            for (std::size_t r = 0; r < replicates.size(); ++r) {
                const auto terms = std::span(replicates[r]).subspan(layout.first_of(side), factors.size());
                replicates_cd_m2_[r][side] = to_float_rgb(reflected_cd_m2(terms, factors));
            }
        });
        for (auto& sides_cd_m2 : replicates_cd_m2_) sides_cd_m2 = sides.mean_cd_m2(sides_cd_m2, 1);
    }

    PictureTracing tracing_;
    PatchTransport transport_;
    std::vector<std::vector<FloatRgb>> replicates_cd_m2_;  ///< of every side, towards the eye
};

}  // namespace

std::unique_ptr<PictureEstimator> make_solution_picture(const PictureInput& input, PatchSolution solution) {
    require_consistency(solution, input.scene, input.caster);
    return std::make_unique<SolutionPicture>(input, std::move(solution));
}

}  // namespace stilb::estimators
