// What a solution loses of the light that glossy surfaces reflect, by the degree of its basis: the table of
// docs/solution.md. A room with diffuse walls, and a floor and a box of one glossy material, seen from a
// corner; patches of 0.35 m.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "estimators/patch_light/incoming_light.h"
#include "materials/black.h"
#include "materials/diffuse.h"
#include "materials/phong.h"
#include "materials/rough_conductor.h"

namespace stilb {
namespace {

constexpr std::array kDegrees{0, 2, 4, 6, 8, 10, 12};
constexpr int kSteps = 3000;
constexpr Vec3 kEye{0.4, 0.4, 1.6};

using Errors = std::array<double, kDegrees.size()>;

void add_object(Scene& scene, const Shape& shape, MaterialId material) {
    scene.objects.push_back({std::to_string(scene.objects.size()), shape, {material}});
}

/// With a large light, which patches receive, or a small one, which comes by first shot: then all that they
/// receive was reflected before.
Scene room_with(const Material& material, bool has_large_light) {
    Scene scene;
    scene.materials = {{"wall", Diffuse{Rgb::grey(0.6)}}, {"glossy", material}, {"black", Black{}}};
    add_object(scene, Box{{0, 0, -1}, {4, 3, 2.8}}, MaterialId{0});
    add_object(scene, Rectangle{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}, MaterialId{1});
    add_object(scene, Box{{2, 1, 0}, {2.8, 1.8, 0.9}}, MaterialId{1});
    if (has_large_light) {
        add_object(scene, Rectangle{{1, 0.6, 2.75}, {0, 1.6, 0}, {2, 0, 0}}, MaterialId{2});
        scene.lights.push_back({"large", AreaLight{ObjectId{3}, Rgb::grey(100)}});
    } else {
        scene.lights.push_back({"small", PointLight{{3.2, 2.4, 2}, Rgb::grey(100)}});
    }
    return scene;
}

/// Of glossy sides towards the eye, by one walk.
struct Reflected {
    std::vector<double> exact;                                       ///< [cd/m2]
    std::array<std::vector<double>, kDegrees.size()> kept_too_much;  ///< per degree [cd/m2]
};

/// What is exact and what terms keep of it comes from the same steps, so that most of the noise is the same.
Reflected reflected_in(const estimators::PatchTransport& transport, math::RandomKey key) {
    const estimators::TermLayout layout(transport, math::ZernikeBasis::kMostDegree,
                                        reflecting_sides(transport));
    estimators::TermSums sums(transport, layout);
    std::vector<std::pair<std::uint32_t, Vec3>> seen;
    for (const std::uint32_t side : transport.glossy_sides) {
        const Vec3 out = normalized(kEye - transport.patches.middle(transport.patches.patch_of(side)));
        if (dot(transport.patches.normal_of(side), out) > 0) seen.emplace_back(side, out);
    }
    Reflected result;
    result.exact.resize(seen.size());
    estimators::BundleIteration iteration(transport, {key});
    const std::array<const estimators::BundleIteration*, 1> walks{&iteration};
    for (std::uint64_t i = 0; i < first_steps(transport); ++i) iteration.step();
    for (int step = 0; step < kSteps; ++step) {
        iteration.step();
        sums.add(walks);
        for (std::size_t i = 0; i < seen.size(); ++i)
            result.exact[i] += iteration.reflected(seen[i].first, seen[i].second).luminance() / kSteps;
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const auto& [side, out] = seen[i];
        const std::vector<estimators::FloatRgb> factors = reflection_factors(transport, layout, side, out);
        const std::span own = sums.sums_of(0, side);
        for (std::size_t d = 0; d < kDegrees.size(); ++d) {
            const std::size_t count = math::ZernikeBasis(kDegrees[d]).count();  // lower degrees come first
            const Rgb kept = estimators::reflected_cd_m2(own.first(count), std::span(factors).first(count));
            result.kept_too_much[d].push_back(kept.luminance() / kSteps - result.exact[i]);
        }
    }
    return result;
}

/// Per degree the root mean square of what sides reflect too much, as a share of their mean luminance, first
/// shot left out. The product of what two independent walks have too much is without noise.
Errors errors_of(const Material& material, bool has_large_light) {
    const Scene scene = room_with(material, has_large_light);
    const rays::RayCaster caster(scene);
    estimators::PatchOptions options;
    options.patch_m = 0.35;
    const estimators::PatchTransport transport(scene, caster, options);
    std::array<Reflected, 2> walks;
    tbb::parallel_for(std::size_t{0}, walks.size(),
                      [&](std::size_t w) { walks[w] = reflected_in(transport, math::RandomKey{w}); });
    const auto& exact = walks[0].exact;
    const auto sides = static_cast<double>(exact.size());
    const double mean = std::accumulate(exact.begin(), exact.end(), 0.0) / sides;
    Errors errors{};
    for (std::size_t d = 0; d < errors.size(); ++d) {
        const auto& one = walks[0].kept_too_much[d];
        const double product =
            std::inner_product(one.begin(), one.end(), walks[1].kept_too_much[d].begin(), 0.0);
        errors[d] = std::sqrt(std::max(product, 0.0) / sides) / mean;
    }
    return errors;
}

Material phong(double exponent) { return Phong{Rgb::grey(0.2), Rgb::grey(0.4), exponent}; }
Material rough(double roughness) { return RoughConductor({Rgb::grey(0.7), roughness}); }

void print_table() {
    const std::vector<std::pair<std::string, Material>> materials{
        {"phong, exponent 5", phong(5)},        {"phong, exponent 20", phong(20)},
        {"phong, exponent 100", phong(100)},    {"rough, roughness 0.6", rough(0.6)},
        {"rough, roughness 0.35", rough(0.35)}, {"rough, roughness 0.2", rough(0.2)},
        {"rough, roughness 0.1", rough(0.1)}};
    for (const bool has_large_light : {false, true}) {
        fmt::print("{:24}", has_large_light ? "large light, degree" : "small light, degree");
        for (const int degree : kDegrees) fmt::print("{:>8}", degree);
        fmt::print("\n");
        for (const auto& [name, material] : materials) {
            fmt::print("{:24}", name);
            for (const double error : errors_of(material, has_large_light))
                fmt::print("{:6.1f} %", 100 * error);
            fmt::print("\n");
            std::fflush(stdout);
        }
    }
}

}  // namespace
}  // namespace stilb

int main() { stilb::print_table(); }
