#include "io/image/white_balance.h"

#include <algorithm>
#include <cmath>

#include "lights/colour_temperature.h"

namespace stilb::io {
namespace {

constexpr double kOrdinaryShare = 0.9;

/// The mean colour, without the dominance of lamps.
Rgb mean_colour(const Picture& picture) {
    PictureLuminances luminances(picture);
    if (luminances.empty()) return Rgb::grey(1);
    const double bright = luminances.quantile(kOrdinaryShare);
    Rgb sum;
    for (const auto& [red, green, blue] : picture.rgb_cd_m2) {
        const Rgb rgb{{red, green, blue}};
        const double luminance = rgb.luminance();
        if (luminance > 0 && rgb.is_finite()) sum += rgb * std::min(1.0, bright / luminance);
    }
    return sum;
}

}  // namespace

PictureLuminances::PictureLuminances(const Picture& picture) {
    for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
        const double luminance = picture.luminance_cd_m2(i);
        if (luminance > 0 && std::isfinite(luminance)) values_.push_back(luminance);
    }
}

double PictureLuminances::quantile(double share) {
    const auto index = static_cast<std::ptrdiff_t>(share * static_cast<double>(values_.size() - 1));
    const auto nth = values_.begin() + index;
    std::nth_element(values_.begin(), nth, values_.end());
    return *nth;
}

Rgb choose_white(const Picture& picture, const scene::WhiteRange& whites) {
    const lights::ChromaticityUv warm = lights::chromaticity_of(whites.warmest);
    const lights::ChromaticityUv cool = lights::chromaticity_of(whites.coolest);
    const lights::ChromaticityUv mean = lights::chromaticity_of(mean_colour(picture));
    // Mixtures lie on the straight line between both.
    const double du = cool.u - warm.u, dv = cool.v - warm.v;
    constexpr double kRounding = 1e-9;  // far below what can be seen
    if (std::hypot(du, dv) < kRounding) return whites.warmest;
    const double along = ((mean.u - warm.u) * du + (mean.v - warm.v) * dv) / (du * du + dv * dv);
    const double share = std::clamp(along, 0.0, 1.0);
    return lights::colour_of({warm.u + share * du, warm.v + share * dv});
}

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Linear Rec. 709 to XYZ, white D65 [IEC 61966-2-1].
constexpr Matrix kToXyz{{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};
/// XYZ to sharpened cone responses.
constexpr Matrix kBradford{{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

constexpr Matrix product(const Matrix& a, const Matrix& b) {
    Matrix result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    }
    return result;
}

constexpr Matrix inverse(const Matrix& m) {
    Matrix cofactors{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            cofactors[i][j] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
        }
    }
    const double determinant =
        m[0][0] * cofactors[0][0] + m[0][1] * cofactors[0][1] + m[0][2] * cofactors[0][2];
    Matrix result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) result[i][j] = cofactors[j][i] / determinant;
    }
    return result;
}

std::array<double, 3> times(const Matrix& m, const Rgb& rgb) {
    std::array<double, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) result[i] = m[i][0] * rgb[0] + m[i][1] * rgb[1] + m[i][2] * rgb[2];
    return result;
}

constexpr Matrix kToCones = product(kBradford, kToXyz);
constexpr Matrix kFromCones = inverse(kToCones);

}  // namespace

ChromaticAdaptation::ChromaticAdaptation(const Rgb& white) {
    const std::array<double, 3> of_white = times(kToCones, white);
    const std::array<double, 3> of_screen = times(kToCones, Rgb::grey(white.luminance()));
    Matrix scaled = kToCones;
    for (std::size_t cone = 0; cone < 3; ++cone) {
        for (double& weight : scaled[cone]) weight *= of_screen[cone] / of_white[cone];
    }
    const Matrix whole = product(kFromCones, scaled);
    for (std::size_t i = 0; i < 3; ++i) rows_[i] = {whole[i]};
}

Rgb ChromaticAdaptation::operator()(const Rgb& rgb) const {
    Rgb result;
    for (std::size_t i = 0; i < 3; ++i) {
        const Rgb weighted = rows_[i] * rgb;
        result[i] = weighted[0] + weighted[1] + weighted[2];
    }
    return result;
}

}  // namespace stilb::io
