// The interface of material models: their parameters, listed once, and their reflection.
//
// A model is either Scattering (it has a BRDF, which connections evaluate and walks sample), or Specular
// (light continues along a few directions, and nothing can be connected to it), or Composed of lobes, each of
// which is a material of one of the first two kinds. Its parameters are its own
// members, or those of its `Parameters` where it keeps tables computed from them. Directions are unit
// vectors in the local frame of the surface (Frame::of_surface), z along the normal on the side where light
// arrives, and point away from the surface; models get only directions with z > 0.
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

/// The message where two shares of reflected light contradict each other.
std::optional<std::string> contradiction_of_shares(const Rgb& diffuse, const Rgb& specular,
                                                   std::string_view shares = "diffuse + specular");

/// BRDF, and the density of a direction, for one pair of directions.
struct ScatterValue {
    Rgb brdf_per_sr;
    double pdf_per_sr = 0;
};

/// A scattered direction and the weight of its light: weight = f cos(theta_out) / pdf.
struct ScatterSample {
    Vec3 direction;
    Rgb weight;
    double pdf_per_sr = 0;
};

/// The side from which light meets the surface: a solid's outside is where its normals point.
enum class LightSide { outside, inside };

/// The quantity carried by a path: luminance from the camera, or the flux of particles. Bent surfaces
/// treat them differently, so that both give the same light.
enum class Carried { luminance, flux };

/// One branch of the light at a specular surface.
struct SpecularBranch {
    Vec3 direction;  ///< unit, in the frame of `in`; below the surface for transmitted light
    Rgb share;       ///< of the flux
    /// Luminance L, the quantity that paths from a sensor carry, is `share` times this factor of its value on
    /// the other side: refraction preserves L / n^2 and flux. With `in` as the direction from which the path
    /// came: (n of the side of `in` / n of the side of `direction`)^2; 1 in reflection.
    double luminance_factor = 1;
};

struct Lobe;

/// At most three branches, none of them dark.
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

/// The mirror direction.
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
    // Samples a direction in which light from `in` is scattered, by two numbers in [0, 1); nothing where
    // it is absorbed.
    { model.sample(in, u, u) } -> std::same_as<std::optional<ScatterSample>>;
    // The density with which sample(in) draws `out`.
    { model.pdf_per_sr(in, out) } -> std::same_as<double>;
    // brdf_per_sr(in, out) and pdf_per_sr(out, in), bit by bit: the values for next-event estimation if a
    // walk came from `out`.
    { model.evaluate(in, out) } -> std::same_as<ScatterValue>;
    // As mean_concentration() of material.h.
    { model.concentration() } -> std::same_as<double>;
};

template <typename M>
concept Specular = requires(const M& model, LightSide side, const Vec3& in) {
    // The branches of light that meets the surface from `in`, on this side.
    { model.branches(side, in) } -> std::same_as<SpecularBranches>;
};

template <typename M>
concept Composed = requires(const M& model, LightSide side, Carried carried) {
    // As lobes() of material.h.
    { model.lobes(side, carried) } -> std::same_as<std::span<const Lobe>>;
};

/// The interface of every alternative of Material.
template <typename M>
concept Model = Described<M> &&(Scattering<M> || Specular<M> || Composed<M>)&&requires(const M& model) {
    // As the function of material.h.
    { model.reflectance_bound() } -> std::same_as<Rgb>;
};

/// A Specular model that transmits light straight, as shadow rays do.
template <typename M>
concept PassesStraight = Specular<M> && requires(const M& model, double cosine) {
    // Share of the flux, of light at an angle of this cosine to the normal.
    { model.straight_transmittance(cosine) } -> std::same_as<Rgb>;
};

/// Constructs the model from these parameters after checking them, because its tables depend on them. Throws
/// like validate() of material.h.
template <Model M>
M make(const ParametersOf<M>& parameters, std::string_view path) {
    validate_fields(parameters, path);
    return M(parameters);
}

/// BRDF [1/sr] of one model: 0 for directions below the surface and for specular models. A loop over many
/// directions so chooses the model outside.
template <Model M>
Rgb evaluate_brdf_per_sr([[maybe_unused]] const M& model, [[maybe_unused]] const Vec3& in,
                         [[maybe_unused]] const Vec3& out) {
    if constexpr (Scattering<M>) {
        return in.z > 0 && out.z > 0 ? model.brdf_per_sr(in, out) : Rgb{};
    } else {
        return {};
    }
}

/// The mean of pi f / albedo at normal incidence over the reflected light: 1 for a diffuse material, large
/// for a narrow lobe, 0 where nothing is reflected. By an even grid of samples; accurate to a few per cent.
/// For models without a closed expression.
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
