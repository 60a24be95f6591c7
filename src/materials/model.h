// What a material model is: its parameters, listed once, and how it reflects.
//
// A model is either Scattering (it has a BRDF, which connections evaluate and walks sample) or Specular
// (light goes on along a few directions, and nothing can be connected to it). Its parameters are its own
// members, or those of its `Parameters` where it keeps tables that are made of them. Directions are unit
// vectors in the local frame of the surface (Frame::of_surface), z along the normal on the side that light
// arrives on, and point away from the surface; models get such with z > 0 only.
#pragma once

#include <array>
#include <concepts>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>

#include "base/field.h"
#include "base/rgb.h"
#include "base/vec.h"

namespace stilb::materials {

inline constexpr Range kReflectance{0, 1, "from 0 to 1 (no surface reflects more light than it receives)"};
inline constexpr Range kRoughness{0.001, 1, "from 0.001 to 1 (a mirror has type \"mirror\")"};
inline constexpr Range kIor{1, 4, "from 1 to 4 (1.5 is common)"};

/// What is wrong with two shares of the light that are reflected at once.
std::optional<std::string> contradiction_of_shares(const Rgb& diffuse, const Rgb& specular);

/// BRDF, and the density of a direction, of one pair of directions.
struct ScatterValue {
    Rgb brdf_per_sr;
    double pdf_per_sr = 0;
};

/// A scattered direction and what the light is multiplied by: weight = f cos(theta_out) / pdf.
struct ScatterSample {
    Vec3 direction;
    Rgb weight;
    double pdf_per_sr = 0;
};

/// From which side light comes to the surface: a solid's outside is where its normals point.
enum class LightSide { outside, inside };

/// One of the ways that light goes on.
struct SpecularBranch {
    Vec3 direction;  ///< unit, in the frame of `in`; below the surface where light goes through
    Rgb share;       ///< of the flux
    /// Luminance L, the quantity that paths from a sensor carry, is `share` times this of what it is on the
    /// other side: L / n^2 is kept in refraction, flux is kept as it is. With `in` as the direction that the
    /// path came by: (n of the side of `in` / n of the side of `direction`)^2; 1 in reflection.
    double luminance_factor = 1;
};

/// At most three, none of them dark.
class SpecularBranches {
  public:
    void add(const SpecularBranch& branch) {
        if (branch.share.max() > 0) branches_[count_++] = branch;
    }
    std::span<const SpecularBranch> list() const { return {branches_.data(), count_}; }

  private:
    std::array<SpecularBranch, 3> branches_;
    std::size_t count_ = 0;
};

/// The direction of a mirror's reflection.
constexpr Vec3 mirrored(const Vec3& in) { return {-in.x, -in.y, in.z}; }

/// The type that lists a model's parameters.
template <typename M>
struct ParametersOfModel {
    using Type = M;
};
template <typename M>
requires requires { typename M::Parameters; }
struct ParametersOfModel<M> {
    using Type = typename M::Parameters;
};
template <typename M>
using ParametersOf = typename ParametersOfModel<M>::Type;

template <typename M>
const ParametersOf<M>& parameters_of(const M& model) {
    if constexpr (std::same_as<ParametersOf<M>, M>) {
        return model;
    } else {
        return model.parameters();
    }
}

/// kType is the model's name in scene files.
template <typename M>
concept Described = requires(const M& model) {
    { M::kType } -> std::convertible_to<std::string_view>;
    ParametersOf<M>::fields();
    { parameters_of(model) } -> std::same_as<const ParametersOf<M>&>;
}
&&std::default_initializable<ParametersOf<M>>&& std::constructible_from<M, ParametersOf<M>>;

template <typename M>
concept Scattering = requires(const M& model, const Vec3& in, const Vec3& out, double u) {
    // Reciprocal.
    { model.brdf_per_sr(in, out) } -> std::same_as<Rgb>;
    // A direction that light which comes from `in` is scattered to, by two numbers in [0, 1); nothing where
    // it is absorbed.
    { model.sample(in, u, u) } -> std::same_as<std::optional<ScatterSample>>;
    // The density with which sample(in) draws `out`.
    { model.pdf_per_sr(in, out) } -> std::same_as<double>;
    // brdf_per_sr(in, out) and pdf_per_sr(out, in), to the last bit: what next-event estimation needs where a
    // walk came from `out`.
    { model.evaluate(in, out) } -> std::same_as<ScatterValue>;
    // As mean_concentration() of material.h.
    { model.concentration() } -> std::same_as<double>;
};

template <typename M>
concept Specular = requires(const M& model, LightSide side, const Vec3& in) {
    // Where light that comes to the surface from `in`, on this side, goes on.
    { model.branches(side, in) } -> std::same_as<SpecularBranches>;
};

/// What every alternative of Material has.
template <typename M>
concept Model = Described<M> &&(Scattering<M> || Specular<M>)&&requires(const M& model) {
    // As the function of material.h.
    { model.reflectance_bound() } -> std::same_as<Rgb>;
};

/// A Specular model that lets light go straight on, which shadow rays do as well.
template <typename M>
concept PassesStraight = Specular<M> && requires(const M& model, double cosine) {
    // Share of the flux, of light at an angle of this cosine to the normal.
    { model.straight_transmittance(cosine) } -> std::same_as<Rgb>;
};

/// pi f / albedo at normal incidence, averaged over the reflected light: 1 for a diffuse material, large for
/// a narrow lobe, 0 where nothing is reflected. By an even grid of samples; to a few per cent. For models
/// without a closed expression.
template <typename M>
double concentration_at_normal_incidence(const M& model) {
    constexpr int kSteps = 96;
    const Vec3 in{0, 0, 1};
    double reflected = 0, squared = 0;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const auto sample = model.sample(in, (i + 0.5) / kSteps, (j + 0.5) / kSteps);
            if (!sample) continue;
            const double weight = sample->weight.luminance() / (kSteps * kSteps);
            reflected += weight;
            squared += weight * std::numbers::pi * model.brdf_per_sr(in, sample->direction).luminance();
        }
    }
    return reflected > 0 ? squared / (reflected * reflected) : 0;
}

}  // namespace stilb::materials
