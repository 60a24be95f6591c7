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
    } else if constexpr (requires { &M::lobes; }) {
        static_assert(Composed<M>);
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

std::optional<std::string> contradiction_of_shares(const Rgb& diffuse, const Rgb& specular,
                                                   std::string_view shares) {
    constexpr double rounding = 1e-12;  // 0.7 + 0.3 need not be 1 to the last bit
    const double largest = (diffuse + specular).max();
    if (largest <= 1 + rounding) return std::nullopt;
    return fmt::format(
        "{} is {}: no surface reflects more light than it receives. Allowed: at most 1 in each channel.",
        shares, largest);
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

std::span<const Lobe> lobes(const Material& material, LightSide side, Carried carried) {
    return visit_model(
        [&]<typename M>(const M& model) -> std::span<const Lobe> {
            if constexpr (Composed<M>) return model.lobes(side, carried);
            return {};
        },
        material);
}

bool is_composed(const Material& material) {
    return visit_model([]<typename M>(const M&) { return Composed<M>; }, material);
}

Rgb sent_on(const Material& material, double cosine) {
    return visit_model(
        [&]<typename M>(const M& model) {
            if constexpr (requires { model.sent_on(cosine); }) {
                return Rgb::grey(model.sent_on(cosine));
            } else {
                return model.reflectance_bound();
            }
        },
        material);
}

bool transmits(const Material& material) {
    const auto through = lobes(material, LightSide::outside, Carried::flux);
    if (std::ranges::any_of(through,
                            [](const Lobe& lobe) { return lobe.crosses || transmits(lobe.scattering); }))
        return true;
    const auto branches = specular_branches(material, LightSide::outside, {0, 0, 1});
    return std::ranges::any_of(branches.list(), [](const auto& branch) { return branch.direction.z < 0; });
}

bool scatters_through(const Material& material) {
    return std::ranges::any_of(lobes(material, LightSide::outside, Carried::flux), &Lobe::crosses);
}

bool passes_straight(const Material& material) {
    const auto of = lobes(material, LightSide::outside, Carried::flux);
    return visit_model([]<typename M>(const M&) { return PassesStraight<M>; }, material) ||
           std::ranges::any_of(of, passes_straight, &Lobe::scattering);
}

Rgb straight_transmittance(const Material& material, double cosine) {
    return visit_model(
        [&]<typename M>(const M& model) -> Rgb {
            Rgb sum;
            if constexpr (PassesStraight<M>) sum = model.straight_transmittance(cosine);
            if constexpr (Composed<M>) {
                for (const Lobe& lobe : model.lobes(LightSide::outside, Carried::flux))
                    sum += straight_transmittance(lobe.scattering, cosine);
            }
            return sum;
        },
        material);
}

double mean_concentration(const Material& material) {
    return visit_model(
        []<typename M>(const M& model) -> double {
            double largest = 0;
            if constexpr (Scattering<M>) largest = model.concentration();
            if constexpr (Composed<M>) {
                for (const LightSide side : {LightSide::outside, LightSide::inside}) {
                    for (const Lobe& lobe : model.lobes(side, Carried::flux))
                        largest = std::max(largest, mean_concentration(lobe.scattering));
                }
            }
            return largest;
        },
        material);
}

Rgb reflectance_bound(const Material& material) {
    return visit_model([](const auto& model) { return model.reflectance_bound(); }, material);
}

Rgb stated_reflectance(const Material& material) {
    Rgb sum;
    const auto parts = lobes(material, LightSide::outside, Carried::flux);
    for (const Lobe& lobe : parts) {
        if (!lobe.crosses) sum += stated_reflectance(lobe.scattering);
    }
    if (!parts.empty()) return sum;
    if (!is_specular(material)) return reflectance_bound(material);
    const SpecularBranches branches = specular_branches(material, LightSide::outside, {0, 0, 1});
    for (const SpecularBranch& branch : branches.list()) {
        if (branch.direction.z > 0) sum += branch.share;
    }
    return sum;
}

std::optional<std::string> contradiction_of_sides(const Material& front, const Material& back) {
    if (!transmits(front) && !transmits(back)) return std::nullopt;
    const auto transmits_alike = visit_model(
        [&]<typename M>(const M& model) -> std::optional<bool> {
            const M* other = back.get_if<M>();
            if constexpr (requires { model.parameters().transmits_as(model.parameters()); }) {
                if (other) return model.parameters().transmits_as(other->parameters());
            }
            return std::nullopt;
        },
        front);
    if (!transmits_alike) {
        return fmt::format(
            "\"{}\" and \"{}\" cannot be the sides of one surface: of the materials that let light through, "
            "translucent ones and fabrics have a back, of the same type.",
            type_name(front), type_name(back));
    }
    if (*transmits_alike) return std::nullopt;
    return "both sides transmit the same share of the light: only the reflectance may differ.";
}

void validate(const Material& material, std::string_view path) {
    visit_model([&](const auto& model) { validate_fields(parameters_of(model), path); }, material);
}

}  // namespace stilb::materials
