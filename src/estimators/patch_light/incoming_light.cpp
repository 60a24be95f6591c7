#include "estimators/patch_light/incoming_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "math/random.h"
#include "math/sampling.h"

namespace stilb::estimators {
namespace {

const double kSqrtPi = std::sqrt(std::numbers::pi);  // 1 / Z_0

/// Calls `visit(in, weight_sr)` for directions whose weighted sum replaces an integral over the light that
/// arrives and leaves towards `out`, both in the material's frame: as many drawn by the BRDF as by the
/// cosine, from Hammersley's points, with the weights of the balance heuristic, which keep f / weight bounded
/// for lobes of any width.
template <typename Visit>
void for_each_node(const Material& material, const Vec3& out, const Visit& visit) {
    constexpr std::uint32_t each = 256;
    for (std::uint32_t i = 0; i < each; ++i) {
        const double u1 = (i + 0.5) / each, u2 = math::unit_interval(math::sobol(i, 0));
        const auto add = [&](const Vec3& in) {
            if (!(in.z > 0)) return;
            visit(in,
                  1 / (each * (pdf_per_sr(material, out, in) + math::cosine_hemisphere_pdf_per_sr(in.z))));
        };
        add(math::sample_cosine_hemisphere(u1, u2).direction);
        if (const auto drawn = sample_brdf(material, out, u1, u2)) add(drawn->direction);
    }
}

}  // namespace

TermLayout::TermLayout(const PatchTransport& transport, int degree, std::vector<std::uint32_t> sides)
    : basis_(degree), sides_(std::move(sides)), first_(2 * transport.patches.count() + 1) {
    for (const std::uint32_t side : sides_) {
        first_[side + 1] = transport.reflects_alike(transport.patches.patch_of(side)) ? 1 : basis_.count();
    }
    for (std::size_t side = 1; side < first_.size(); ++side) first_[side] += first_[side - 1];
}

std::vector<std::uint32_t> reflecting_sides(const PatchTransport& transport) {
    std::vector<std::uint32_t> sides;
    const auto count = static_cast<std::uint32_t>(2 * transport.patches.count());
    for (std::uint32_t side = 0; side < count; ++side) {
        const Material& material = transport.material_of(transport.patches.patch_of(side));
        if (reflectance_bound(material).max() > 0 && !is_specular(material)) sides.push_back(side);
    }
    return sides;
}

void TermSums::add(const BundleIteration& iteration) {
    std::array<double, math::ZernikeBasis::kMostCount> values;
    for (const std::uint32_t side : layout_.sides()) {
        FloatRgb* const sums = &sums_[layout_.first_of(side)];
        const std::size_t count = layout_.count_of(side);
        const Frame frame = Frame::of_surface(transport_.patches.normal_of(side));
        iteration.for_each_arrival(side, [&](const Vec3& in, const Rgb& illuminance_lx) {
            if (count == 1) return add_to(*sums, illuminance_lx * (1 / kSqrtPi));
            layout_.basis().evaluate(frame.to_local(in), values);
            for (std::size_t k = 0; k < count; ++k) add_to(sums[k], illuminance_lx * values[k]);
        });
    }
    ++steps_;
}

std::vector<FloatRgb> TermSums::mean() const {
    std::vector<FloatRgb> means;
    means.reserve(sums_.size());
    for (const FloatRgb& sum : sums_)
        means.push_back(to_float_rgb(to_rgb(sum) * (1 / static_cast<double>(steps_))));
    return means;
}

Rgb TermSums::mean_illuminance_lx(std::uint32_t side) const {
    return to_rgb(sums_[layout_.first_of(side)]) * (kSqrtPi / static_cast<double>(steps_));
}

std::vector<FloatRgb> reflection_factors(const PatchTransport& transport, const TermLayout& layout,
                                         std::uint32_t side, const Vec3& out) {
    const std::uint32_t patch = transport.patches.patch_of(side);
    std::vector<FloatRgb> factors(layout.count_of(side));
    if (factors.empty()) return factors;
    if (transport.reflects_alike(patch)) {
        factors[0] = to_float_rgb(to_rgb(transport.constant_brdf[patch]) * kSqrtPi);
        return factors;
    }
    const Material& material = transport.material_of(patch);
    const Vec3 local_out = Frame::of_surface(transport.patches.normal_of(side)).to_local(out);
    std::array<double, math::ZernikeBasis::kMostCount> values;
    for_each_node(material, local_out, [&](const Vec3& in, double weight_sr) {
        const Rgb share = evaluate_brdf_per_sr(material, in, local_out) * (in.z * weight_sr);
        layout.basis().evaluate(in, values);
        for (std::size_t k = 0; k < factors.size(); ++k) add_to(factors[k], share * values[k]);
    });
    return factors;
}

Rgb reflected_cd_m2(std::span<const FloatRgb> terms, std::span<const FloatRgb> factors) {
    Rgb luminance;
    for (std::size_t k = 0; k < terms.size(); ++k) luminance += to_rgb(terms[k]) * to_rgb(factors[k]);
    for (double& band : luminance.band) band = std::max(band, 0.0);
    return luminance;
}

}  // namespace stilb::estimators
