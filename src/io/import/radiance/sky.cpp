#include "io/import/radiance/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "io/text/radiance_units.h"

namespace stilb::io::radiance {
namespace {

constexpr double kRadPerDeg = kPi / 180;
constexpr int kLeastHeight = 256, kMostHeight = 1024;
constexpr int kSamples = 4;  ///< along each side of a pixel

double solid_angle_sr(double angle_deg) {
    const double half = std::min(angle_deg / 2, 180.0) * kRadPerDeg;
    return 4 * kPi * std::sin(half / 2) * std::sin(half / 2);
}

struct Disc {
    Vec3 axis;
    double least_cosine;
};

/// The panorama of sources, in the frame of the scene.
class SkyPainter {
  public:
    explicit SkyPainter(const std::vector<DistantSource>& sources)
        : sources_(sources), drawings_(sources.size()) {
        double smallest_deg = 360;
        for (const DistantSource& source : sources) {
            discs_.push_back(
                {normalized(source.direction), std::cos(std::min(source.angle_deg / 2, 180.0) * kRadPerDeg)});
            smallest_deg = std::min(smallest_deg, source.angle_deg);
        }
        constexpr double pixels_across = 6;
        const double wanted = 180 / smallest_deg * pixels_across;
        image_.height = static_cast<int>(std::clamp(wanted, double{kLeastHeight}, double{kMostHeight}));
        image_.width = 2 * image_.height;
    }

    Panorama::Image paint() && {
        const auto width = static_cast<std::size_t>(image_.width);
        image_.rgb_cd_m2.resize(width * static_cast<std::size_t>(image_.height));
        std::vector<Cover> covers(sources_.size());
        for (int row = 0; row < image_.height; ++row) {
            for (int column = 0; column < image_.width; ++column) {
                std::ranges::fill(covers, Cover{});
                find_covers(row, column, covers);
                const std::size_t pixel =
                    static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
                for (std::size_t s = 0; s < covers.size(); ++s) {
                    if (covers[s].share > 0) add(s, pixel, covers[s], row_sr(row));
                }
            }
        }
        for (std::size_t s = 0; s < sources_.size(); ++s) draw(s);
        return std::move(image_);
    }

  private:
    /// The share of a pixel that a source covers, and its mean factor there times this share.
    struct Cover {
        double share = 0, factor = 0;
    };
    /// The pixels of a source, with its factors there.
    struct Drawing {
        std::vector<std::pair<std::size_t, double>> factors;
        double drawn_sr = 0;
    };

    void add(std::size_t source, std::size_t pixel, const Cover& cover, double sr) {
        drawings_[source].factors.emplace_back(pixel, cover.factor);
        drawings_[source].drawn_sr += cover.share * sr;
    }
    /// Small sources get their exact solid angle; of others the edge of pixels matters little, and a part may
    /// be hidden.
    void draw(std::size_t source) {
        constexpr double small_deg = 5;
        Drawing& drawing = drawings_[source];
        const DistantSource& of = sources_[source];
        if (drawing.factors.empty() && of.angle_deg < small_deg) add_smallest(source);
        const double exact = solid_angle_sr(of.angle_deg);
        const double correction = of.angle_deg < small_deg ? exact / drawing.drawn_sr : 1;
        const Rgb luminance = photometric(of.radiance_w_sr_m2) * correction;
        for (const auto& [pixel, factor] : drawing.factors) {
            for (std::size_t b = 0; b < kBands; ++b)
                image_.rgb_cd_m2[pixel][b] += static_cast<float>(factor * luminance[b]);
        }
    }
    /// The pixel of a source that is smaller than the steps of the search.
    void add_smallest(std::size_t source) {
        const Vec3& w = discs_[source].axis;
        const auto inside = [](double position, int count) {
            return std::clamp(static_cast<int>(position * count), 0, count - 1);
        };
        const int row = inside(std::acos(std::clamp(w.z, -1.0, 1.0)) / kPi, image_.height);
        const int column = inside(0.5 - std::atan2(w.y, w.x) / (2 * kPi), image_.width);
        add(source,
            static_cast<std::size_t>(row) * static_cast<std::size_t>(image_.width) +
                static_cast<std::size_t>(column),
            {1, sources_[source].factor(w)}, row_sr(row));
    }

    double row_sr(int row) const {
        const double step = kPi / image_.height;
        return 2 * kPi / image_.width * (std::cos(row * step) - std::cos((row + 1) * step));
    }
    /// As the panorama has them: x leads to the middle column, y to the left of it.
    Vec3 direction_at(double row, double column) const {
        const double polar = kPi * row / image_.height, azimuth = 2 * kPi * (0.5 - column / image_.width);
        return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
    }
    void find_covers(int row, int column, std::vector<Cover>& covers) const {
        const Vec3 middle = direction_at(row + 0.5, column + 0.5);
        const double reach = 2 * kPi / image_.height;  // more than from the middle to a corner
        const bool is_at_edge = std::ranges::any_of(discs_, [&](const Disc& disc) {
            return std::abs(dot(middle, disc.axis) - disc.least_cosine) < reach;
        });
        const int samples = is_at_edge ? kSamples : 1;
        for (int i = 0; i < samples; ++i) {
            for (int j = 0; j < samples; ++j) {
                const Vec3 w = direction_at(row + (i + 0.5) / samples, column + (j + 0.5) / samples);
                const auto seen = source_towards(w);
                if (!seen) continue;
                const double share = 1.0 / (samples * samples);
                covers[*seen].share += share;
                covers[*seen].factor += share * sources_[*seen].factor(w);
            }
        }
    }
    std::optional<std::size_t> source_towards(const Vec3& w) const {
        std::optional<std::size_t> seen;
        for (std::size_t s = 0; s < discs_.size(); ++s) {
            if (dot(w, discs_[s].axis) < discs_[s].least_cosine) continue;
            seen = s;
            if (!sources_[s].gives_way) break;
        }
        return seen;
    }

    const std::vector<DistantSource>& sources_;
    std::vector<Disc> discs_;
    std::vector<Drawing> drawings_;
    Panorama::Image image_;
};

}  // namespace

std::optional<EnvironmentLight> environment_of(const std::vector<DistantSource>& sources) {
    std::vector<DistantSource> all = sources;
    const bool is_dark =
        std::ranges::all_of(all, [](const DistantSource& s) { return !(s.radiance_w_sr_m2.max() > 0); });
    if (is_dark) return std::nullopt;
    EnvironmentLight light;
    if (all.size() == 1 && all.front().angle_deg >= 360 && all.front().patterns.empty()) {
        light.luminance_cd_m2 = photometric(all.front().radiance_w_sr_m2);
    } else {
        Panorama::Image image = SkyPainter(all).paint();
        const auto is_black = [](const std::array<float, 3>& pixel) {
            return pixel == std::array<float, 3>{};
        };
        if (std::ranges::all_of(image.rgb_cd_m2, is_black)) return std::nullopt;
        light.panorama = std::make_shared<const Panorama>(std::move(image));
    }
    return light;
}

}  // namespace stilb::io::radiance
