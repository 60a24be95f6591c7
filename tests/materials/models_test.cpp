// Every model of the list in material.h must pass these tests. A new one is tested by being in that list.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "materials/material.h"
#include "materials/model_list.h"
#include "math/sampling.h"
#include "stilb/error.h"
#include "support/random_pairs.h"
#include "support/source_directory.h"

namespace stilb::materials {
namespace {

double between(const Range& range, double u) {
    // Ranges over several powers of ten by their logarithm.
    const bool is_wide = range.min > 0 && range.max / range.min > 100;
    return is_wide ? range.min * std::pow(range.max / range.min, u) : range.min + u * (range.max - range.min);
}

void draw(double& value, const Range& range, RandomPairs& random) { value = between(range, random.next()); }
void draw(Rgb& value, const Range& range, RandomPairs& random) {
    for (double& band : value.band) draw(band, range, random);
}
void draw(bool& value, const Range&, RandomPairs& random) { value = random.next() < 0.5; }
void draw(SharesByAngle& value, const Range& range, RandomPairs& random) {
    value = SharesByAngle::along_normal({});
    draw(value.rows[0].share, range, random);
}
template <std::size_t count>
void draw(std::array<double, count>& values, const Range& range, RandomPairs& random) {
    for (double& value : values) draw(value, range, random);
}

/// Parameters that do not contradict each other; half of the optional ones are left out.
template <typename Parameters>
Parameters drawn(RandomPairs& random) {
    Parameters parameters;
    do {
        parameters = {};
        for_each_field<Parameters>([&](const auto& field) {
            if (field.presence == Presence::required || random.next() < 0.5)
                draw(parameters.*field.member, field.range, random);
        });
    } while (contradiction_in(parameters));
    return parameters;
}

std::vector<Material> materials_of_every_model() {
    constexpr int kOfEach = 6;
    RandomPairs random(3);
    std::vector<Material> materials;
    for_each_model([&]<typename M>() {
        for (int i = 0; i < kOfEach; ++i)
            materials.push_back(make<M>(drawn<ParametersOf<M>>(random), "drawn"));
    });
    return materials;
}

/// The same, and beside those that are composed their lobes.
std::vector<Material> scattering_of_every_model() {
    std::vector<Material> all = materials_of_every_model();
    for (const Material& material : materials_of_every_model()) {
        for (const Lobe& lobe : lobes(material, LightSide::inside, Carried::flux)) {
            // Refraction tells both directions apart (frosted_test.cpp).
            if (lobe.far_over_near == 1) all.push_back(lobe.scattering);
        }
    }
    return all;
}

Rgb sent_on(const Material& material, const Vec3& in) {
    Rgb sum;
    for (const Lobe& lobe : lobes(material, LightSide::outside, Carried::flux))
        sum += lobe.factor(Carried::flux) * sent_on(lobe.scattering, in);
    const SpecularBranches branches = specular_branches(material, LightSide::outside, in);
    for (const SpecularBranch& branch : branches.list()) sum += branch.share;
    constexpr int kSteps = 256;  // with 64, the sums for facets are wrong by 1 %
    for (int j = 0; j < kSteps * kSteps; ++j) {
        const double u1 = (j % kSteps + 0.5) / kSteps;
        if (const auto sample = sample_brdf(material, in, u1, (j / kSteps + 0.5) / kSteps))
            sum += sample->weight * (1.0 / (kSteps * kSteps));
    }
    return sum;
}

std::string name_of(const Material& material) { return std::string(type_name(material)); }

Vec3 direction_above(RandomPairs& random) {
    const auto [u1, u2] = random.next_pair();
    return math::sample_cosine_hemisphere(u1, u2).direction;
}

TEST(EveryModel, EvaluatesTheSameAtOnceAndApart) {
    RandomPairs random(4);
    for (const Material& material : scattering_of_every_model()) {
        for (int i = 0; i < 500; ++i) {
            const Vec3 out = direction_above(random);
            Vec3 in = direction_above(random);
            const auto [u1, u2] = random.next_pair();
            const auto sample = sample_brdf(material, out, u1, u2);
            if (sample && i % 2 == 0) in = sample->direction;
            const ScatterValue value = evaluate_and_pdf(material, in, out);
            ASSERT_EQ(value.brdf_per_sr, evaluate_brdf_per_sr(material, in, out)) << name_of(material);
            ASSERT_EQ(value.pdf_per_sr, pdf_per_sr(material, out, in)) << name_of(material);
            ASSERT_EQ(evaluate_and_pdf(material, -in, out).pdf_per_sr, 0) << name_of(material);
            ASSERT_EQ(evaluate_and_pdf(material, in, -out).brdf_per_sr, Rgb{}) << name_of(material);
        }
    }
}

TEST(EveryModel, IsReciprocalAndWeighsItsSamplesByThem) {
    RandomPairs random(5);
    for (const Material& material : scattering_of_every_model()) {
        for (int i = 0; i < 500; ++i) {
            const Vec3 in = direction_above(random);
            const auto [u1, u2] = random.next_pair();
            const auto sample = sample_brdf(material, in, u1, u2);
            if (!sample) continue;
            ASSERT_FALSE(is_specular(material));
            const Vec3& out = sample->direction;
            const Rgb forward = evaluate_brdf_per_sr(material, in, out);
            const Rgb backward = evaluate_brdf_per_sr(material, out, in);
            ASSERT_NEAR(pdf_per_sr(material, in, out), sample->pdf_per_sr, 1e-12 * sample->pdf_per_sr);
            for (std::size_t b = 0; b < kBands; ++b) {
                ASSERT_NEAR(forward[b], backward[b], 1e-10 * forward[b]) << name_of(material);
                ASSERT_NEAR(sample->weight[b], forward[b] * out.z / sample->pdf_per_sr,
                            1e-12 * sample->weight[b])
                    << name_of(material);
            }
        }
    }
}

TEST(EveryModel, ReflectsNoMoreThanArrives) {
    RandomPairs random(6);
    for (const Material& material : materials_of_every_model()) {
        for (int i = 0; i < 5; ++i) {
            const Vec3 in = direction_above(random);
            EXPECT_LE(sent_on(material, in).max(), 1.005) << name_of(material) << " at " << in.z;
        }
        EXPECT_LE(reflectance_bound(material).max(), 1 + 1e-12);
        EXPECT_GE(mean_concentration(material), 0);
    }
}

template <typename Call>
std::string refusal_of(const Call& call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// The parameter, or one of its components, out of its range.
void spoil(double& value, double wrong) { value = wrong; }
void spoil(Rgb& value, double wrong) { value[2] = wrong; }
void spoil(SharesByAngle& value, double wrong) { value = SharesByAngle::along_normal({{0.5, 0.5, wrong}}); }
template <std::size_t count>
void spoil(std::array<double, count>& values, double wrong) {
    values[2 % count] = wrong;
}
std::string suffix_of(double) { return ""; }
std::string suffix_of(const Rgb&) { return "[2]"; }
std::string suffix_of(const SharesByAngle&) { return "[2]"; }
template <std::size_t count>
std::string suffix_of(const std::array<double, count>&) {
    return fmt::format("[{}]", 2 % count);
}

TEST(EveryModel, RefusesEachParameterOutOfItsRange) {
    RandomPairs random(7);
    for_each_model([&]<typename M>() {
        using Parameters = ParametersOf<M>;
        for_each_field<Parameters>([&](const auto& field) {
            if constexpr (!std::is_same_v<decltype(field.member), bool Parameters::*>) {
                for (const double wrong :
                     {std::nextafter(field.range.min, -INFINITY), field.range.max + 1.0,
                      std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
                    Parameters parameters = drawn<Parameters>(random);
                    spoil(parameters.*field.member, wrong);
                    EXPECT_EQ(refusal_of([&] { make<M>(parameters, "materials.m"); }),
                              fmt::format("materials.m.{}{}: {} is not allowed. Allowed: {}.", field.key,
                                          suffix_of(parameters.*field.member), wrong, field.range.allowed));
                }
            }
        });
    });
}

TEST(EveryModel, HasATypeOfItsOwn) {
    const std::vector<std::string_view> names = type_names();
    EXPECT_EQ(names.size(), std::tuple_size_v<ModelList>);
    for (std::size_t i = 0; i < names.size(); ++i) {
        EXPECT_EQ(std::count(names.begin(), names.end(), names[i]), 1) << names[i];
    }
}

TEST(EveryModel, HasItsParametersInTheDocuments) {
    const auto path = source_directory() / "docs/materials.md";
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    const auto expect_row = [&](const std::string& row) {
        EXPECT_NE(text.str().find(row + "\n"), std::string::npos) << path << " has no row\n" << row;
    };
    for_each_model([&]<typename M>() {
        bool has_any = false;
        for_each_field<ParametersOf<M>>([&](const auto& field) {
            has_any = true;
            expect_row(fmt::format("| `{}` | `{}` | {:g} to {:g}{} | {} |", M::kType, field.key,
                                   field.range.min, field.range.max,
                                   field.presence == Presence::optional ? ", optional" : "", field.meaning));
        });
        if (!has_any) expect_row(fmt::format("| `{}` | | | |", M::kType));
    });
}

TEST(MaterialParameters, MustNotReflectMoreThanArrives) {
    const std::string message =
        "materials.desk: diffuse + specular is 1.1: no surface reflects more light than it receives. "
        "Allowed: at most 1 in each channel.";
    const Rgb diffuse{{0.1, 0.6, 0.1}}, specular = Rgb::grey(0.5);
    EXPECT_EQ(refusal_of([&] { validate(Phong{diffuse, specular, 10}, "materials.desk"); }), message);
    EXPECT_EQ(refusal_of([&] { make<Ward>({diffuse, specular, {0.1, 0.1}, 0}, "materials.desk"); }), message);
    EXPECT_NO_THROW(validate(Phong{Rgb::grey(0.7), Rgb::grey(0.3), 10}, "materials.desk"));
}

TEST(MaterialParameters, OfGreyColoursAreNamedAsOneNumber) {
    EXPECT_EQ(
        refusal_of([&] { validate(Diffuse{Rgb::grey(1.5)}, "materials.wall"); }),
        "materials.wall.reflectance: 1.5 is not allowed. Allowed: from 0 to 1 (no surface reflects more "
        "light than it receives).");
}

TEST(StatedReflectance, IsWhatIsReflectedAtNormalIncidence) {
    EXPECT_EQ(stated_reflectance(Diffuse{{{0.1, 0.2, 0.3}}}), (Rgb{{0.1, 0.2, 0.3}}));
    EXPECT_EQ(stated_reflectance(Mirror{Rgb::grey(0.9)}), Rgb::grey(0.9));
    EXPECT_EQ(stated_reflectance(Mirror{}), Rgb{});
    EXPECT_NEAR(stated_reflectance(Dielectric{1.5})[0], 0.04, 1e-15);
    EXPECT_EQ(stated_reflectance(Dielectric{1}), Rgb{});
    const ThinDielectric pane{1.52, Rgb::grey(0.96)};
    EXPECT_EQ(stated_reflectance(pane), pane.shares(1).reflectance);
    EXPECT_EQ(straight_transmittance(pane, 0.5), pane.shares(0.5).transmittance);
    EXPECT_TRUE(passes_straight(pane));
    EXPECT_FALSE(passes_straight(Dielectric{}));
}

}  // namespace
}  // namespace stilb::materials
