#include "estimators/local/guess/certain_light.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "base/rays.h"

namespace stilb::estimators {
namespace {

using Floats = PointTile::Floats;

struct Lane {
    float x, y, z;
};

/// Unit vectors from receivers to a point, and their cosines to the normals.
struct alignas(64) Directions {
    Floats x, y, z, height;
    float least_height;

    STILB_INLINED Lane of(int lane) const { return {x[lane], y[lane], z[lane]}; }
};

STILB_VECTORIZED void look(const PointTile& __restrict tile, const patches::Float3& point,
                           Directions& __restrict to) {
    const float px = point.x, py = point.y, pz = point.z;
    for (int i = 0; i < kPacketWidth; ++i) {
        const float dx = px - tile.x[i], dy = py - tile.y[i], dz = pz - tile.z[i];
        const float inverse = 1 / std::sqrt(dx * dx + dy * dy + dz * dz);
        to.x[i] = dx * inverse, to.y[i] = dy * inverse, to.z[i] = dz * inverse;
        to.height[i] = tile.normal_x[i] * to.x[i] + tile.normal_y[i] * to.y[i] + tile.normal_z[i] * to.z[i];
    }
    float least = 1;
    for (int i = 0; i < kPacketWidth; ++i) least = std::min(least, to.height[i]);
    to.least_height = least;
}

/// The angle between unit vectors over its sine, to 1e-7, by their cosine. The coefficients interpolate it at
/// Chebyshev's points of the cosines 0 ... 1.
STILB_INLINED float angle_over_sine(float cosine) {
    const float x = 1 - std::abs(cosine);
    float acute = 0.0171853692f;
    acute = acute * x - 0.0414066487f;
    acute = acute * x + 0.0587827332f;
    acute = acute * x - 0.023641731f;
    acute = acute * x + 0.038473479f;
    acute = acute * x + 0.0544793815f;
    acute = acute * x + 0.133600394f;
    acute = acute * x + 0.333323165f;
    acute = acute * x + 1.00000006f;
    const float obtuse = std::numbers::pi_v<float> / std::sqrt(std::max(x * (2 - x), 1e-12f)) - acute;
    return cosine < 0 ? obtuse : acute;
}

/// Twice the share of an edge in the projected solid angle.
STILB_INLINED float edge(const Lane& n, const Lane& u, const Lane& v) {
    return angle_over_sine(u.x * v.x + u.y * v.y + u.z * v.z) *
           (n.x * (u.y * v.z - u.z * v.y) + n.y * (u.z * v.x - u.x * v.z) + n.z * (u.x * v.y - u.y * v.x));
}

STILB_VECTORIZED void see_triangle(const PointTile& __restrict tile, const Directions& __restrict a,
                                   const Directions& __restrict b, const Directions& __restrict c,
                                   Floats& __restrict projected_sr) {
    for (int i = 0; i < kPacketWidth; ++i) {
        const Lane n{tile.normal_x[i], tile.normal_y[i], tile.normal_z[i]};
        const Lane u = a.of(i), v = b.of(i), w = c.of(i);
        projected_sr[i] = (edge(n, u, v) + edge(n, v, w) + edge(n, w, u)) / 2;
    }
}

STILB_VECTORIZED void add(const Floats& __restrict projected_sr, const std::array<float, kBands>& luminance,
                          std::array<Floats, kBands>& __restrict sums) {
    const float l0 = luminance[0], l1 = luminance[1], l2 = luminance[2];
    for (int i = 0; i < kPacketWidth; ++i) {
        sums[0][i] += l0 * projected_sr[i], sums[1][i] += l1 * projected_sr[i],
            sums[2][i] += l2 * projected_sr[i];
    }
}

/// The direction in which an edge crosses the horizon, by the heights of its ends; any where it does not.
STILB_INLINED Lane crossing(const Lane& u, float hu, const Lane& v, float hv) {
    const float x = u.x * hv - v.x * hu, y = u.y * hv - v.y * hu, z = u.z * hv - v.z * hu;
    const float inverse = (hv > hu ? 1.0f : -1.0f) / std::sqrt(std::max(x * x + y * y + z * z, 1e-30f));
    return {x * inverse, y * inverse, z * inverse};
}

STILB_INLINED Lane choose(bool first, const Lane& u, const Lane& v) {
    return {first ? u.x : v.x, first ? u.y : v.y, first ? u.z : v.z};
}

/// The same of the part above the horizon.
STILB_VECTORIZED void see_cut_triangle(const PointTile& __restrict tile, const Directions& __restrict a,
                                       const Directions& __restrict b, const Directions& __restrict c,
                                       Floats& __restrict projected_sr) {
    for (int i = 0; i < kPacketWidth; ++i) {
        const Lane n{tile.normal_x[i], tile.normal_y[i], tile.normal_z[i]};
        const Lane u = a.of(i), v = b.of(i), w = c.of(i);
        const float hu = a.height[i], hv = b.height[i], hw = c.height[i];
        const bool above_u = hu >= 0, above_v = hv >= 0, above_w = hw >= 0;
        const Lane uv = crossing(u, hu, v, hv), vw = crossing(v, hv, w, hw), wu = crossing(w, hw, u, hu);
        // | and & rather than || and &&: without branches the loop vectorises.
        float sum = (above_u | above_v) ? edge(n, choose(above_u, u, uv), choose(above_v, v, uv)) : 0.0f;
        sum += (above_v | above_w) ? edge(n, choose(above_v, v, vw), choose(above_w, w, vw)) : 0.0f;
        sum += (above_w | above_u) ? edge(n, choose(above_w, w, wu), choose(above_u, u, wu)) : 0.0f;
        // Along the horizon, from where the edges go below to where they come back.
        const Lane down = choose(above_u & !above_v, uv, choose(above_v & !above_w, vw, wu));
        const Lane back = choose(above_v & !above_u, uv, choose(above_w & !above_v, vw, wu));
        const bool is_cut = (above_u | above_v | above_w) & !(above_u & above_v & above_w);
        sum += is_cut ? edge(n, down, back) : 0.0f;
        projected_sr[i] = sum / 2;
    }
}

std::array<float, kBands> single(const Rgb& luminance) {
    return {static_cast<float>(luminance[0]), static_cast<float>(luminance[1]),
            static_cast<float>(luminance[2])};
}

}  // namespace

CertainLight::CertainLight(const LightGuess& guess, const Sights& sights) {
    constexpr std::uint32_t none = ~0u;
    const patches::Patches& patches = guess.patches();
    std::vector<std::uint32_t> numbers(patches.vertices.size(), none);
    for (const std::uint32_t side : guess.lit_sides()) {
        if (sights[side] != Sight::certain) continue;
        std::array<std::uint32_t, 3>& triangle = triangles_.emplace_back();
        const auto& vertices = patches.corners[patches.patch_of(side)];
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t vertex = vertices[patches.is_front(side) ? 2 - c : c];
            if (numbers[vertex] == none) {
                numbers[vertex] = static_cast<std::uint32_t>(corners_.size());
                corners_.push_back(patches.vertices[vertex]);
            }
            triangle[c] = numbers[vertex];
        }
        const transport::LightSum mean = guess.mean(side);
        luminances_.push_back(single(mean.whole));
        std::ranges::transform(mean.shares, std::back_inserter(luminances_), single);
    }
    sums_ = 1 + (guess.channels() ? guess.channels()->count() : 0);
}

auto CertainLight::illuminances_lx(const PointTile& tile) const -> std::vector<Illuminances> {
    std::vector<Directions> directions(corners_.size());
    for (std::size_t i = 0; i < corners_.size(); ++i) look(tile, corners_[i], directions[i]);
    std::vector<Illuminances> sums(sums_);
    alignas(64) Floats projected_sr;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        const auto [first, second, third] = triangles_[t];
        const Directions &a = directions[first], &b = directions[second], &c = directions[third];
        const bool is_above = std::min({a.least_height, b.least_height, c.least_height}) >= 0;
        (is_above ? see_triangle : see_cut_triangle)(tile, a, b, c, projected_sr);
        for (std::size_t s = 0; s < sums_; ++s) add(projected_sr, luminances_[t * sums_ + s], sums[s]);
    }
    return sums;
}

}  // namespace stilb::estimators
