#include "lights/light.h"

#include <type_traits>

namespace stilb::lights {

Emitter make_emitter(const Light& light, const Surroundings& surroundings, const Lift& lift) {
    return std::visit(
        [&]<LightKind L>(const L& source) -> Emitter {
            return typename L::Emitter(source, surroundings, lift);
        },
        light.source);
}

LightLocation location_of(const Light& light) {
    return std::visit([]<LightKind L>(const L&) { return L::kLocation; }, light.source);
}

std::string_view type_of(const Light& light) {
    return std::visit([]<LightKind L>(const L&) { return L::kType; }, light.source);
}

Rgb flux_lm(const Light& light, const Surroundings& surroundings) {
    return std::visit([&](const auto& source) { return source.flux_lm(surroundings); }, light.source);
}

std::vector<LightDetail> details_of(const Light& light, const Surroundings& surroundings) {
    return std::visit([&](const auto& source) { return source.details(surroundings); }, light.source);
}

std::optional<ObjectId> emitting_object(const Light& light) {
    return std::visit(
        []<LightKind L>(const L& source) -> std::optional<ObjectId> {
            if constexpr (L::kLocation == LightLocation::surface) return source.object;
            return std::nullopt;
        },
        light.source);
}

std::optional<Rgb> mean_luminance_cd_m2(const Light& light, const Surroundings& surroundings) {
    return std::visit(
        [&]<LightKind L>(const L& source) -> std::optional<Rgb> {
            if constexpr (L::kLocation == LightLocation::surface)
                return source.mean_luminance_cd_m2(surroundings);
            return std::nullopt;
        },
        light.source);
}

std::optional<UniformEmission> uniform_emission(const Light& light) {
    return std::visit(
        []<LightKind L>(const L& source) -> std::optional<UniformEmission> {
            if constexpr (L::kLocation == LightLocation::surface && requires { source.luminance_cd_m2; })
                return UniformEmission{source.object, source.luminance_cd_m2};
            return std::nullopt;
        },
        light.source);
}

LightSource scaled(const LightSource& source, const Rgb& factor) {
    LightSource result = source;
    std::visit([&](auto& light) { light.scale(factor); }, result);
    return result;
}

const Luminaire* luminaire_of(const Light& light) {
    return std::visit(
        []<LightKind L>(const L& source) -> const Luminaire* {
            if constexpr (std::is_same_v<L, Luminaire>) return &source;
            if constexpr (requires { source.luminaire; }) return &source.luminaire;
            return nullptr;
        },
        light.source);
}

std::optional<ObjectId> opening_of(const Light& light) {
    return luminaire_of(light) ? emitting_object(light) : std::nullopt;
}

bool shine_alike(const Light& a, const Light& b) {
    return std::visit(
        [&]<LightKind L>(const L& source) {
            const auto* other = std::get_if<L>(&b.source);
            return other != nullptr && source.shines_like(*other);
        },
        a.source);
}

std::optional<LightOrigin> point_origin(const Light& light) {
    return std::visit(
        []<LightKind L>(const L& source) -> std::optional<LightOrigin> {
            if constexpr (L::kLocation == LightLocation::point) return source.origin();
            return std::nullopt;
        },
        light.source);
}

}  // namespace stilb::lights
