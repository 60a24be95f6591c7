#include "io/image/colour.h"

#include <cmath>

#include "base/rgb.h"

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

}  // namespace stilb::io
