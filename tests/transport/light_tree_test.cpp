#include "transport/light_tree.h"

#include <gtest/gtest.h>

#include <cmath>

#include "statistics/hypothesis.h"
#include "statistics/interval.h"
#include "support/scene_builder.h"
#include "transport/light_sampler.h"

namespace stilb::transport {
namespace {

constexpr std::uint64_t kSamples = 1 << 16;
constexpr int kReplicates = 32;

double unit(std::uint64_t i, std::uint64_t what) {
    return math::SampleStream(math::RandomKey{17}.derived(what), i).next();
}

/// Points and balls of very different flux in a hall of 40 x 10 x 4 m.
Scene hall(int count) {
    Scene scene;
    for (int n = 0; n < count; ++n) {
        const auto i = static_cast<std::uint64_t>(n);
        const Vec3 position{40 * unit(i, 0), 10 * unit(i, 1), 4 * unit(i, 2)};
        const double level = std::pow(10, 2 * unit(i, 3));
        if (n % 3 == 0) {
            add_area_light(scene, Sphere{position, 0.05 + 0.1 * unit(i, 4)}, Rgb::grey(100 * level));
        } else {
            add_point_light(scene, position, Rgb::grey(level));
        }
    }
    return scene;
}

std::vector<LightTree::Light> leaves(int count) {
    std::vector<LightTree::Light> lights;
    for (int n = 0; n < count; ++n) {
        const auto i = static_cast<std::uint64_t>(n);
        Bounds bounds;
        bounds.include({8 * unit(i, 0), 4 * unit(i, 1), 3 * unit(i, 2)});
        lights.push_back({static_cast<std::uint32_t>(n), bounds, 1 + 20 * unit(i, 3), true});
    }
    return lights;
}

/// What a point gives; one light in five shines elsewhere.
double rough_lx(const LightTree::Light& light, const Vec3& from, const Vec3& normal) {
    const Vec3 towards = light.bounds.min - from;
    if (light.number % 5 == 0) return 0;
    return light.intensity_cd * std::max(dot(towards, normal), 0.0) / std::pow(length(towards), 3);
}

/// The view of a surface element.
struct ElementView {
    const std::vector<LightTree::Light>& lights;
    SurfacePoint at;
    double nearness(const LightTree::Node& node) const { return LightTree::nearness_of(node, at.position); }
    double estimate_lx(const LightTree::Node& node) const {
        return node.is_point ? rough_lx(lights[node.first], at.position, at.normal)
                             : LightTree::box_lx(node, at);
    }
};

TEST(LightTree, LightsAreChosenWithTheProbabilityThatIsSaid) {
    constexpr int kLights = 300;
    const std::vector<LightTree::Light> lights = leaves(kLights);
    const LightTree tree(lights);
    for (const Vec3& from : {Vec3{3, 2, 1}, Vec3{-30, 2, 1}}) {  // among them, and far away
        const Vec3 normal = normalized(Vec3{0.5, 0.2, 1});
        const ElementView view{lights, {from, normal}};
        const LightTree::Cut cut = tree.cut(view);
        std::vector<double> probability, observed(kLights), remainders;
        double sum = 0;
        for (std::uint32_t light = 0; light < kLights; ++light) {
            probability.push_back(tree.probability(cut, light, view));
            sum += probability.back();
            EXPECT_TRUE(probability.back() > 0 || rough_lx(lights[light], from, normal) == 0) << light;
        }
        EXPECT_NEAR(sum, 1, 1e-12);
        for (std::uint64_t i = 0; i < kSamples; ++i) {
            const double u = math::SampleStream(math::RandomKey{2}.derived(i), 0).next();
            const math::DiscreteChoice choice = tree.choose(cut, view, u);
            ASSERT_NEAR(choice.probability, probability[choice.index], 1e-9);
            ++observed[choice.index];
            remainders.push_back(choice.remainder);
        }
        std::vector<double> counts, expected;
        for (std::size_t light = 0; light < kLights; ++light) {
            if (probability[light] * kSamples < 5) continue;
            expected.push_back(probability[light] * kSamples);
            counts.push_back(observed[light]);
        }
        double rest = kSamples, rest_observed = kSamples;
        for (std::size_t i = 0; i < counts.size(); ++i) rest -= expected[i], rest_observed -= counts[i];
        if (rest > 5) expected.push_back(rest), counts.push_back(rest_observed);
        EXPECT_GT(counts.size(), 20u);
        EXPECT_GT(statistics::chi2_test(counts, expected).p_value, 1e-4);
        EXPECT_GT(statistics::uniformity_p(remainders), 1e-4);
    }
}

TEST(LightTree, GivesNothingBehindTheSurface) {
    const std::vector<LightTree::Light> lights = leaves(100);
    const LightTree tree(lights);
    const Vec3 from{0, 0, 4}, up{0, 0, 1};
    const auto total_lx = [&](const Vec3& normal) {
        return tree.cut(ElementView{lights, {from, normal}}).total_lx();
    };
    EXPECT_EQ(total_lx(up), 0);
    EXPECT_GT(total_lx(-up), 0);
    EXPECT_EQ(LightTree().cut(ElementView{lights, {from, up}}).total_lx(), 0);
}

/// One light of many, divided by its probability, against all of them.
TEST(ManyLights, OneThatIsChosenIsAllOfThem) {
    for (const bool has_sky : {false, true}) {
        Scene scene = hall(120);
        if (has_sky) add_sky(scene);
        const rays::RayCaster caster(scene);
        const LightSampler lights(scene, caster);
        const Vec3 normal = normalized(Vec3{0.2, -0.1, 1});
        for (const Vec3& from : {Vec3{20, 5, 0}, Vec3{1, 9, 2}, Vec3{45, -3, 1}}) {
            const auto lit = [&](const std::optional<IncidentLight>& light) {
                return light ? std::max(0.0, dot(light->direction, normal)) *
                                   light->normal_illuminance_lx.luminance()
                             : 0;
            };
            std::vector<double> one, all;
            for (std::uint64_t replicate = 0; replicate < kReplicates; ++replicate) {
                double sum_of_one = 0, sum_of_all = 0;
                constexpr std::uint64_t kPoints = 1024;
                for (std::uint64_t i = 0; i < kPoints; ++i) {
                    math::SampleStream stream(math::RandomKey{replicate}, i);
                    const auto light = lights.sample_one_light({from, normal}, stream);
                    sum_of_one += lit(light) / kPoints;
                }
                constexpr std::uint64_t kFew = 64;
                for (std::uint64_t i = 0; i < kFew; ++i) {
                    math::SampleStream stream(math::RandomKey{replicate}.derived(1), i);
                    for (std::size_t j = 0; j < lights.count(); ++j)
                        sum_of_all +=
                            lit(lights.sample_incident(j, {from, normal}, stream.next_two())) / kFew;
                }
                one.push_back(sum_of_one), all.push_back(sum_of_all);
            }
            const auto chosen = statistics::estimate_from_replicates(one);
            const auto summed = statistics::estimate_from_replicates(all);
            EXPECT_LT(std::abs(statistics::equivalent_z(z_score(chosen, summed), kReplicates - 1)), 4)
                << chosen.value << ' ' << summed.value;
            EXPECT_LT(chosen.standard_error, 0.01 * chosen.value);
        }
    }
}

TEST(ManyLights, TheDensityOfAnEmitterIsThatOfItsSamples) {
    Scene scene = hall(120);
    add_sky(scene);
    const rays::RayCaster caster(scene);
    const LightSampler lights(scene, caster);
    const Vec3 from{20, 5, 0}, normal{0, 0, 1};
    int emitters = 0, sky = 0;
    for (std::uint64_t i = 0; i < 4096; ++i) {
        math::SampleStream stream(math::RandomKey{3}, i);
        const auto light = lights.sample_one_light({from, normal}, stream);
        if (!light || std::isinf(light->pdf_per_sr)) continue;
        const auto hit = caster.closest(from, light->direction);
        if (!hit) {
            ++sky;
            EXPECT_NEAR(lights.outside_pdf_per_sr(light->direction, {from, normal}), light->pdf_per_sr,
                        1e-9 * light->pdf_per_sr);
        } else if (length(hit->lifted - light->source_point) < 1e-3) {
            ++emitters;
            lights.for_each_emission(*hit, -light->direction, [&](std::size_t own, const Rgb&) {
                EXPECT_NEAR(lights.pdf_per_sr(own, *hit, {from, normal}), light->pdf_per_sr,
                            1e-6 * light->pdf_per_sr);
            });
        }
    }
    EXPECT_GT(emitters, 100);
    EXPECT_GT(sky, 100);
}

}  // namespace
}  // namespace stilb::transport
