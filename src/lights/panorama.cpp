#include "lights/panorama.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "math/sampling.h"
#include "stilb/error.h"

namespace stilb::lights {
namespace {

/// cd/m2: squares and sums stay far from overflow.
constexpr float kLargest = 1e15F;
constexpr int kMostPartsAcross = 64;

}  // namespace

Panorama::Panorama(Image image) : image_(std::move(image)) {
    check();
    add_up();
    if (!(total_luminous_lx_ > 0))
        throw InputError("the panorama is black. Needed: a pixel with luminance above 0.");
    divide();
}

void Panorama::check() const {
    if (image_.height < 1 || image_.width != 2 * image_.height) {
        throw InputError(fmt::format(
            "the panorama has {} x {} pixels. Needed: twice as many in a row as in a column, 360 by 180 "
            "degrees in equal steps.",
            image_.width, image_.height));
    }
    for (std::size_t i = 0; i < image_.rgb_cd_m2.size(); ++i) {
        for (const float value : image_.rgb_cd_m2[i]) {
            if (value >= 0 && value <= kLargest) continue;
            const auto width = static_cast<std::size_t>(image_.width);
            throw InputError(
                fmt::format("the panorama has the value {} in column {} of row {}. Allowed: 0 to 1e15.",
                            value, i % width + 1, i / width + 1));
        }
    }
}

void Panorama::add_up() {
    pixel_sums_.resize(image_.rgb_cd_m2.size());
    std::size_t pixel = 0;
    for (int row = 0; row < image_.height; ++row) {
        double sum = 0;
        Rgb rgb;
        for (int column = 0; column < image_.width; ++column, ++pixel) {
            const Rgb own = rgb_of(pixel);
            rgb += own;
            pixel_sums_[pixel] = sum += own.luminance();
        }
        total_lx_ += pixel_sr(row) * rgb;
        row_sums_.push_back(total_luminous_lx_ += pixel_sr(row) * sum);
    }
}

void Panorama::divide() {
    const int edge = (image_.width + kMostPartsAcross - 1) / kMostPartsAcross;
    for (int top = 0; top < image_.height; top += edge) {
        const int bottom = std::min(top + edge, image_.height);
        const double middle_z = (top_of(top) + top_of(bottom)) / 2;
        for (int left = 0; left < image_.width; left += edge) {
            const int right = std::min(left + edge, image_.width);
            Rgb sum;
            for (int row = top; row < bottom; ++row) {
                const std::size_t first =
                    static_cast<std::size_t>(row) * static_cast<std::size_t>(image_.width);
                for (int column = left; column < right; ++column)
                    sum += pixel_sr(row) * rgb_of(first + static_cast<std::size_t>(column));
            }
            parts_.push_back({direction_at((left + right) / 2.0, middle_z), sum});
        }
    }
}

Rgb Panorama::rgb_of(std::size_t pixel) const {
    const std::array<float, 3>& rgb = image_.rgb_cd_m2[pixel];
    return {{rgb[0], rgb[1], rgb[2]}};
}

double Panorama::top_of(int row) const { return std::cos(kPi * row / image_.height); }

double Panorama::pixel_sr(int row) const { return 2 * kPi / image_.width * (top_of(row) - top_of(row + 1)); }

Vec3 Panorama::direction_at(double column, double z) const {
    const double azimuth = 2 * kPi * (0.5 - column / image_.width);
    const double horizontal = std::sqrt(std::max(0.0, 1 - z * z));
    return {horizontal * std::cos(azimuth), horizontal * std::sin(azimuth), z};
}

std::size_t Panorama::pixel_towards(const Vec3& direction) const {
    const double azimuth = std::atan2(direction.y, direction.x);
    const double polar = std::atan2(std::hypot(direction.x, direction.y), direction.z);
    const auto inside = [](double position, int count) {
        return static_cast<std::size_t>(std::clamp(position * count, 0.0, count - 1.0));
    };
    return inside(polar / kPi, image_.height) * static_cast<std::size_t>(image_.width) +
           inside(0.5 - azimuth / (2 * kPi), image_.width);
}

Rgb Panorama::illuminance_lx(const Vec3& normal) const {
    Rgb sum;
    std::size_t pixel = 0;
    for (int row = 0; row < image_.height; ++row) {
        const double middle_z = (top_of(row) + top_of(row + 1)) / 2, sr = pixel_sr(row);
        for (int column = 0; column < image_.width; ++column, ++pixel) {
            const double cosine = dot(direction_at(column + 0.5, middle_z), normal);
            if (cosine > 0) sum += sr * cosine * rgb_of(pixel);
        }
    }
    return sum;
}

Panorama::Sample Panorama::sample(double u1, double u2) const {
    const auto row = math::choose_by_sums(row_sums_, u1);
    const auto width = static_cast<std::size_t>(image_.width);
    const auto column = math::choose_by_sums(std::span(pixel_sums_).subspan(row.index * width, width), u2);
    const double top = top_of(static_cast<int>(row.index)), bottom = top_of(static_cast<int>(row.index) + 1);
    const Rgb rgb = rgb_of(row.index * width + column.index);
    return {direction_at(static_cast<double>(column.index) + column.remainder,
                         top + row.remainder * (bottom - top)),
            rgb.luminance() / total_luminous_lx_, rgb};
}

}  // namespace stilb::lights
