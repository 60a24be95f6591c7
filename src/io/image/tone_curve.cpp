#include "io/image/tone_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "io/image/primaries.h"

namespace stilb::io {
namespace {

constexpr double kMiddleGrey = 0.18;
constexpr double kWhite = 8;
/// Two stops.
constexpr double kMostProtection = 4;
constexpr double kProtectedShare = 0.99;

std::uint8_t srgb_byte(double linear) {
    const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(encoded, 0.0, 1.0)));
}

/// Mixed with grey as far as all components need to be 0 to 1; the luminance stays.
Triple within_screen(const Triple& rgb, double luminance) {
    double share = 1;
    for (const double component : rgb) {
        if (component > 1) share = std::min(share, (1 - luminance) / (component - luminance));
        if (component < 0) share = std::min(share, luminance / (luminance - component));
    }
    Triple result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = luminance + share * (rgb[i] - luminance);
    return result;
}

}  // namespace

ToneCurve::ToneCurve(double exposure) : exposure_(exposure) {
    if (!(exposure > 0 && std::isfinite(exposure)))
        throw InputError(fmt::format("an exposure of {} shows nothing. Give a number above 0.", exposure));
}

std::string ToneCurve::description() const {
    return fmt::format("Reinhard 2002, white at {} / exposure", kWhite);
}

double ToneCurve::display_luminance(double luminance_cd_m2) const {
    if (!(luminance_cd_m2 > 0)) return 0;
    const double l = luminance_cd_m2 * exposure_;
    return l >= kWhite ? 1 : l * (1 + l / (kWhite * kWhite)) / (1 + l);
}

std::array<std::uint8_t, 3> ToneCurve::srgb(const std::array<float, 3>& rgb_cd_m2) const {
    const Rgb rgb{{rgb_cd_m2[0], rgb_cd_m2[1], rgb_cd_m2[2]}};
    const double luminance = rgb.luminance();
    const double shown = display_luminance(luminance);
    if (shown == 0) return {0, 0, 0};
    if (shown == 1) return {255, 255, 255};
    Triple display;
    for (std::size_t i = 0; i < 3; ++i) display[i] = rgb[i] * (shown / luminance);
    display = within_screen(display, shown);
    return {srgb_byte(display[0]), srgb_byte(display[1]), srgb_byte(display[2])};
}

double automatic_exposure(const Picture& picture) {
    std::vector<double> luminances;
    double sum_of_logarithms = 0;
    for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
        const double luminance = picture.luminance_cd_m2(i);
        if (!(luminance > 0 && std::isfinite(luminance))) continue;
        luminances.push_back(luminance);
        sum_of_logarithms += std::log(luminance);
    }
    if (luminances.empty()) return 1;
    const auto count = static_cast<double>(luminances.size());
    const double exposure = kMiddleGrey / std::exp(sum_of_logarithms / count);
    const auto nth = luminances.begin() + static_cast<std::ptrdiff_t>(kProtectedShare * (count - 1));
    std::nth_element(luminances.begin(), nth, luminances.end());
    return std::clamp(kWhite / *nth, exposure / kMostProtection, exposure);
}

}  // namespace stilb::io
