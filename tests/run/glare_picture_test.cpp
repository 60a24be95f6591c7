// The sum over the bright pixels of a view, with noise: it is that without noise.
#include "run/glare/glare_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/random.h"
#include "run/run.h"
#include "statistics/hypothesis.h"
#include "statistics/interval.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

constexpr double kThreshold = 1000;

/// A wall of 200 cd/m2 with a window of 3000 cd/m2 in it; each replicate's luminance is exact times an
/// exponential deviate of mean 1, mixed with the exact value: a relative standard deviation of `noise`.
EyePicture noisy_picture(double noise, std::uint64_t seed) {
    constexpr int width = 32;
    EyePicture picture{width, {}, {}, {}};
    const math::RandomKey key{seed};
    for (int i = 0; i < width * width; ++i) {
        const int x = i % width, y = i / width;
        const bool is_window = x >= 8 && x < 16 && y >= 4 && y < 14;
        picture.solid_angles_sr.push_back(0.001);
        picture.weights_sr.push_back(0.001 / (1 + 0.1 * y));
        math::SampleStream stream(key, static_cast<std::uint64_t>(i));
        auto& luminances = picture.luminances_cd_m2.emplace_back();
        for (std::size_t r = 0; r < kGlareReplicates; r += 2) {
            const auto pair = stream.next_two();
            for (std::size_t k = 0; k < 2; ++k) {
                const double deviate = -std::log(1 - pair[k]);
                luminances[r + k] =
                    static_cast<float>((is_window ? 3000 : 200) * (1 + noise * (deviate - 1)));
            }
        }
    }
    return picture;
}

double exact_sum() {
    double sum = 0;
    for (int y = 4; y < 14; ++y) sum += 8 * 3000.0 * 3000.0 * 0.001 / (1 + 0.1 * y);
    return sum;
}

TEST(GlareAbove, IsExactWithoutNoise) {
    // Dark pixels beside the window are selected with it, and add their own small luminance.
    for (const double pseudo_value : glare_above(noisy_picture(0, 1), kThreshold)) {
        EXPECT_GE(pseudo_value, exact_sum());
        EXPECT_LE(pseudo_value, 1.002 * exact_sum());
    }
    EXPECT_NEAR(noisy_picture(0, 1).mean_luminance_cd_m2(), 200 + 2800 * 80.0 / 1024, 1e-3);
}

/// Replicates as noisy as 100 %: noise adds nothing, and the intervals cover.
TEST(GlareAbove, IsUnbiasedAndCoversAtEveryNoise) {
    const double exact = glare_above(noisy_picture(0, 1), kThreshold)[0];
    for (const double noise : {0.1, 0.3, 1.0}) {
        constexpr int kSeeds = 400;
        int covered = 0;
        double sum = 0, squares = 0;
        for (int seed = 1; seed <= kSeeds; ++seed) {
            const statistics::Estimate estimate =
                statistics::estimate_from_replicates(glare_above(noisy_picture(noise, seed), kThreshold));
            covered += estimate.lower <= exact && exact <= estimate.upper;
            sum += estimate.value;
            squares += estimate.value * estimate.value;
        }
        const double mean = sum / kSeeds;
        const double error = std::sqrt((squares / kSeeds - mean * mean) / kSeeds);
        EXPECT_LT(std::abs(mean - exact), std::max(4 * error, 1e-9)) << noise;
        // What is left: with much noise, some corners of the window fall below the threshold.
        EXPECT_LT(std::abs(mean / exact - 1), 0.002 + 0.01 * noise * noise) << noise;
        EXPECT_GE(covered, 0.915 * kSeeds) << noise;
        EXPECT_LE(covered, 0.985 * kSeeds) << noise;
    }
}

/// A view in which nothing is bright has no glare, whatever the noise; the naive sum over noisy pixels has.
TEST(GlareAbove, MakesNoSourcesOfNoise) {
    double with_noise = 0, naive = 0;
    constexpr double threshold = 5000;
    for (int seed = 1; seed <= 50; ++seed) {
        const EyePicture picture = noisy_picture(1, seed);
        for (const double pseudo_value : glare_above(picture, threshold))
            with_noise += pseudo_value / kGlareReplicates / 50;
        for (std::size_t i = 0; i < picture.weights_sr.size(); ++i) {
            const double first = picture.luminances_cd_m2[i][0];
            if (first > threshold) naive += picture.weights_sr[i] * first * first / 50;
        }
    }
    EXPECT_GT(naive, 0.4 * exact_sum());
    EXPECT_LT(with_noise, 0.01 * exact_sum());
}

/// A lamp is left to its own sum; the pixels of the rest keep the solid angle of the half space.
TEST(EyePicture, LeavesLampsOut) {
    Scene scene;
    add_environment(scene, Rgb::grey(100));
    add_area_light(scene, Disk{{0, 3, 1.2}, {0, -1, 0}, 0.5}, Rgb::grey(5000));
    const rays::RayCaster caster(scene);
    const EyePicture picture = picture_at(
        {{0, 0, 1.2}, {0, 1, 0}}, {scene, caster, std::numeric_limits<int>::max(), 1, Monitor::none()});
    double all_sr = 0, weighted_sr = 0, lamp_sr = 0;
    for (std::size_t i = 0; i < picture.solid_angles_sr.size(); ++i) {
        all_sr += picture.solid_angles_sr[i];
        weighted_sr += picture.weights_sr[i];
        if (picture.weights_sr[i] == 0) lamp_sr += picture.solid_angles_sr[i];
    }
    EXPECT_NEAR(all_sr, 2 * kPi, 0.005 * 2 * kPi);
    EXPECT_LT(weighted_sr, all_sr);
    const double exact_sr = 2 * kPi * (1 - 3 / std::hypot(3, 0.5));
    EXPECT_GT(lamp_sr, exact_sr);  // pixels on its edge are left out as a whole
    EXPECT_LT(lamp_sr, 1.2 * exact_sr);
    const double mean = (100 * (2 * kPi - exact_sr) + 5000 * exact_sr) / (2 * kPi);
    EXPECT_NEAR(picture.mean_luminance_cd_m2(), mean, 0.005 * mean);
}

}  // namespace
}  // namespace stilb::run
