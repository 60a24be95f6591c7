// The passes of a picture, and the paces of its cells, with a method whose means and errors are made up.
#include "run/pictures/passes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

#include "statistics/hypothesis.h"
#include "stilb/error.h"

namespace stilb::run {
namespace {

using estimators::Pass;
using estimators::PixelBlock;

/// A sample at a pixel, from a number in [0, 1).
using LuminanceOfPass = std::function<double(const Pass&, int x, double u)>;

/// Pixels of the mean 100, in each sample with a deviation of their own. Keeps account of the samples.
class MadeUpPicture final : public estimators::Estimator {
  public:
    explicit MadeUpPicture(LuminanceOfPass luminance) : luminance_(std::move(luminance)) {}

    std::string_view technique() const override { return "made up"; }
    void run_batch(const estimators::Batch&, estimators::Tally&) const override {}
    std::span<const Rgb> known_part() const override { return {}; }
    std::span<const std::optional<Vec3>> sight_ends() const override { return {}; }
    std::uint64_t batch_granularity() const override { return 1; }
    double rays_per_sample() const override { return 1; }
    std::vector<std::string> warnings() const override { return {}; }
    std::unique_ptr<const estimators::PicturePass> start(const Pass& pass) const override {
        return std::make_unique<MadeUpPass>(*this, pass);
    }

    /// The numbers of the samples that a replicate has taken at a pixel, in order.
    const std::vector<std::uint64_t>& numbers(std::uint64_t replicate, int x, int y) const {
        return numbers_[{replicate, x, y}];
    }

  private:
    class MadeUpPass final : public estimators::PicturePass {
      public:
        MadeUpPass(const MadeUpPicture& picture, const Pass& pass) : picture_(picture), pass_(pass) {}

        void sample(const PixelBlock& block, estimators::Tally& sums) const override {
            const std::lock_guard lock(picture_.mutex_);
            for (std::size_t i = 0; i < block.pixels(); ++i) {
                const int x = block.left + static_cast<int>(i) % block.width;
                const int y = block.top + static_cast<int>(i) / block.width;
                picture_.numbers_[{pass_.replicate, x, y}].push_back(pass_.index);
                const auto pixel = static_cast<std::uint64_t>(1000 * y + x);
                const double u = math::SampleStream(pass_.key.key.derived(pixel), pass_.index, 0).next();
                sums.add(i, Rgb::grey(picture_.luminance_(pass_, x, u)));
            }
        }

      private:
        const MadeUpPicture& picture_;
        Pass pass_;
    };

    LuminanceOfPass luminance_;
    mutable std::mutex mutex_;
    mutable std::map<std::tuple<std::uint64_t, int, int>, std::vector<std::uint64_t>> numbers_;
};

constexpr std::array<int, 2> kResolution{64, 32};
RunPlan plan_with_paces(std::uint64_t seed) { return {"made up", seed, 4, true, true}; }

/// Large deviations on the left, small ones on the right.
double deviation(int x) { return x < 21 ? 50 : 10; }
double two_halves(const Pass&, int x, double u) { return 100 + deviation(x) * std::sqrt(12) * (u - 0.5); }

/// A picture after so many passes of each replicate.
struct Finished {
    Finished(LuminanceOfPass luminance, std::uint64_t rounds, std::uint64_t seed = 1,
             const std::array<int, 2>& resolution = kResolution)
        : Finished(std::move(luminance), rounds, resolution, plan_with_paces(seed)) {}
    Finished(LuminanceOfPass luminance, std::uint64_t rounds, const std::array<int, 2>& resolution,
             const RunPlan& plan)
        : picture(std::move(luminance)),
          blind(static_cast<std::size_t>(resolution[0]) * static_cast<std::size_t>(resolution[1])),
          sums(resolution, plan),
          passes(picture, blind, sums, nullptr, Monitor::none(), nullptr) {
        for (std::uint64_t p = 0; p < plan.replicates * rounds; ++p) passes.advance(1);
    }

    MadeUpPicture picture;
    std::vector<bool> blind;
    PictureSums sums;
    Passes passes;
};

TEST(Passes, TakeFewerSamplesWhereTheErrorIsSmall) {
    const Finished all(two_halves, 32);
    for (std::uint64_t r = 0; r < 4; ++r) {
        EXPECT_EQ(all.picture.numbers(r, 0, 5).size(), 32u);
        EXPECT_EQ(all.picture.numbers(r, 63, 5).size(),
                  4u);  // a 25th of the variance, an eighth with reserve
    }
    const double mean = all.sums.samples_per_pixel(all.blind);
    EXPECT_GT(mean, 4 * 8);
    EXPECT_LT(mean, 4 * 28);
}

TEST(Passes, NumberTheSamplesOfPixelsWithoutGaps) {
    const Finished all(two_halves, 24);
    for (std::uint64_t r = 0; r < 4; ++r) {
        for (int x = 0; x < kResolution[0]; ++x) {
            std::uint64_t next = 0;
            for (const std::uint64_t number : all.picture.numbers(r, x, 7)) EXPECT_EQ(number, next++);
        }
    }
}

TEST(Passes, TakeAllSamplesWithoutPaces) {
    const Finished all(two_halves, 16, kResolution, {"made up", 1, 4, true, false});
    EXPECT_EQ(all.picture.numbers(2, 63, 5).size(), 16u);
    EXPECT_EQ(all.sums.samples_per_pixel(all.blind), 64);
}

/// Whatever a replicate finds: the numbers of its samples stay, those of the others change.
TEST(Passes, PacesFollowFromTheOtherReplicatesAlone) {
    const Finished before(two_halves, 32);
    for (std::uint64_t changed = 0; changed < 4; ++changed) {
        const Finished after(
            [&](const Pass& pass, int x, double u) {
                return pass.replicate == changed && x >= 40 ? 1e4 * u : two_halves(pass, x, u);
            },
            32);
        bool others_differ = false;
        for (int x = 0; x < kResolution[0]; ++x) {
            EXPECT_EQ(before.picture.numbers(changed, x, 3), after.picture.numbers(changed, x, 3));
            const std::uint64_t other = (changed + 1) % 4;
            others_differ |= before.picture.numbers(other, x, 3) != after.picture.numbers(other, x, 3);
        }
        EXPECT_TRUE(others_differ);
    }
}

/// Exponential samples: their spread tells much of their mean, so that a pace which followed from the
/// replicate's own samples, or a weight, would show.
double skewed(const Pass&, int x, double u) { return 100 + (x < 10 ? 100 : 30) * (-std::log(1 - u) - 1); }

TEST(Passes, KeepTheExpectation) {
    std::vector<double> means;
    double samples = 0;
    constexpr std::uint64_t seeds = 8000;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const Finished all(skewed, 16, seed, {20, 1});
        double sum = 0;
        for (std::size_t i = 0; i < 20; ++i) sum += all.sums.luminance_cd_m2(i);
        means.push_back(sum / 20);
        samples += all.sums.samples_per_pixel(all.blind) / seeds;
    }
    EXPECT_LT(samples, 58) << "some of the 64 samples are saved";
    const statistics::Estimate mean = statistics::estimate_from_replicates(means);
    EXPECT_LT(mean.standard_error, 0.1);
    EXPECT_LT(std::abs(mean.value - 100), 3.5 * mean.standard_error)
        << mean.value << " +- " << mean.standard_error;
}

/// Neighbours have as large errors of a sample, but other numbers of samples.
TEST(Passes, ErrorsHoldWhereTheNumberOfSamplesChanges) {
    double stated = 0, expected = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        const Finished all(two_halves, 32, seed);
        const Pixels pixels = all.sums.pixels();
        for (int y = 0; y < kResolution[1]; ++y) {
            for (int x = 24; x < kResolution[0] - 1; ++x) {
                const auto samples = [&](std::uint64_t r, int at) {
                    return static_cast<double>(all.picture.numbers(r, at, y).size());
                };
                if (samples(0, x) == samples(0, x + 1)) continue;
                for (std::uint64_t r = 0; r < 4; ++r) {
                    expected += std::pow(deviation(x), 2) / samples(r, x) / 16;
                    expected += std::pow(deviation(x + 1), 2) / samples(r, x + 1) / 16;
                }
                const std::size_t pixel = static_cast<std::size_t>(y * kResolution[0] + x);
                stated += std::pow(double{pixels.standard_error_cd_m2[pixel]}, 2) +
                          std::pow(double{pixels.standard_error_cd_m2[pixel + 1]}, 2);
            }
        }
    }
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(stated / expected, 1, 0.1);
}

TEST(Passes, LeaveOutAnUnfinishedOne) {
    bool is_over = false;
    Finished all(
        [&](const Pass& pass, int x, double u) {
            if (is_over && x == 20) throw Cancelled("by the monitor");
            return two_halves(pass, x, u);
        },
        8);
    const Pixels before = all.sums.pixels();
    is_over = true;
    EXPECT_THROW(all.passes.advance(1), Cancelled);
    EXPECT_EQ(all.passes.samples(), 32u);
    EXPECT_EQ(all.sums.pixels().rgb_cd_m2, before.rgb_cd_m2);
    EXPECT_EQ(all.sums.pixels().standard_error_cd_m2, before.standard_error_cd_m2);
}

}  // namespace
}  // namespace stilb::run
