// The drawing of a luminaire's intensities.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/drawing.h"
#include "report/luminaires.h"

namespace stilb::report {
namespace {

constexpr double kDiskRadius = 118, kAround = 26, kKeySpace = 38;
/// Intensities above the horizontal, as a share of the peak, that do not ask for the upper half.
constexpr double kNoticeable = 0.005;
constexpr int kStepDeg = 1, kSpokeDeg = 30;

Vec3 direction_of(double c_deg, double gamma_deg) {
    const double c = c_deg * kPi / 180, gamma = gamma_deg * kPi / 180;
    return {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), std::cos(gamma)};
}

/// gamma from -180 (in the plane opposite to C) to 180 degrees.
std::vector<double> intensities_cd_klm(const PhotometricSolid& solid, double c_deg) {
    std::vector<double> values;
    for (int gamma = -180; gamma <= 180; gamma += kStepDeg)
        values.push_back(1000 * solid.intensity_cd(direction_of(c_deg, gamma)) / solid.flux_lm());
    return values;
}

bool shines_upwards(std::span<const double> values) {
    const double noticeable = kNoticeable * *std::ranges::max_element(values);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double gamma = -180.0 + static_cast<double>(i) * kStepDeg;
        if (std::abs(gamma) > 90 && values[i] > noticeable) return true;
    }
    return false;
}

/// gamma = 0 points downwards, 90 degrees to the right.
class PolarDiagram {
  public:
    PolarDiagram(double most, bool is_whole)
        : scale_(plot::ScaleType::linear, plot::nice_range(plot::ScaleType::linear, std::array{0.0, most})),
          is_whole_(is_whole),
          centre_{kAround + 14 + kDiskRadius, kAround + (is_whole ? kDiskRadius : 0)},
          drawing_(2 * (kAround + 14 + kDiskRadius), centre_.y + kDiskRadius + kKeySpace,
                   "Polar curve of the intensities") {
        draw_grid();
    }

    void draw_curve(std::string_view css_class, std::span<const double> values) {
        std::vector<Point> points;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double gamma = -180.0 + static_cast<double>(i) * kStepDeg;
            if (is_whole_ || std::abs(gamma) <= 90) points.push_back(at(gamma, values[i]));
        }
        drawing_.path(css_class, path_of(points, is_whole_ ? Ends::closed : Ends::open));
    }

    Html finish() {
        const double below = centre_.y + kDiskRadius + kKeySpace - 8;
        const auto key = [&](std::string_view css_class, double x, const std::string& name) {
            drawing_.line(css_class, {x, below - 3}, {x + 20, below - 3});
            drawing_.text("axis", {x + 25, below}, name);
        };
        key("c0", centre_.x - 118, "C0–C180");
        key("c90", centre_.x - 30, "C90–C270");
        drawing_.text("axis", {centre_.x + 118, below}, "cd/klm", Drawing::Anchor::end);
        return drawing_.html();
    }

  private:
    Point around(double gamma_deg, double radius) const {
        const double gamma = gamma_deg * kPi / 180;
        return {centre_.x + radius * std::sin(gamma), centre_.y + radius * std::cos(gamma)};
    }
    Point at(double gamma_deg, double value) const {
        return around(gamma_deg, kDiskRadius * scale_.fraction_of(value));
    }

    void draw_grid() {
        const int last = is_whole_ ? 180 : 90;
        for (const auto& [value, label] : plot::nice_ticks(scale_, 5).major) {
            if (value <= 0) continue;
            std::vector<Point> ring;
            for (int gamma = -last; gamma <= last; gamma += 3) ring.push_back(at(gamma, value));
            drawing_.path("grid", path_of(ring));
            const Point place = at(0, value);
            drawing_.text("ring", {place.x + 3, place.y - 2}, label);
        }
        for (int gamma = -last; gamma <= last; gamma += kSpokeDeg) {
            if (gamma == -180) continue;
            drawing_.line("grid", centre_, around(gamma, kDiskRadius));
            const Point place = around(gamma, kDiskRadius + 11);
            drawing_.text("axis", {place.x, place.y + 3}, fmt::format("{}°", std::abs(gamma)),
                          gamma == 0 || gamma == 180 ? Drawing::Anchor::middle
                          : gamma > 0                ? Drawing::Anchor::start
                                                     : Drawing::Anchor::end);
        }
    }

    plot::Scale scale_;
    bool is_whole_;
    Point centre_;
    Drawing drawing_;
};

}  // namespace

Html polar_curve(const PhotometricSolid& solid) {
    const std::vector<double> c0 = intensities_cd_klm(solid, 0), c90 = intensities_cd_klm(solid, 90);
    PolarDiagram diagram(std::max(*std::ranges::max_element(c0), *std::ranges::max_element(c90)),
                         shines_upwards(c0) || shines_upwards(c90));
    diagram.draw_curve("c90", c90);
    diagram.draw_curve("c0", c0);
    return diagram.finish();
}

}  // namespace stilb::report
