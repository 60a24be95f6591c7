// The luminance of a glossy surface under a sphere light, by one reflection, against numerical integration.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/estimator_list.h"
#include "materials/phong.h"
#include "statistics/hypothesis.h"
#include "statistics/interval.h"
#include "support/quadrature.h"
#include "support/scene_builder.h"

namespace stilb::estimators {
namespace {

constexpr int kReplicates = 32;
constexpr std::uint64_t kSamples = 1 << 12;  ///< of each replicate
/// Relative, and in standard errors: by chance once in 150 times of the 96 comparisons.
constexpr double kLargestError = 0.002;
constexpr double kLargestZ = 4;

constexpr double kDiffuse = 0.2, kSpecular = 0.7;
constexpr double kPanelLuminance = 1000;
/// 5 cm over the surface z = 0.
const Sphere kLight{{0, 0, 0.1}, 0.05};

/// Phong's BRDF, written down once more, on a surface whose normal is z.
double brdf_per_sr(double exponent, const Vec3& in, const Vec3& out) {
    const double cosine = std::max(0.0, dot(reflected(in, {0, 0, 1}), out));
    return kDiffuse / kPi + kSpecular * (exponent + 2) / (2 * kPi) * std::pow(cosine, exponent);
}

/// The integral of L f cos over the cone of directions in which the light is seen.
double exact_luminance_cd_m2(const Vec3& position, const Vec3& out, double exponent) {
    constexpr double tolerance = 1e-7 * kPanelLuminance;
    const Vec3 to_light = kLight.center - position;
    const Frame frame = Frame::around(normalized(to_light));
    const double half_angle = std::asin(kLight.radius / length(to_light));
    return integrate_adaptively(0, half_angle, tolerance, [&](double theta) {
        return std::sin(theta) * integrate_adaptively(0, 2 * kPi, tolerance, [&](double phi) {
                   const Vec3 in = frame.to_world(
                       {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
                   return kPanelLuminance * brdf_per_sr(exponent, in, out) * std::max(0.0, in.z);
               });
    });
}

/// A point lies on the rectangle's diagonal, an edge of its triangles: rays start beside it. Distances and
/// angles of connections are its own, but rays that meet the light by chance see it from there.
Scene sphere_over_phong(double exponent) {
    Scene scene;
    add_object(scene, Rectangle{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}},
               Phong{Rgb::grey(kDiffuse), Rgb::grey(kSpecular), exponent});
    add_area_light(scene, kLight, Rgb::grey(kPanelLuminance));
    return scene;
}

/// Under the light and beside it, from upright to flat: in the highlight, at its edge and out of it.
std::vector<Measurand> sights() {
    std::vector<Measurand> rays;
    for (const Vec3& position : {Vec3{0, 0, 0}, Vec3{0.07, 0.03, 0}}) {
        for (const double polar_deg : {0.0, 25.0, 45.0, 70.0}) {
            const double polar = polar_deg * kPi / 180, azimuth = polar_deg / 10;
            rays.push_back(EmergentRay{
                position,
                {0, 0, 1},
                {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)}});
        }
    }
    return rays;
}

std::vector<statistics::Estimate> measure(const EstimatorEntry& method, const Scene& scene,
                                          const std::vector<Measurand>& rays) {
    constexpr int one_reflection = 1;
    const rays::RayCaster caster(scene);
    const auto estimator = method.make({scene, caster, one_reflection, {math::RandomKey{1}}, rays});
    EXPECT_EQ(kSamples % estimator->batch_granularity(), 0u);
    std::vector<double> means;
    for (std::uint64_t replicate = 0; replicate < kReplicates; ++replicate) {
        Tally sums(rays.size());
        estimator->run_batch({math::RandomKey{2}.derived(replicate), 0, kSamples}, sums);
        for (std::size_t j = 0; j < rays.size(); ++j) {
            means.push_back(estimator->known_part()[j].luminance() +
                            sums.sum[j].luminance() / static_cast<double>(kSamples));
        }
    }
    return statistics::estimate_readings({means, rays.size()});
}

/// How much the luminance depends on the place from which rays start: eight offsets beside an edge
/// (docs/ray-queries.md), as the first position is on one. The rectangle's edges are 2 m long.
double error_by_place(const EmergentRay& ray, double exponent) {
    if (ray.position.x != ray.position.y) return 0;
    constexpr double beside_m = 8 * 0x1p-19 * 2;
    const double exact = exact_luminance_cd_m2(ray.position, ray.direction, exponent);
    double largest = 0;
    for (int i = 0; i < 8; ++i) {
        const Vec3 beside{beside_m * std::cos(i * kPi / 4), beside_m * std::sin(i * kPi / 4), 0};
        largest = std::max(
            largest, std::abs(exact_luminance_cd_m2(ray.position + beside, ray.direction, exponent) - exact));
    }
    return largest;
}

/// The parameter is the exponent.
class FirstOrder : public testing::TestWithParam<double> {};

TEST_P(FirstOrder, IsTheIntegralOverTheLight) {
    const Scene scene = sphere_over_phong(GetParam());
    const std::vector<Measurand> rays = sights();
    std::vector<double> exact, by_place;
    for (const Measurand& measurand : rays) {
        const auto& ray = std::get<EmergentRay>(measurand);
        exact.push_back(exact_luminance_cd_m2(ray.position, ray.direction, GetParam()));
        by_place.push_back(error_by_place(ray, GetParam()));
    }
    for (const EstimatorEntry& method : unbiased_estimators()) {
        if (!method.measures_luminance) continue;
        const std::vector<statistics::Estimate> measured = measure(method, scene, rays);
        for (std::size_t j = 0; j < rays.size(); ++j) {
            EXPECT_NEAR(measured[j].value, exact[j], kLargestError * exact[j]) << method.name << ", " << j;
            const double apart = std::max(std::abs(measured[j].value - exact[j]) - by_place[j], 0.0);
            EXPECT_LT(statistics::equivalent_z(apart / measured[j].standard_error, kReplicates - 1),
                      kLargestZ)
                << method.name << ", " << j << ": " << measured[j].value << " +- "
                << measured[j].standard_error << ", exact " << exact[j];
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Exponents, FirstOrder, testing::Values(1, 10, 100, 1000));

}  // namespace
}  // namespace stilb::estimators
