#include "materials/glazing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace stilb::materials {
namespace {

constexpr double kClearIor = 1.52;
/// Glass that transmits less along the normal has the shape of bronze glass.
constexpr double kClear = 0.645;

double polynomial(const std::array<double, 5>& coefficients, double x) {
    double sum = 0;
    for (std::size_t i = coefficients.size(); i-- > 0;) sum = sum * x + coefficients[i];
    return sum;
}

/// The shapes over the cosine: 1 and 0 along the normal.
struct Shape {
    std::array<double, 5> transmitted, sent_on;  ///< of which the second is the sum of both

    double transmittance(double cosine) const {
        return std::clamp(polynomial(transmitted, cosine) / polynomial(transmitted, 1), 0.0, 1.0);
    }
    double reflectance(double cosine) const {
        const auto raw = [&](double c) { return polynomial(sent_on, c) - polynomial(transmitted, c); };
        return std::clamp((raw(cosine) - raw(1)) / (1 - raw(1)), 0.0, 1.0);
    }
};
constexpr Shape kClearGlass{{-0.0015, 3.355, -3.840, 1.460, 0.0288}, {0.999, -0.563, 2.043, -2.532, 1.054}};
constexpr Shape kBronzeGlass{{-0.002, 2.813, -2.341, -0.05725, 0.599}, {0.997, -1.868, 6.513, -7.862, 3.225}};

const Shape& shape_of(double transmittance) { return transmittance > kClear ? kClearGlass : kBronzeGlass; }

double degrees_of(double cosine) { return std::acos(std::clamp(cosine, 0.0, 1.0)) * (180 / kPi); }

/// The pane that transmits so much along the normal: T = (1-r)^2 a / (1 - r^2 a^2).
ThinDielectric pane_of(const Rgb& transmittance) {
    const double r = fresnel_reflectance(1, kClearIor).unpolarised(), through = (1 - r) * (1 - r);
    ThinDielectric pane{kClearIor, {}};
    for (std::size_t b = 0; b < kBands; ++b) {
        const double t = transmittance[b];
        pane.internal_transmittance[b] =
            std::min(2 * t / (through + std::sqrt(through * through + 4 * r * r * t * t)), 1.0);
    }
    return pane;
}

}  // namespace

std::optional<std::string> Glazing::Parameters::contradiction() const {
    const bool has_shares = transmittance.is_given() || reflectance.is_given() || back_reflectance.is_given();
    if (visible_transmittance.is_given()) {
        if (has_shares)
            return "visible_transmittance says all of an uncoated pane. Leave it out beside other shares.";
        if (!visible_transmittance.is_along_normal())
            return "visible_transmittance is that along the normal. A table over the angle is a "
                   "transmittance.";
        return std::nullopt;
    }
    if (!transmittance.is_given() || !reflectance.is_given())
        return "visible_transmittance, or transmittance and reflectance, are missing.";
    const Glazing glazing(*this);
    for (int degrees = 0; degrees <= 90; ++degrees) {
        const double cosine = std::cos(degrees * kPi / 180);
        for (const LightSide side : {LightSide::outside, LightSide::inside}) {
            const double sum =
                (glazing.straight_transmittance(cosine) + glazing.reflectance(side, cosine)).max();
            constexpr double rounding = 1e-9;
            if (sum <= 1 + rounding) continue;
            return fmt::format(
                "at {} degrees, transmittance and {} are {} together: no glass sends on more light than it "
                "receives.",
                degrees, side == LightSide::outside ? "reflectance" : "back_reflectance", sum);
        }
    }
    return std::nullopt;
}

Glazing::Glazing(const Parameters& parameters) : parameters_(parameters) {
    if (parameters.visible_transmittance.is_given())
        pane_ = pane_of(parameters.visible_transmittance.rows[0].share);
}

ThinDielectric Glazing::uncoated() const {
    if (pane_) return *pane_;
    Rgb transmittance = straight_transmittance(1);
    for (double& band : transmittance.band) band = std::min(band, kVisibleTransmittance.max);
    return pane_of(transmittance);
}

Rgb Glazing::straight_transmittance(double cosine) const {
    if (pane_) return pane_->straight_transmittance(cosine);
    const SharesByAngle& shares = parameters_.transmittance;
    if (!shares.is_along_normal()) return shares.at(degrees_of(cosine));
    const Rgb& normal = shares.rows[0].share;
    return normal * shape_of(normal.luminance()).transmittance(cosine);
}

Rgb Glazing::reflectance(LightSide side, double cosine) const {
    if (pane_) return pane_->shares(cosine).reflectance;
    const bool is_back = side == LightSide::inside && parameters_.back_reflectance.is_given();
    const SharesByAngle& shares = is_back ? parameters_.back_reflectance : parameters_.reflectance;
    if (!shares.is_along_normal()) return shares.at(degrees_of(cosine));
    // From the normal's value to 1 along the surface.
    const double rise = shape_of(straight_transmittance(1).luminance()).reflectance(cosine);
    return shares.rows[0].share * (1 - rise) + Rgb::grey(rise);
}

}  // namespace stilb::materials
