
#include "io/image/tone_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/rgb.h"
#include "base/vec.h"
#include "lights/colour_temperature.h"
#include "stilb/error.h"

namespace stilb::io {

namespace {

double linear_from_encoded(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double encoded_from_linear(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace

Oklab to_oklab(const Colour& colour) {
    const double r = linear_from_encoded(colour.red);
    const double g = linear_from_encoded(colour.green);
    const double b = linear_from_encoded(colour.blue);
    const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Colour from_oklab(const Oklab& colour) {
    const double l = std::pow(colour.lightness + 0.3963377774 * colour.a + 0.2158037573 * colour.b, 3);
    const double m = std::pow(colour.lightness - 0.1055613458 * colour.a - 0.0638541728 * colour.b, 3);
    const double s = std::pow(colour.lightness - 0.0894841775 * colour.a - 1.2914855480 * colour.b, 3);
    return {encoded_from_linear(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
            encoded_from_linear(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
            encoded_from_linear(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

double distance(const Oklab& first, const Oklab& second) {
    return std::hypot(first.lightness - second.lightness, first.a - second.a, first.b - second.b);
}

Colour readable_on(const Colour& background) {
    const double luminance = kLuminanceWeights[0] * linear_from_encoded(background.red) +
                             kLuminanceWeights[1] * linear_from_encoded(background.green) +
                             kLuminanceWeights[2] * linear_from_encoded(background.blue);
    // Contrast is (brighter + 0.05) / (darker + 0.05): black wins where its own exceeds white's.
    constexpr double kFlare = 0.05;
    const bool black_is_better = (luminance + kFlare) * (luminance + kFlare) > kFlare * (1 + kFlare);
    return black_is_better ? grey(0) : grey(1);
}

namespace {

// The curve.
constexpr double kLinearEnd = 0.5;
constexpr double kWhite = 8;

// The automatic exposure.
constexpr double kBrightShare = 0.9;
constexpr double kBright = 0.65, kBrightest = 4;
constexpr double kDarkestMedian = 0.12, kBrightestMedian = 0.36;

std::uint8_t byte_of(double encoded) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(encoded, 0.0, 1.0)));
}

std::uint8_t srgb_byte(double linear) {
    return byte_of(linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

/// Mixes the colour with grey until all components are within 0 to 1; the luminance stays.
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

ToneCurve::ToneCurve(double exposure, const Rgb& white)
    : exposure_(exposure), white_(white), adapted_(white) {
    if (!(exposure > 0 && std::isfinite(exposure)))
        throw InputError(fmt::format("exposure {}: expected a number above 0", exposure));
}

std::string ToneCurve::description() const {
    return fmt::format("linear to {} / exposure, then Reinhard 2002, white at {} / exposure", kLinearEnd,
                       kWhite);
}

double ToneCurve::white_k() const { return lights::correlated_temperature(white_).temperature_k; }

double ToneCurve::display_luminance(double luminance_cd_m2) const {
    if (!(luminance_cd_m2 > 0)) return 0;
    const double x = luminance_cd_m2 * exposure_;
    if (x >= kWhite) return 1;
    if (x <= kLinearEnd) return x;
    // In units of the shoulder's height.
    constexpr double kRange = (kWhite - kLinearEnd) / (1 - kLinearEnd);
    const double l = (x - kLinearEnd) / (1 - kLinearEnd);
    return kLinearEnd + (1 - kLinearEnd) * l * (1 + l / (kRange * kRange)) / (1 + l);
}

std::array<std::uint8_t, 3> ToneCurve::srgb(const std::array<float, 3>& rgb_cd_m2) const {
    const Rgb rgb{{rgb_cd_m2[0], rgb_cd_m2[1], rgb_cd_m2[2]}};
    const double luminance = rgb.luminance();
    const double shown = display_luminance(luminance);
    if (shown == 0) return {0, 0, 0};
    if (shown == 1) return {255, 255, 255};
    Rgb balanced = adapted_(rgb);
    if (!(balanced.luminance() > 0)) balanced = Rgb::grey(1);  // a colour far outside of Rec. 709
    const double scale = shown / balanced.luminance();
    Triple display;
    for (std::size_t i = 0; i < 3; ++i) display[i] = balanced[i] * scale;
    display = within_screen(display, shown);
    return {srgb_byte(display[0]), srgb_byte(display[1]), srgb_byte(display[2])};
}

double automatic_exposure(const Picture& picture) {
    PictureLuminances luminances(picture);
    if (luminances.empty()) return 1;
    const double median = luminances.quantile(0.5);
    const double bright = luminances.quantile(kBrightShare);
    const double exposure = std::clamp(kBright / bright, kDarkestMedian / median, kBrightestMedian / median);
    return std::min(exposure, kBrightest / bright);
}

ToneCurve tone_curve_for(const Picture& picture, const ToneOptions& options) {
    return ToneCurve(options.exposure ? *options.exposure : automatic_exposure(picture),
                     choose_white(picture, options.white));
}

namespace {

Vec3 xyz_of(const std::array<double, 2>& xy) { return {xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1]}; }

/// Components of `v` along three vectors, by Cramer's rule.
Vec3 components(const std::array<Vec3, 3>& basis, const Vec3& v) {
    const double volume = dot(basis[0], cross(basis[1], basis[2]));
    return Vec3{dot(v, cross(basis[1], basis[2])), dot(basis[0], cross(v, basis[2])),
                dot(basis[0], cross(basis[1], v))} /
           volume;
}

/// XYZ of one unit of each primary, where one unit of all is white with luminance 1.
std::array<Vec3, 3> basis_of(const Primaries& primaries) {
    std::array<Vec3, 3> basis{xyz_of(primaries[0]), xyz_of(primaries[1]), xyz_of(primaries[2])};
    const Vec3 shares = components(basis, xyz_of(primaries[3]));
    for (std::size_t i = 0; i < 3; ++i) basis[i] = shares[i] * basis[i];
    return basis;
}

}  // namespace

bool are_usable(const Primaries& primaries) {
    for (const auto& [x, y] : primaries) {
        // The blue of ACES (SMPTE ST 2065-1) lies below 0.
        if (!(std::abs(x) <= 10 && std::abs(y) >= 1e-3 && std::abs(y) <= 10)) return false;
    }
    const std::array<Vec3, 3> basis{xyz_of(primaries[0]), xyz_of(primaries[1]), xyz_of(primaries[2])};
    if (!(std::abs(dot(basis[0], cross(basis[1], basis[2]))) > 1e-6)) return false;
    // The luminances of the primaries in white. Divided by y, they are the amounts of the primaries.
    const Vec3 shares = components(basis, xyz_of(primaries[3]));
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(shares[i] / primaries[i][1] > 1e-6)) return false;
    }
    return primaries[3][1] > 0;
}

PrimariesConversion::PrimariesConversion(const Primaries& from, const Primaries& to) {
    const Vec3 old_white = xyz_of(from[3]);
    const Vec3 new_white = xyz_of(to[3]);
    const std::array<Vec3, 3> new_basis = basis_of(to);
    const std::array<Vec3, 3> old_basis = basis_of(from);
    for (std::size_t column = 0; column < 3; ++column) {
        const Vec3& xyz = old_basis[column];
        const Vec3 adapted{xyz.x * new_white.x / old_white.x, xyz.y, xyz.z * new_white.z / old_white.z};
        const Vec3 rgb = components(new_basis, adapted);
        for (std::size_t row = 0; row < 3; ++row) rows_[row][column] = rgb[row];
    }
}

Triple PrimariesConversion::operator()(const Triple& rgb) const {
    Triple result{};
    for (std::size_t row = 0; row < 3; ++row) {
        result[row] = rows_[row][0] * rgb[0] + rows_[row][1] * rgb[1] + rows_[row][2] * rgb[2];
    }
    return result;
}

std::array<std::uint8_t, 3> bytes_of(const Colour& colour) {
    return {byte_of(colour.red), byte_of(colour.green), byte_of(colour.blue)};
}

}  // namespace stilb::io
