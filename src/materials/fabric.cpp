#include "materials/fabric.h"

namespace stilb::materials {

std::optional<std::string> Fabric::Parameters::contradiction() const {
    if (const auto message =
            contradiction_of_shares(reflectance, transmittance, "reflectance + transmittance"))
        return message;
    if (transmittance.min() >= openness) return std::nullopt;
    return "its openness exceeds its transmittance, which includes the light that passes through the holes.";
}

Fabric::Fabric(const Parameters& parameters) : parameters_(parameters) {
    const auto& [openness, transmittance, reflectance] = parameters;
    const Rgb scattered = transmittance + Rgb::grey(-openness);
    if (reflectance.max() > 0) lobes_.push_back({Diffuse{reflectance}, false});
    if (scattered.max() > 0) lobes_.push_back({Diffuse{scattered}, true});
    if (openness > 0) lobes_.push_back({Straight{Rgb::grey(openness), openness}, false});
}

}  // namespace stilb::materials
