#include "run/solution_errors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>

#include "estimators/patch_light/solution/light_vertices.h"
#include "statistics/interval.h"

namespace stilb::run {
namespace {

/// Means over a vertex and those around it: a third of the weight is its own. Values of 0, of vertices that
/// no light reaches, do not count.
std::vector<double> means_around(const patches::Patches& patches, std::span<const std::uint32_t> lit_sides,
                                 std::span<const double> values) {
    std::vector<double> of_sides(2 * patches.vertices.size());
    for (std::size_t i = 0; i < lit_sides.size(); ++i) of_sides[lit_sides[i]] = values[i];
    struct Sum {
        double value = 0;
        int count = 0;
        double mean() const { return count > 0 ? value / count : 0; }
        void add(double other) {
            value += other;
            count += other > 0;
        }
    };
    std::vector<Sum> around(of_sides.size());
    for (const Triangle& corners : patches.corners) {
        for (const std::size_t first : {std::size_t{0}, patches.vertices.size()}) {
            Sum sum;
            for (const std::uint32_t corner : corners) sum.add(of_sides[first + corner]);
            for (const std::uint32_t corner : corners) around[first + corner].add(sum.mean());
        }
    }
    std::vector<double> means;
    for (const std::uint32_t side : lit_sides) means.push_back(around[side].mean());
    return means;
}

/// The mean of each vertex, and its noise: relative half-widths.
struct Noise {
    std::vector<double> means, half_widths;
};

/// The replicates of one vertex alone, eight, tell its standard error to 27 % only, and the noise of the
/// vertices around is alike: relative variances are means over these.
Noise noise_of(const patches::Patches& patches, std::span<const std::uint32_t> lit_sides,
               const statistics::ReplicateTable& illuminances, double confidence) {
    if (lit_sides.empty()) return {};
    // A third of the weight on the vertex itself, and the rest on two others at least.
    constexpr int least_vertices = 3;
    const auto moments = statistics::compute_replicate_moments(illuminances);
    std::vector<double> variances;
    for (std::size_t i = 0; i < moments.means.size(); ++i) {
        const double relative =
            moments.means[i] > 0 ? moments.errors.standard_errors[i] / moments.means[i] : 0;
        variances.push_back(relative * relative);
    }
    const double quantile = statistics::student_t_quantile(
        1 - (1 - confidence) / 2, least_vertices * (static_cast<int>(illuminances.replicates()) - 1));
    std::vector<double> half_widths = means_around(patches, lit_sides, variances);
    for (double& value : half_widths) value = quantile * std::sqrt(value);
    return {moments.means, std::move(half_widths)};
}

/// To whole steps. What red and blue differ by from green has twice the step: most of the luminance is green.
HalfRgb rounded(const Rgb& rgb, double step) {
    // Plus 0, so that no zero is negative.
    const auto to_steps = [](double value, double size) { return size * std::nearbyint(value / size) + 0.; };
    const double green = to_steps(rgb[1], step);
    return to_half_rgb(
        {{green + to_steps(rgb[0] - green, 2 * step), green, green + to_steps(rgb[2] - green, 2 * step)}});
}

}  // namespace

std::vector<float> relative_errors(const estimators::PatchSolution& solution) {
    constexpr double confidence = 0.95;
    std::vector<double> shares;
    for (const auto& replicate : solution.replicates)
        std::ranges::transform(replicate, std::back_inserter(shares), to_float);
    const Noise noise =
        noise_of(solution.patches, solution.lit_vertices, {shares, solution.lit_vertices.size()}, confidence);
    std::vector<float> errors;
    for (std::size_t i = 0; i < solution.bias.size(); ++i)
        errors.push_back(static_cast<float>(noise.half_widths[i]) + to_float(solution.bias[i]));
    return errors;
}

AttainedErrors attained_errors(const patches::Patches& patches,
                               const estimators::LightGather::Illuminances& illuminances) {
    const std::size_t count = illuminances.area_m2.size();
    const Noise noise = noise_of(patches, illuminances.lit_sides, {illuminances.replicate_means, count},
                                 statistics::kStoppedConfidence);
    std::vector<double> all, bias, flux_lm;
    for (std::size_t i = 0; i < count; ++i) {
        bias.push_back(noise.means[i] > 0 ? illuminances.bias_lx[i] / noise.means[i] : 0);
        all.push_back(noise.half_widths[i] + bias.back());
        flux_lm.push_back(noise.means[i] * illuminances.area_m2[i]);
    }
    return {statistics::attained_error_of(all, flux_lm), statistics::attained_error_of(bias, flux_lm)};
}

estimators::PatchSolution rounded_to_errors(estimators::PatchSolution solution, const Scene& scene) {
    constexpr double share_of_error = 0.3;
    const estimators::LightVertices vertices(scene, solution.patches, solution.degree, solution.lit_vertices);
    const std::vector<float> errors = relative_errors(solution);
    // The roundings of the groups are independent of each other.
    const double share = share_of_error / std::sqrt(static_cast<double>(solution.groups.size()));
    for (std::uint32_t i = 0; i < errors.size(); ++i) {
        Rgb whole;
        for (const auto& group : solution.terms) whole += to_rgb(group[vertices.first_term(i)]);
        const double size = share * double{errors[i]} * whole.luminance();
        if (!(size > 0) || !std::isfinite(size)) continue;
        // A power of two, so that the last bits of numbers are 0.
        const double step = std::exp2(std::floor(std::log2(size)));
        for (auto& group : solution.terms) {
            for (std::uint32_t t = vertices.first_term(i); t < vertices.first_term(i + 1); ++t)
                group[t] = rounded(to_rgb(group[t]), step);
        }
    }
    return solution;
}

}  // namespace stilb::run
