#include "io/import/luminaires.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stilb::io {
namespace {

constexpr int kSkyWidth = 720, kSkyHeight = 360;
constexpr double kDegrees = 180 / kPi;

/// The rotation that turns one unit vector to another, as a frame of the panorama.
Frame turned(const Vec3& from, const Vec3& to) {
    const Frame a = Frame::around(from), b = Frame::around(to);
    const auto image = [&](const Vec3& axis) { return b.to_world(a.to_local(axis)); };
    return {image({1, 0, 0}), image({0, 1, 0}), image({0, 0, 1})};
}

/// Solid angle of a pixel in a row from the top.
double pixel_sr(int row) {
    const auto z_of = [](int edge) { return std::cos(kPi * edge / kSkyHeight); };
    return 2 * kPi / kSkyWidth * (z_of(row) - z_of(row + 1));
}

std::size_t sky_pixel(int row, int column) {
    return static_cast<std::size_t>(row) * kSkyWidth + static_cast<std::size_t>(column);
}

}  // namespace

PhotometricSolid::Grid spot_grid(double inner_deg, double outer_deg) {
    constexpr int kSteps = 64;
    outer_deg = std::clamp(outer_deg, 0.1, 90.0);
    inner_deg = std::clamp(inner_deg, 0.0, outer_deg - 0.05);
    const double inner = std::cos(inner_deg / kDegrees), outer = std::cos(outer_deg / kDegrees);
    PhotometricSolid::Grid grid;
    grid.planes_deg = {0};
    const auto add = [&](double gamma_deg, double intensity_cd) {
        grid.polar_deg.push_back(gamma_deg);
        grid.intensity_cd.push_back(intensity_cd);
    };
    if (inner_deg > 0) add(0, 1);
    for (int i = 0; i <= kSteps; ++i) {
        const double gamma_deg = inner_deg + (outer_deg - inner_deg) * i / kSteps;
        const double share = (std::cos(gamma_deg / kDegrees) - outer) / (inner - outer);
        add(gamma_deg, i == kSteps ? 0 : std::min(share * share, 1.0));
    }
    constexpr double kHorizontal_deg = 90;  // LM-63 requires angles up to there
    if (outer_deg < kHorizontal_deg) add(kHorizontal_deg, 0);
    return grid;
}

lights::LuminaireFrame luminaire_frame(const Vec3& nadir, const Vec3& c0) {
    const Vec3 down = normalized(nadir);
    Vec3 across = c0 - dot(c0, down) * down;
    if (squared_length(across) < 1e-12 * squared_length(c0)) across = Frame::around(down).u;
    across = normalized(across);
    return {across, cross(-down, across), down};
}

EnvironmentLight distant_lights(const std::vector<DistantLight>& lights) {
    Panorama::Image image{kSkyWidth, kSkyHeight, {}};
    image.rgb_cd_m2.resize(static_cast<std::size_t>(kSkyWidth) * kSkyHeight);
    // The middle of the pixel that is left of the picture's middle and above it.
    constexpr int row_above = kSkyHeight / 2 - 1;
    const double azimuth = kPi / kSkyWidth, z = std::cos(kPi * row_above / kSkyHeight) / 2;
    const double r = std::sqrt(1 - z * z);
    const Vec3 middle{r * std::cos(azimuth), r * std::sin(azimuth), z};
    EnvironmentLight sky;
    sky.axes = turned(middle, lights.front().towards);
    for (const DistantLight& light : lights) {
        const Vec3 own = sky.axes.to_local(light.towards);
        const double across = 0.5 - std::atan2(own.y, own.x) / (2 * kPi);
        const double down = std::acos(std::clamp(own.z, -1.0, 1.0)) / kPi;
        const int column = std::clamp(static_cast<int>(across * kSkyWidth), 0, kSkyWidth - 1);
        const int row = std::clamp(static_cast<int>(down * kSkyHeight), 0, kSkyHeight - 1);
        auto& pixel = image.rgb_cd_m2[sky_pixel(row, column)];
        for (std::size_t b = 0; b < kBands; ++b)
            pixel[b] += static_cast<float>(light.illuminance_lx[b] / pixel_sr(row));
    }
    sky.panorama = std::make_shared<const Panorama>(std::move(image));
    return sky;
}

}  // namespace stilb::io
