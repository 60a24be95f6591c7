// Colours for drawing, and OKLab, in which equal distances look equally different.
#pragma once

namespace stilb::io {

/// sRGB, gamma-encoded, 0 to 1; alpha 1 is opaque.
struct Colour {
    double red = 0, green = 0, blue = 0, alpha = 1;
};

constexpr Colour grey(double level) { return {level, level, level, 1}; }
constexpr Colour with_alpha(Colour colour, double alpha) {
    colour.alpha = alpha;
    return colour;
}

/// [Ottosson 2020, A perceptual color space for image processing]: lightness 0 (black) to 1 (white).
struct Oklab {
    double lightness = 0, a = 0, b = 0;
};

Oklab to_oklab(const Colour& colour);

/// Components may leave 0 to 1 where sRGB does not have the colour.
Colour from_oklab(const Oklab& colour);

double distance(const Oklab& first, const Oklab& second);

/// Black or white, whichever has more contrast with `background` [W3C, WCAG 2.1]; at least 4.5 : 1.
Colour readable_on(const Colour& background);

}  // namespace stilb::io
