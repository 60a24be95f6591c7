#include "efficiency.h"

#include <algorithm>
#include <ctime>

#include "statistics/interval.h"

namespace stilb {
namespace {

constexpr std::uint64_t kRounds = 16;
constexpr double kRound_s = 1.0 / 3;

std::uint64_t samples_of_a_round(const Measure& measure, std::uint64_t granularity) {
    for (std::uint64_t samples = granularity;; samples *= 2) {
        const double start = processor_s();
        measure(kRounds, samples);  // a round that is not used again
        if (processor_s() - start > kRound_s / 2) return samples * 2;
    }
}

}  // namespace

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Measure readings_with(const estimators::Estimator& estimator, math::RandomKey key) {
    return [&estimator, key](std::uint64_t round, std::uint64_t samples) {
        estimators::Tally sums(estimator.known_part().size());
        estimator.run_batch({key.derived(round), 0, samples}, sums);
        std::vector<double> values;
        for (std::size_t j = 0; j < sums.sum.size(); ++j) {
            values.push_back(estimator.known_part()[j].luminance() +
                             sums.sum[j].luminance() / static_cast<double>(samples));
        }
        return values;
    };
}

Measure picture_with(const estimators::Estimator& estimator, const std::array<int, 2>& resolution,
                     math::RandomKey key) {
    return [&estimator, resolution, key](std::uint64_t round, std::uint64_t passes) {
        std::vector<double> pixels;
        for (std::uint64_t index = 0; index < passes; ++index) {
            const auto pass = estimator.start({key.derived(round), index});
            std::size_t first = 0;
            for (const estimators::PixelBlock& block : estimators::blocks_of(resolution)) {
                estimators::Tally samples(block.pixels());
                pass->sample(block, samples);
                pixels.resize(std::max(pixels.size(), first + samples.sum.size()));
                for (const Rgb& sample : samples.sum) {
                    pixels[first++] += sample.luminance() / static_cast<double>(passes);
                }
            }
        }
        return pixels;
    };
}

Efficiency efficiency_of(const Measure& measure, std::uint64_t granularity) {
    const std::uint64_t samples = samples_of_a_round(measure, granularity);
    std::vector<double> means;
    const double start = processor_s();
    for (std::uint64_t round = 0; round < kRounds; ++round) {
        const std::vector<double> readings = measure(round, samples);
        means.insert(means.end(), readings.begin(), readings.end());
    }
    const double elapsed_s = processor_s() - start;
    std::vector<double> variances;
    double sum = 0;
    for (const statistics::Estimate& e : statistics::estimate_readings({means, means.size() / kRounds})) {
        if (!(e.value > 0)) continue;
        const double relative_error = e.standard_error / e.value;
        variances.push_back(relative_error * relative_error);
        sum += variances.back();
    }
    std::sort(variances.begin(), variances.end());
    const std::size_t count = variances.size();
    const auto efficiency = [&](double variance) { return 1 / (variance * elapsed_s); };
    return {efficiency(sum / static_cast<double>(count)), efficiency(variances[count / 2]),
            efficiency(variances[count * 95 / 100]), elapsed_s};
}

}  // namespace stilb
