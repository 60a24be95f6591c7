#include "lights/sky/sky_discs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace stilb::lights {
namespace {

constexpr double kRadPerDeg = kPi / 180;
constexpr int kLeastHeight = 256, kMostHeight = 1024;
constexpr int kSamples = 4;  ///< along each side of a pixel
constexpr double kSmallDeg = 5;

double solid_angle_sr(double angle_deg) {
    const double half = std::min(angle_deg / 2, 180.0) * kRadPerDeg;
    return 4 * kPi * std::sin(half / 2) * std::sin(half / 2);
}

double factor_towards(const SkyDisc& disc, const Vec3& w) { return disc.factor ? disc.factor(w) : 1; }

/// The panorama of discs, in the frame of the scene.
class DiscPainter {
  public:
    explicit DiscPainter(const std::vector<SkyDisc>& discs) : discs_(discs) {
        double smallest_deg = 360;
        for (const SkyDisc& disc : discs) {
            drawings_.push_back(
                {normalized(disc.towards), std::cos(std::min(disc.angle_deg / 2, 180.0) * kRadPerDeg), {}});
            smallest_deg = std::min(smallest_deg, disc.angle_deg);
        }
        constexpr double pixels_across = 6;
        const double wanted = 180 / smallest_deg * pixels_across;
        image_.height = static_cast<int>(std::clamp(wanted, double{kLeastHeight}, double{kMostHeight}));
        image_.width = 2 * image_.height;
        image_.rgb_cd_m2.resize(pixel_at(image_.height, 0));
    }

    Panorama::Image paint() && {
        for (int row = 0; row < image_.height; ++row) {
            for (int column = 0; column < image_.width; ++column) find_discs(row, column);
        }
        for (std::size_t i = 0; i < discs_.size(); ++i) draw(discs_[i], drawings_[i]);
        return std::move(image_);
    }

  private:
    /// The pixels of a disc, each with its mean factor there times the share of the pixel that it covers.
    struct Drawing {
        Vec3 axis;
        double least_cosine;
        std::vector<std::pair<std::size_t, double>> factors;
        double drawn_sr = 0;
    };

    std::size_t pixel_at(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(image_.width) +
               static_cast<std::size_t>(column);
    }
    double pixel_sr(int row) const {
        const double step = kPi / image_.height;
        return 2 * kPi / image_.width * (std::cos(row * step) - std::cos((row + 1) * step));
    }
    /// In the frame of panoramas: x leads to the middle column, y to the left of it.
    Vec3 direction_at(double row, double column) const {
        const double polar = kPi * row / image_.height, azimuth = 2 * kPi * (0.5 - column / image_.width);
        return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
    }

    /// Adds a pixel to the drawings of all discs that are seen in it.
    void find_discs(int row, int column) {
        const Vec3 middle = direction_at(row + 0.5, column + 0.5);
        const double reach = 2 * kPi / image_.height;  // more than from the middle to a corner
        const bool is_at_edge = std::ranges::any_of(drawings_, [&](const Drawing& drawing) {
            return std::abs(dot(middle, drawing.axis) - drawing.least_cosine) < reach;
        });
        const int samples = is_at_edge ? kSamples : 1;
        const double share = 1.0 / (samples * samples);
        for (int i = 0; i < samples; ++i) {
            for (int j = 0; j < samples; ++j) {
                const Vec3 w = direction_at(row + (i + 0.5) / samples, column + (j + 0.5) / samples);
                if (const auto seen = disc_towards(w)) add(*seen, row, column, share, w);
            }
        }
    }
    std::optional<std::size_t> disc_towards(const Vec3& w) const {
        std::optional<std::size_t> seen;
        for (std::size_t i = 0; i < drawings_.size(); ++i) {
            if (dot(w, drawings_[i].axis) < drawings_[i].least_cosine) continue;
            seen = i;
            if (!discs_[i].gives_way) break;
        }
        return seen;
    }
    void add(std::size_t disc, int row, int column, double share, const Vec3& w) {
        auto& [axis, least_cosine, factors, drawn_sr] = drawings_[disc];
        const std::size_t pixel = pixel_at(row, column);
        if (factors.empty() || factors.back().first != pixel) factors.emplace_back(pixel, 0);
        factors.back().second += share * factor_towards(discs_[disc], w);
        drawn_sr += share * pixel_sr(row);
    }

    /// Small discs get their exact solid angle; of others the edge of pixels matters little, and a part may
    /// be hidden.
    void draw(const SkyDisc& disc, Drawing& drawing) {
        const bool is_small = disc.angle_deg < kSmallDeg;
        if (drawing.factors.empty() && is_small) add_smallest(disc, drawing);
        const double correction = is_small ? solid_angle_sr(disc.angle_deg) / drawing.drawn_sr : 1;
        const Rgb luminance = disc.luminance_cd_m2 * correction;
        for (const auto& [pixel, factor] : drawing.factors) {
            for (std::size_t b = 0; b < kBands; ++b)
                image_.rgb_cd_m2[pixel][b] += static_cast<float>(factor * luminance[b]);
        }
    }
    /// The pixel of a disc that is smaller than the steps of the search.
    void add_smallest(const SkyDisc& disc, Drawing& drawing) const {
        const Vec3& w = drawing.axis;
        const auto inside = [](double position, int count) {
            return std::clamp(static_cast<int>(position * count), 0, count - 1);
        };
        const int row = inside(std::acos(std::clamp(w.z, -1.0, 1.0)) / kPi, image_.height);
        const int column = inside(0.5 - std::atan2(w.y, w.x) / (2 * kPi), image_.width);
        drawing.factors.emplace_back(pixel_at(row, column), factor_towards(disc, w));
        drawing.drawn_sr = pixel_sr(row);
    }

    const std::vector<SkyDisc>& discs_;
    std::vector<Drawing> drawings_;
    Panorama::Image image_;
};

}  // namespace

std::optional<EnvironmentLight> environment_of(const std::vector<SkyDisc>& discs) {
    const bool is_dark =
        std::ranges::all_of(discs, [](const SkyDisc& disc) { return !(disc.luminance_cd_m2.max() > 0); });
    if (is_dark) return std::nullopt;
    EnvironmentLight light;
    if (discs.size() == 1 && discs.front().angle_deg >= 360 && !discs.front().factor) {
        light.luminance_cd_m2 = discs.front().luminance_cd_m2;
        return light;
    }
    Panorama::Image image = DiscPainter(discs).paint();
    const auto is_black = [](const std::array<float, 3>& pixel) { return pixel == std::array<float, 3>{}; };
    if (std::ranges::all_of(image.rgb_cd_m2, is_black)) return std::nullopt;
    light.panorama = std::make_shared<const Panorama>(std::move(image));
    return light;
}

}  // namespace stilb::lights
