// The incident light of sides of patches, independent of the view: its first terms in a basis over the
// incident directions.
//
// L_in = sum over k of a_k Z_k for the projected hemisphere's orthonormal basis (math/zernike.h), so that
//
//     a_k = integral of L_in Z_k cos(theta) dw = sum over what arrives of Z_k(w_in) E,
//     L_out(w) = sum over k of a_k integral of f(w_in, w) Z_k(w_in) cos(theta) dw_in
//
// where E is the illuminance of each arrival. A diffuse side needs a_0 alone, E / sqrt(pi), and nothing is
// lost. Other sides keep a basis of some degree: light that is equal from all directions is still exact;
// light that changes within less than about 180 degrees / degree is blurred. docs/solution.md has the errors.
//
// First shot is not part of it: light of small sources needs too many terms.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "estimators/patch_light/patch_transport.h"
#include "estimators/patch_light/ray_bundle/bundle_iteration.h"
#include "math/zernike.h"

namespace stilb::estimators {

/// The offsets of each side's terms: one term for a side with constant reflection, a basis for others.
class TermLayout {
  public:
    /// `sides`: the sides with terms, ascending.
    TermLayout(const PatchTransport& transport, int degree, std::vector<std::uint32_t> sides);

    const math::ZernikeBasis& basis() const { return basis_; }
    std::span<const std::uint32_t> sides() const { return sides_; }
    /// The number of terms of all sides together.
    std::size_t count() const { return first_.back(); }
    std::size_t first_of(std::uint32_t side) const { return first_[side]; }
    /// 0 where the side has no terms.
    std::size_t count_of(std::uint32_t side) const { return first_[side + 1] - first_[side]; }

  private:
    math::ZernikeBasis basis_;
    std::vector<std::uint32_t> sides_;
    std::vector<std::size_t> first_;  ///< per side of all patches, and the end
};

/// Sides that reflect light.
std::vector<std::uint32_t> reflecting_sides(const PatchTransport& transport);

/// Terms of the mean of the steps of walks, for each of their groups of lights. Keeps a reference to the
/// transport.
class TermSums {
  public:
    TermSums(const PatchTransport& transport, TermLayout layout, std::size_t groups = 1)
        : transport_(transport),
          layout_(std::move(layout)),
          groups_(groups),
          sums_(groups * layout_.count()) {}
    /// Those of some of the sides; the others get none from now on.
    TermSums of_sides(std::vector<std::uint32_t> sides) const;

    const TermLayout& layout() const { return layout_; }

    /// Adds the light received in the last step of each walk.
    void add(std::span<const BundleIteration* const> walks);
    /// The number of steps that were added, of all walks together.
    std::uint64_t steps() const { return steps_; }
    /// The sum over the steps, of a side's terms [lx / sqrt(sr)].
    std::span<const FloatRgb> sums_of(std::size_t group, std::uint32_t side) const {
        return std::span(sums_).subspan(first_of(group, side), layout_.count_of(side));
    }

    /// As those of BundleIteration.
    void write(ByteWriter& bytes) const;
    void read(ByteReader& bytes);

  private:
    void add(std::span<const BundleIteration* const> walks, std::uint32_t side);
    /// A side's groups lie beside each other in memory, because they are read together.
    std::size_t first_of(std::size_t group, std::uint32_t side) const {
        return groups_ * layout_.first_of(side) + group * layout_.count_of(side);
    }

    const PatchTransport& transport_;
    TermLayout layout_;
    std::size_t groups_;
    std::uint64_t steps_ = 0;
    std::vector<FloatRgb> sums_;
};

/// The factors of a side's terms for the luminance that it reflects towards the unit `out`, in
/// front of it [1 / sqrt(sr)]. By a sum over directions: accurate to about 0.5 % for light that is equal from
/// all directions.
std::vector<FloatRgb> reflection_factors(const PatchTransport& transport, const TermLayout& layout,
                                         std::uint32_t side, const Vec3& out);
/// The sum of their products [cd/m2]; 0 where that is negative, because a luminance is not.
Rgb reflected_cd_m2(std::span<const FloatRgb> terms, std::span<const FloatRgb> factors);

}  // namespace stilb::estimators
