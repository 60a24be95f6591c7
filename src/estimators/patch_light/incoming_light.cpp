#include "estimators/patch_light/incoming_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "estimators/patch_light/solution/reflection_table.h"

namespace stilb::estimators {
namespace {

const double kSqrtPi = std::sqrt(std::numbers::pi);  // 1 / Z_0

}  // namespace

TermLayout::TermLayout(const PatchTransport& transport, int degree, std::vector<std::uint32_t> sides)
    : basis_(degree), sides_(std::move(sides)), first_(2 * transport.patches.count() + 1) {
    for (const std::uint32_t side : sides_) {
        first_[side + 1] = transport.reflects_alike(side) ? 1 : basis_.count();
    }
    for (std::size_t side = 1; side < first_.size(); ++side) first_[side] += first_[side - 1];
}

std::vector<std::uint32_t> reflecting_sides(const PatchTransport& transport) {
    std::vector<std::uint32_t> sides;
    const auto count = static_cast<std::uint32_t>(2 * transport.patches.count());
    for (std::uint32_t side = 0; side < count; ++side) {
        const Material& material = transport.material_of(side);
        if (reflectance_bound(material).max() > 0 && !is_specular(material)) sides.push_back(side);
    }
    return sides;
}

TermSums TermSums::of_sides(std::vector<std::uint32_t> sides) const {
    TermSums chosen(transport_, TermLayout(transport_, layout_.basis().degree(), std::move(sides)), groups_);
    chosen.steps_ = steps_;
    for (const std::uint32_t side : chosen.layout_.sides()) {
        for (std::size_t g = 0; g < groups_; ++g)
            std::ranges::copy(sums_of(g, side), &chosen.sums_[chosen.first_of(g, side)]);
    }
    return chosen;
}

void TermSums::write(ByteWriter& bytes) const {
    bytes.add(steps_);
    bytes.add_list(sums_);
}

void TermSums::read(ByteReader& bytes) {
    steps_ = bytes.take<std::uint64_t>("the steps of all walks");
    if (steps_ == 0) bytes.fail("the walks have no steps");
    bytes.take_same_size(sums_, "the light of the patches");
}

void TermSums::add(std::span<const BundleIteration* const> walks) {
    constexpr std::size_t sides_at_once = 256;
    const auto add_part = [&](std::size_t first, std::size_t last) {
        for (const std::uint32_t side : layout_.sides().subspan(first, last - first)) add(walks, side);
    };
    parallel_for_parts(layout_.sides().size(), add_part, sides_at_once);
    steps_ += walks.size();
}

void TermSums::add(std::span<const BundleIteration* const> walks, std::uint32_t side) {
    std::array<double, math::ZernikeBasis::kMostCount> values{1 / kSqrtPi};
    const std::size_t count = layout_.count_of(side);
    const Frame frame = Frame::of_surface(transport_.patches.normal_of(side));
    for (const BundleIteration* const walk : walks) {
        walk->for_each_arrival(side, [&](const Vec3& in, std::span<const Rgb> illuminances_lx) {
            if (count > 1) layout_.basis().evaluate(frame.to_local(in), values);
            for (std::size_t g = 0; g < illuminances_lx.size(); ++g) {
                FloatRgb* const sums = &sums_[first_of(g, side)];
                for (std::size_t k = 0; k < count; ++k) add_to(sums[k], illuminances_lx[g] * values[k]);
            }
        });
    }
}

std::vector<FloatRgb> reflection_factors(const PatchTransport& transport, const TermLayout& layout,
                                         std::uint32_t side, const Vec3& out) {
    std::vector<FloatRgb> factors(layout.count_of(side));
    if (factors.empty()) return factors;
    if (transport.reflects_alike(side)) {
        factors[0] = to_float_rgb(to_rgb(transport.constant_brdf[side]) * kSqrtPi);
        return factors;
    }
    const Vec3 local_out = Frame::of_surface(transport.patches.normal_of(side)).to_local(out);
    integrate_factors(transport.material_of(side), layout.basis(), local_out, 256, factors);
    return factors;
}

Rgb reflected_cd_m2(std::span<const FloatRgb> terms, std::span<const FloatRgb> factors) {
    // Four terms at a time, so that the compiler takes vectors.
    constexpr std::size_t together = 4;
    std::array<FloatRgb, together> sums{};
    std::size_t k = 0;
    for (; k + together <= terms.size(); k += together) {
        for (std::size_t i = 0; i < together; ++i) {
            for (std::size_t b = 0; b < kBands; ++b) sums[i][b] += terms[k + i][b] * factors[k + i][b];
        }
    }
    for (; k < terms.size(); ++k) {
        for (std::size_t b = 0; b < kBands; ++b) sums[0][b] += terms[k][b] * factors[k][b];
    }
    Rgb luminance;
    for (const FloatRgb& sum : sums) luminance += to_rgb(sum);
    for (double& band : luminance.band) band = std::max(band, 0.0);
    return luminance;
}

}  // namespace stilb::estimators
