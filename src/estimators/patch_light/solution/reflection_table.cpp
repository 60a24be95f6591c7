#include "estimators/patch_light/solution/reflection_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "materials/diffuse.h"
#include "materials/ward.h"
#include "math/random.h"
#include "math/sampling.h"

namespace stilb::estimators {
namespace {

constexpr int kThetas = 33, kPhis = 32;
constexpr double kMostTheta = (90 - 0.1) * kPi / 180;
constexpr std::uint32_t kNodesOfTables = 2048;
/// Number k of the term (n, m).
constexpr int term_number(int n, int m) { return (n * (n + 2) + m) / 2; }

/// Calls `visit(in, weight_sr)` for directions whose weighted sum replaces an integral over the light that
/// arrives and leaves towards `out`, both in the material's frame: as many drawn by the BRDF as by the
/// cosine, from Hammersley's points, with the weights of the balance heuristic, which keep f / weight bounded
/// for lobes of any width.
template <typename Visit>
void for_each_node(const Material& material, const Vec3& out, std::uint32_t each, const Visit& visit) {
    for (std::uint32_t i = 0; i < each; ++i) {
        const double u1 = (i + 0.5) / each, u2 = math::unit_interval(math::sobol(i, 0));
        const auto add = [&](const Vec3& in) {
            if (!(in.z > 0)) return;
            visit(in,
                  1 / (each * (pdf_per_sr(material, out, in) + math::cosine_hemisphere_pdf_per_sr(in.z))));
        };
        add(math::sample_cosine_hemisphere(u1, u2).direction);
        if (const auto drawn = sample_brdf(material, out, u1, u2)) add(drawn->direction);
    }
}

bool is_isotropic(const Material& material) {
    const auto* ward = material.get_if<Ward>();
    return !ward || ward->parameters().roughness[0] == ward->parameters().roughness[1];
}

/// A position between two of `count` entries.
struct Between {
    std::size_t first = 0, second = 0;
    float weight = 0;  ///< of the second
};

Between between_rows(double theta, int count) {
    const double row = std::min(theta / kMostTheta, 1.0) * (count - 1);
    const auto first = std::min(static_cast<std::size_t>(row), static_cast<std::size_t>(count - 2));
    return {first, first + 1, static_cast<float>(row - static_cast<double>(first))};
}

Between between_azimuths(double phi, int count) {
    const double column = (phi < 0 ? phi + 2 * kPi : phi) / (2 * kPi) * count;
    const auto n = static_cast<std::size_t>(count);
    const std::size_t first = static_cast<std::size_t>(column) % n;
    return {first, (first + 1) % n, static_cast<float>(column - std::floor(column))};
}

void add_row(std::span<const FloatRgb> row, float weight, std::span<FloatRgb> sums) {
    for (std::size_t k = 0; k < sums.size(); ++k) {
        for (std::size_t b = 0; b < kBands; ++b) sums[k][b] += weight * row[k][b];
    }
}

/// Turns factors of a basis about the normal by the angle with this cosine and sine.
void turn(double cosine, double sine, std::span<FloatRgb> factors) {
    double cos_m = cosine, sin_m = sine;
    for (int m = 1; static_cast<std::size_t>(term_number(m, m)) < factors.size(); ++m) {
        const auto c = static_cast<float>(cos_m), s = static_cast<float>(sin_m);
        for (int n = m; static_cast<std::size_t>(term_number(n, m)) < factors.size(); n += 2) {
            FloatRgb& even = factors[static_cast<std::size_t>(term_number(n, m))];
            FloatRgb& odd = factors[static_cast<std::size_t>(term_number(n, -m))];
            for (std::size_t b = 0; b < kBands; ++b) {
                const float turned = even[b] * c - odd[b] * s;
                odd[b] = even[b] * s + odd[b] * c;
                even[b] = turned;
            }
        }
        const double next = cos_m * cosine - sin_m * sine;
        sin_m = sin_m * cosine + cos_m * sine;
        cos_m = next;
    }
}

}  // namespace

void integrate_factors(const Material& material, const math::ZernikeBasis& basis, const Vec3& local_out,
                       std::uint32_t nodes, std::span<FloatRgb> factors) {
    std::array<Rgb, math::ZernikeBasis::kMostCount> sums{};
    std::array<double, math::ZernikeBasis::kMostCount> values;
    for_each_node(material, local_out, nodes, [&](const Vec3& in, double weight_sr) {
        const Rgb share = evaluate_brdf_per_sr(material, in, local_out) * (in.z * weight_sr);
        basis.evaluate(in, values);
        for (std::size_t k = 0; k < factors.size(); ++k) sums[k] += share * values[k];
    });
    for (std::size_t k = 0; k < factors.size(); ++k) factors[k] = to_float_rgb(sums[k]);
}

ReflectionTable make_reflection_table(const Material& material, int degree) {
    if (const auto* diffuse = material.get_if<Diffuse>())
        return {1, 1, {to_float_rgb(diffuse->reflectance * (1 / std::sqrt(kPi)))}};
    const math::ZernikeBasis basis(degree);
    ReflectionTable table{kThetas, is_isotropic(material) ? 1 : kPhis, {}};
    const std::size_t directions =
        static_cast<std::size_t>(table.thetas) * static_cast<std::size_t>(table.phis);
    table.factors.resize(directions * basis.count());
    parallel_for(directions, [&](std::size_t i) {
        const std::size_t row = i / table.phis, column = i % table.phis;
        const double theta = static_cast<double>(row) / (table.thetas - 1) * kMostTheta;
        const double phi = static_cast<double>(column) / table.phis * 2 * kPi;
        const Vec3 out{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
        const auto factors = std::span(table.factors).subspan(i * basis.count(), basis.count());
        integrate_factors(material, basis, out, kNodesOfTables, factors);
        turn(std::cos(phi), -std::sin(phi), factors);
    });
    return table;
}

void interpolate_factors(const ReflectionTable& table, const Vec3& local_out, std::span<FloatRgb> factors) {
    if (table.thetas == 1) {
        factors[0] = table.factors[0];
        return;
    }
    const std::size_t terms = table.terms(), phis = static_cast<std::size_t>(table.phis);
    const auto row = [&](std::size_t theta, std::size_t phi) {
        return std::span(table.factors).subspan((theta * phis + phi) * terms, terms);
    };
    const double sine = std::hypot(local_out.x, local_out.y);
    const Between theta = between_rows(std::atan2(sine, local_out.z), table.thetas);
    std::ranges::fill(factors, FloatRgb{});
    const auto add_azimuth = [&](std::size_t phi, float weight) {
        add_row(row(theta.first, phi), weight * (1 - theta.weight), factors);
        add_row(row(theta.second, phi), weight * theta.weight, factors);
    };
    if (phis == 1) {
        add_azimuth(0, 1);
    } else {
        const Between phi = between_azimuths(std::atan2(local_out.y, local_out.x), table.phis);
        add_azimuth(phi.first, 1 - phi.weight);
        add_azimuth(phi.second, phi.weight);
    }
    if (sine > 0) turn(local_out.x / sine, local_out.y / sine, factors);
}

}  // namespace stilb::estimators
