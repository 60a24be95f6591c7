#include "io/import/textures/texture_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stilb::io {
namespace {

constexpr std::size_t kSurfacePoints = 16384;

double fraction(double value) { return value - std::floor(value); }

double wrapped(double coordinate, TextureWrap wrap) {
    if (wrap == TextureWrap::clamp) return std::clamp(coordinate, 0.0, 1.0);
    if (wrap == TextureWrap::repeat) return fraction(coordinate);
    const double turn = fraction(coordinate / 2) * 2;
    return turn <= 1 ? turn : 2 - turn;
}

/// Whether it is a number whose products are numbers, too.
bool is_uv(const Uv& uv) {
    constexpr double most = 1e9;
    return std::abs(uv[0]) <= most && std::abs(uv[1]) <= most;
}

class TexelMean {
  public:
    explicit TexelMean(Texels texels) : texels_(texels) {}

    void add(const std::array<std::uint8_t, 4>& texel) {
        for (std::size_t c = 0; c < 4; ++c)
            sum_[c] += texels_ == Texels::colours && c < 3 ? linear_of_srgb(texel[c]) : texel[c] / 255.0;
        ++count_;
    }
    std::array<double, 4> value() const {
        std::array<double, 4> mean = sum_;
        for (double& value : mean) value /= static_cast<double>(count_);
        return mean;
    }

  private:
    Texels texels_;
    std::array<double, 4> sum_{};
    std::size_t count_ = 0;
};

}  // namespace

FacePlace no_place() {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {{{none, none}, {none, none}, {none, none}}};
}

bool has_place(const FacePlace& place) { return std::ranges::all_of(place, is_uv); }

Uv uv_at(const FacePlace& place, const std::array<double, 3>& barycentric) {
    Uv uv{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
        for (std::size_t i = 0; i < 2; ++i) uv[i] += barycentric[corner] * place[corner][i];
    }
    return uv;
}

const std::array<std::uint8_t, 4>& TextureMap::at(const Uv& uv) const {
    return picture->at(wrapped(uv[0], wrap_u), wrapped(uv[1], wrap_v));
}

Uv even_point(std::size_t i) {
    // Irrational steps (Roberts, the R2 sequence). Its beginning keeps points off edges, where rounding would
    // decide which texel they get.
    constexpr double step_u = 0.7548776662466927, step_v = 0.5698402909980532, first_u = 0.3, first_v = 0.2;
    return {fraction(first_u + step_u * static_cast<double>(i)),
            fraction(first_v + step_v * static_cast<double>(i))};
}

std::array<double, 3> even_point_of_triangle(std::size_t i) {
    auto [u, v] = even_point(i);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    return {1 - u - v, u, v};
}

std::vector<PointOfTriangle> points_on_surface(std::span<const double> areas_m2) {
    std::vector<double> area_until;
    double total = 0;
    for (const double area : areas_m2) area_until.push_back(total += area);
    std::vector<PointOfTriangle> points;
    for (std::size_t i = 0; i < kSurfacePoints && !areas_m2.empty(); ++i) {
        const double at = total * (static_cast<double>(i) + 0.5) / kSurfacePoints;
        const auto found = std::ranges::lower_bound(area_until, at) - area_until.begin();
        points.push_back(
            {std::min(static_cast<std::size_t>(found), areas_m2.size() - 1), even_point_of_triangle(i)});
    }
    return points;
}

std::array<double, 4> mean_of(const TextureMap& map, std::span<const Uv> places, Texels texels) {
    TexelMean mean(texels);
    for (const Uv& uv : places) mean.add(map.at(uv));
    if (places.empty()) {
        for (const auto& texel : map.picture->texels) mean.add(texel);
    }
    return mean.value();
}

}  // namespace stilb::io
