// Channels: what readings consist of, by groups of lights and by numbers of reflections.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "estimators/estimates.h"
#include "estimators/estimator_list.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "materials/thin_dielectric.h"
#include "support/scene_builder.h"

namespace stilb::estimators {
namespace {

using transport::Channels;

/// Two lamps with an area, one of them seen in a mirror and one behind a pane, three points, and gloss.
Scene furnished_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.5}}, Diffuse{{{0.7, 0.5, 0.3}}});
    add_object(scene, Box{{2.4, 1.2, 0.001}, {3.2, 2, 0.8}}, Phong{Rgb::grey(0.3), Rgb::grey(0.4), 40});
    add_object(scene, Rectangle{{0.3, 0.001, 0.5}, {1.5, 0, 0}, {0, 0, 1.5}},
               materials::Mirror{Rgb::grey(0.8)});
    add_object(scene, Rectangle{{3.5, 0.5, 0.2}, {0, 2, 0}, {0, 0, 2}},
               materials::ThinDielectric{1.5, Rgb::grey(0.9)});
    add_area_light(scene, Rectangle{{1.1, 1.1, 2.49}, {0, 0.6, 0}, {0.6, 0, 0}}, Rgb::grey(3000));
    add_area_light(scene, Rectangle{{3.95, 1, 0.8}, {0, 0, 0.7}, {0, 0.7, 0}}, {{500, 1000, 2000}});
    add_point_light(scene, {0.6, 2.4, 2}, Rgb::grey(120));
    add_point_light(scene, {2.1, 0.5, 2.2}, {{150, 90, 40}});
    add_point_light(scene, {2.9, 2.5, 1.6}, Rgb::grey(60));
    return scene;
}

/// By light: of two groups.
const std::vector<std::uint32_t> kGroups{0, 1, 0, 1, 1};
constexpr std::size_t kOrders = 4;

Scene with_lights_of(Scene scene, std::size_t group) {
    const std::vector<Light> all = std::exchange(scene.lights, {});
    for (std::size_t i = 0; i < kGroups.size(); ++i) {
        if (kGroups[i] == group) scene.lights.push_back(all[i]);
    }
    return scene;
}

std::vector<Measurand> readings() {
    return {MeasuringPoint{{1, 1, 0}, {0, 0, 1}},
            MeasuringPoint{{2.2, 1.6, 0.3}, {-1, 0, 0}},
            MeasuringPoint{{3.7, 1.5, 1.2}, {-1, 0, 0}},
            LineOfSight{{0.5, 2.5, 1.5}, normalized(Vec3{1, -0.6, -0.3})},
            LineOfSight{{0.5, 2.5, 1.5}, normalized(Vec3{2.4, -0.8, -1.1})},
            LineOfSight{{1.4, 1.4, 1}, normalized(Vec3{0, 0.02, 1})},
            LineOfSight{{1.4, 2, 1.4}, normalized(Vec3{-0.1, -1, 0.1})}};
}

/// Replicates x values (one for each reading, band by band), and likewise for each channel.
struct Sampled {
    std::vector<std::vector<Rgb>> whole, parts;
};
Sampled sampled(const Estimator& method, std::size_t count, std::size_t channels, std::uint64_t samples,
                std::uint64_t seed) {
    Sampled all{std::vector<std::vector<Rgb>>(kReplicates), std::vector<std::vector<Rgb>>(kReplicates)};
    const std::uint64_t unit = method.batch_granularity(), each = (samples + unit - 1) / unit * unit;
    parallel_for(kReplicates, [&](std::size_t r) {
        Tally sums(count, 0, channels);
        method.run_batch({math::RandomKey{seed}.derived(r), 0, each}, sums);
        const double share = 1 / static_cast<double>(each);
        for (std::size_t j = 0; j < count; ++j)
            all.whole[r].push_back(method.known_part()[j] + sums.sum[j] * share);
        for (std::size_t i = 0; i < channels * count; ++i)
            all.parts[r].push_back(method.known_parts()[i] + sums.parts[i] * share);
    });
    return all;
}

Problem problem_of(const Scene& scene, const rays::RayCaster& caster, std::span<const Measurand> measurands,
                   int max_reflections = transport::kUnlimited, const Channels* channels = nullptr) {
    return {.scene = scene,
            .caster = caster,
            .max_reflections = max_reflections,
            .preparation_key = {math::RandomKey{1}},
            .measurands = measurands,
            .channels = channels};
}

class ChannelsOf : public testing::TestWithParam<const char*> {
  protected:
    const EstimatorEntry& method_ = find_estimator(GetParam());
    Scene scene_ = furnished_room();
    rays::RayCaster caster_{scene_};
    std::vector<Measurand> readings_ = readings();
    /// A sample of guided light is 32 paths of its residual.
    std::uint64_t samples_ = method_.name == "guided" ? 1 << 5 : method_.name == "path" ? 1 << 10 : 1 << 12;
    Channels channels_{{{"first", "second"}, kGroups}, kOrders};
};

TEST_P(ChannelsOf, AddUpToTheWhole) {
    // The guess is in single precision.
    const double tolerance = method_.name == "guided" ? 1e-5 : 1e-9;
    const auto method =
        method_.make(problem_of(scene_, caster_, readings_, transport::kUnlimited, &channels_));
    const Sampled all = sampled(*method, readings_.size(), channels_.count(), samples_, 3);
    for (std::size_t r = 0; r < kReplicates; ++r) {
        for (std::size_t j = 0; j < readings_.size(); ++j) {
            Rgb sum;
            for (std::size_t c = 0; c < channels_.count(); ++c) sum += all.parts[r][c * readings_.size() + j];
            for (std::size_t b = 0; b < kBands; ++b)
                EXPECT_NEAR(sum[b], all.whole[r][j][b], tolerance * all.whole[r][j][b]) << r << ", " << j;
        }
    }
}

/// Of guided light they change the probabilities of random choices, but by little.
TEST_P(ChannelsOf, ChangeNoReading) {
    if (method_.name == "guided") return;
    const auto with = method_.make(problem_of(scene_, caster_, readings_, transport::kUnlimited, &channels_)),
               without = method_.make(problem_of(scene_, caster_, readings_));
    const Sampled a = sampled(*with, readings_.size(), channels_.count(), 1 << 10, 3),
                  b = sampled(*without, readings_.size(), 0, 1 << 10, 3);
    for (std::size_t r = 0; r < kReplicates; ++r) {
        for (std::size_t j = 0; j < readings_.size(); ++j)
            EXPECT_NEAR(a.whole[r][j].luminance(), b.whole[r][j].luminance(),
                        1e-5 * b.whole[r][j].luminance());
    }
}

/// A group's light after so many reflections at most is that of a scene with its lights alone.
TEST_P(ChannelsOf, AreTheLightOfTheirGroupsAndReflections) {
    const auto method =
        method_.make(problem_of(scene_, caster_, readings_, transport::kUnlimited, &channels_));
    const std::size_t count = readings_.size();
    const Sampled all = sampled(*method, count, channels_.count(), samples_, 5);
    for (std::size_t group = 0; group < 2; ++group) {
        const Scene alone = with_lights_of(scene_, group);
        const rays::RayCaster caster(alone);
        for (std::size_t order = 0; order < kOrders; ++order) {
            const int most = order + 1 < kOrders ? static_cast<int>(order) : transport::kUnlimited;
            const auto reference = method_.make(problem_of(alone, caster, readings_, most));
            const Sampled expected = sampled(*reference, count, 0, samples_, 6);
            std::vector<double> found, of_reference;
            for (std::size_t r = 0; r < kReplicates; ++r) {
                for (std::size_t j = 0; j < count; ++j) {
                    Rgb sum;
                    for (std::size_t o = 0; o <= order; ++o)
                        sum += all.parts[r][(group * kOrders + o) * count + j];
                    found.push_back(sum.luminance());
                    of_reference.push_back(expected.whole[r][j].luminance());
                }
            }
            const auto a = statistics::estimate_readings({found, count}),
                       b = statistics::estimate_readings({of_reference, count});
            for (std::size_t j = 0; j < count; ++j) {
                EXPECT_LT(distance_of(a[j], b[j]), 4)
                    << "group " << group << ", up to " << order << " reflections, reading " << j << ": "
                    << a[j].value << " +- " << a[j].standard_error << ", alone " << b[j].value << " +- "
                    << b[j].standard_error;
            }
        }
    }
}

Camera camera() {
    Camera camera;
    camera.position = {0.4, 2.6, 1.6};
    camera.target = {2.6, 1, 0.7};
    camera.fov_deg = 80;
    camera.resolution = {16, 12};
    return camera;
}

/// Passes x channels (or one value for the whole) of the mean luminance of a picture.
std::vector<std::vector<double>> picture_means(const Estimator& method, std::size_t channels,
                                               std::uint64_t passes, math::RandomKey key) {
    std::vector<std::vector<double>> means(passes);
    parallel_for(passes, [&](std::size_t p) {
        const auto pass = method.start({key.derived(p), 0, p});
        const std::vector<PixelBlock> blocks = blocks_of(camera().resolution);
        means[p].resize(1 + channels);
        for (const PixelBlock& block : blocks) {
            Tally sums(block.pixels(), 0, channels);
            pass->sample(block, sums);
            for (std::size_t i = 0; i < block.pixels(); ++i) {
                Rgb all;
                means[p][0] += sums.sum[i].luminance();
                for (std::size_t c = 0; c < channels; ++c) {
                    all += sums.parts[c * block.pixels() + i];
                    means[p][1 + c] += sums.parts[c * block.pixels() + i].luminance();
                }
                if (channels == 0) continue;
                EXPECT_NEAR(all.luminance(), sums.sum[i].luminance(),
                            1e-5 * std::abs(sums.sum[i].luminance()) + 1e-4);
            }
        }
    });
    return means;
}

TEST_P(ChannelsOf, OfPicturesAddUpAndAreTheLightOfTheirGroups) {
    Problem problem = problem_of(scene_, caster_, {}, transport::kUnlimited, &channels_);
    problem.camera = camera();
    constexpr std::uint64_t passes = 32;
    const auto all = picture_means(*method_.make(problem), channels_.count(), passes, math::RandomKey{5});
    for (std::size_t group = 0; group < 2; ++group) {
        const Scene alone = with_lights_of(scene_, group);
        const rays::RayCaster caster(alone);
        Problem of_group = problem_of(alone, caster, {});
        of_group.camera = camera();
        const auto reference = picture_means(*method_.make(of_group), 0, passes, math::RandomKey{6});
        std::vector<double> found, expected;
        for (std::uint64_t p = 0; p < passes; ++p) {
            double sum = 0;
            for (std::size_t order = 0; order < kOrders; ++order) sum += all[p][1 + group * kOrders + order];
            found.push_back(sum);
            expected.push_back(reference[p][0]);
        }
        const auto a = statistics::estimate_from_replicates(found),
                   b = statistics::estimate_from_replicates(expected);
        EXPECT_LT(std::max(a.standard_error, b.standard_error), 0.05 * b.value);
        EXPECT_LT(distance_of(a, b), 4) << "group " << group << ": " << a.value << " +- " << a.standard_error
                                        << ", alone " << b.value << " +- " << b.standard_error;
    }
}

std::string name_of(const testing::TestParamInfo<const char*>& technique) {
    std::string name;
    for (const char letter : std::string(technique.param)) {
        if (letter != '-') name += letter;
    }
    return name;
}
INSTANTIATE_TEST_SUITE_P(Techniques, ChannelsOf, testing::Values("path", "light-paths", "guided"), name_of);

/// Whatever `auto` chooses, for few readings and for many, has the channels; pilots have none.
TEST(Channels, AreThoseOfWhatAutoChooses) {
    const Scene scene = furnished_room();
    const rays::RayCaster caster(scene);
    const Channels channels{{{"first", "second"}, kGroups}, kOrders};
    std::vector<Measurand> many;
    for (int i = 0; i < 80; ++i)
        many.push_back(MeasuringPoint{{0.5 + 0.03 * i, 0.5 + 0.1 * (i % 20), 0.9}, {0, 0, 1}});
    for (const std::vector<Measurand>& measurands : {readings(), many}) {
        const auto method = find_estimator("auto").make(
            problem_of(scene, caster, measurands, transport::kUnlimited, &channels));
        ASSERT_EQ(method->known_parts().size(), channels.count() * measurands.size()) << method->technique();
        const std::uint64_t samples = 4 * method->batch_granularity();
        Tally sums(measurands.size(), 0, channels.count());
        method->run_batch({math::RandomKey{3}, 0, samples}, sums);
        Rgb whole, parts;
        for (const Rgb& sum : sums.sum) whole += sum;
        for (const Rgb& part : sums.parts) parts += part;
        EXPECT_GT(whole.luminance(), 0);
        EXPECT_NEAR(parts.luminance(), whole.luminance(), 1e-5 * whole.luminance()) << method->technique();
    }
}

TEST(Channels, AreNoneWherePatchesStoreTheLight) {
    const Scene scene = furnished_room();
    const rays::RayCaster caster(scene);
    const Channels channels{{{"first", "second"}, kGroups}, kOrders};
    const std::vector<Measurand> measurands = readings();
    Problem problem = problem_of(scene, caster, measurands, transport::kUnlimited, &channels);
    problem.camera = camera();
    problem.patches.patch_m = 1;
    const auto expect_none = [&](std::string_view name) {
        const auto method = find_estimator(name).make(problem);
        EXPECT_TRUE(method->known_parts().empty()) << name;
        const PixelBlock block{0, 0, 4, 4};
        Tally sums(block.pixels(), 0, channels.count());
        method->start({math::RandomKey{5}, 0, 0})->sample(block, sums);
        EXPECT_GT(sums.sum[5].luminance(), 0) << name;
        for (const Rgb& part : sums.parts) EXPECT_EQ(part, Rgb{}) << name;
    };
    expect_none("ray-bundle");
    problem.patches.first_shot.variant = FirstShotVariant::classical;
    expect_none("path");
}

}  // namespace
}  // namespace stilb::estimators
