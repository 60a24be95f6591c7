#include "materials/material.h"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "materials/model_list.h"

namespace stilb::materials {
namespace {

/// Stops the compiler at the first alternative that is no Model, and lets it name what is missing.
template <typename M>
consteval bool is_model() {
    static_assert(Described<M>);
    if constexpr (requires { &M::branches; }) {
        static_assert(Specular<M>);
    } else {
        static_assert(Scattering<M>);
    }
    static_assert(Model<M>);
    return true;
}
template <typename... Models>
consteval bool are_models(std::type_identity<std::tuple<Models...>>) {
    return (is_model<Models>() && ...);
}
static_assert(are_models(std::type_identity<ModelList>{}));

}  // namespace

Material::Material() : Material(Diffuse{}) {}

std::optional<std::string> contradiction_of_shares(const Rgb& diffuse, const Rgb& specular) {
    constexpr double rounding = 1e-12;  // 0.7 + 0.3 need not be 1 to the last bit
    const double largest = (diffuse + specular).max();
    if (largest <= 1 + rounding) return std::nullopt;
    return fmt::format(
        "diffuse + specular is {}: no surface reflects more light than it receives. Allowed: at most 1 in "
        "each channel.",
        largest);
}

std::vector<std::string_view> type_names() {
    std::vector<std::string_view> names;
    for_each_model([&]<typename M>() { names.push_back(M::kType); });
    return names;
}

std::string_view type_name(const Material& material) {
    return visit_model([]<typename M>(const M&) { return M::kType; }, material);
}

Rgb evaluate_brdf_per_sr(const Material& material, const Vec3& in, const Vec3& out) {
    return visit_model([&](const auto& model) { return evaluate_brdf_per_sr(model, in, out); }, material);
}

std::optional<ScatterSample> sample_brdf(const Material& material, const Vec3& in, double u1, double u2) {
    if (in.z <= 0) return std::nullopt;
    return visit_model(
        [&]<typename M>(const M& model) -> std::optional<ScatterSample> {
            if constexpr (Scattering<M>) return model.sample(in, u1, u2);
            return std::nullopt;
        },
        material);
}

double pdf_per_sr(const Material& material, const Vec3& in, const Vec3& out) {
    if (in.z <= 0 || out.z <= 0) return 0;
    return visit_model(
        [&]<typename M>(const M& model) -> double {
            if constexpr (Scattering<M>) return model.pdf_per_sr(in, out);
            return 0;
        },
        material);
}

ScatterValue evaluate_and_pdf(const Material& material, const Vec3& in, const Vec3& out) {
    if (in.z <= 0 || out.z <= 0) return {};
    return visit_model(
        [&]<typename M>(const M& model) -> ScatterValue {
            if constexpr (Scattering<M>) return model.evaluate(in, out);
            return {};
        },
        material);
}

bool is_specular(const Material& material) {
    return visit_model([]<typename M>(const M&) { return Specular<M>; }, material);
}

SpecularBranches specular_branches(const Material& material, LightSide side, const Vec3& in) {
    if (in.z <= 0) return {};
    return visit_model(
        [&]<typename M>(const M& model) -> SpecularBranches {
            if constexpr (Specular<M>) return model.branches(side, in);
            return {};
        },
        material);
}

bool transmits(const Material& material) {
    const auto branches = specular_branches(material, LightSide::outside, {0, 0, 1});
    return std::ranges::any_of(branches.list(), [](const auto& branch) { return branch.direction.z < 0; });
}

bool passes_straight(const Material& material) {
    return visit_model([]<typename M>(const M&) { return PassesStraight<M>; }, material);
}

Rgb straight_transmittance(const Material& material, double cosine) {
    return visit_model(
        [&]<typename M>(const M& model) -> Rgb {
            if constexpr (PassesStraight<M>) return model.straight_transmittance(cosine);
            return {};
        },
        material);
}

double mean_concentration(const Material& material) {
    return visit_model(
        []<typename M>(const M& model) -> double {
            if constexpr (Scattering<M>) return model.concentration();
            return 0;
        },
        material);
}

Rgb reflectance_bound(const Material& material) {
    return visit_model([](const auto& model) { return model.reflectance_bound(); }, material);
}

Rgb stated_reflectance(const Material& material) {
    if (!is_specular(material)) return reflectance_bound(material);
    Rgb sum;
    const SpecularBranches branches = specular_branches(material, LightSide::outside, {0, 0, 1});
    for (const SpecularBranch& branch : branches.list()) {
        if (branch.direction.z > 0) sum += branch.share;
    }
    return sum;
}

void validate(const Material& material, std::string_view path) {
    visit_model([&](const auto& model) { validate_fields(parameters_of(model), path); }, material);
}

}  // namespace stilb::materials
