// Tables of reflection against sums over directions.
#include "estimators/patch_light/solution/reflection_table.h"

#include <gtest/gtest.h>

#include "materials/diffuse.h"
#include "materials/phong.h"
#include "materials/rough_conductor.h"
#include "materials/ward.h"

namespace stilb::estimators {
namespace {

constexpr int kDegree = 6;

void expect_the_factors(const Material& material, double tolerance) {
    const math::ZernikeBasis basis(kDegree);
    const ReflectionTable table = make_reflection_table(material, kDegree);
    std::vector<FloatRgb> tabulated(basis.count()), summed(basis.count());
    for (const Vec3& direction : {Vec3{0, 0, 1}, Vec3{0.3, -0.2, 0.9}, Vec3{-0.7, 0.1, 0.7},
                                  Vec3{0.5, 0.8, 0.3}, Vec3{-0.2, -0.9, 0.15}}) {
        const Vec3 out = normalized(direction);
        interpolate_factors(table, out, tabulated);
        integrate_factors(material, basis, out, 1 << 14, summed);
        for (std::size_t k = 0; k < basis.count(); ++k)
            EXPECT_NEAR(tabulated[k][1], summed[k][1], tolerance * summed[0][1]) << "term " << k;
    }
}

TEST(ReflectionTable, OfPhong) { expect_the_factors(Phong{Rgb::grey(0.2), Rgb::grey(0.4), 20}, 0.02); }
TEST(ReflectionTable, OfRoughMetal) {
    expect_the_factors(materials::make<RoughConductor>({Rgb::grey(0.8), 0.35}, "materials.metal"), 0.02);
}
TEST(ReflectionTable, OfAnisotropicWard) {
    expect_the_factors(
        materials::make<Ward>({Rgb::grey(0.1), Rgb::grey(0.5), {0.4, 0.15}, 30}, "materials.brushed"), 0.03);
}

TEST(ReflectionTable, OfDiffuseIsOneTerm) {
    const ReflectionTable table = make_reflection_table(Diffuse{Rgb::grey(0.5)}, kDegree);
    ASSERT_EQ(table.terms(), 1u);
    EXPECT_NEAR(table.factors[0][0], 0.5 / std::sqrt(kPi), 1e-6);
}

}  // namespace
}  // namespace stilb::estimators
