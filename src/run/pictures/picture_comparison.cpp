#include "run/pictures/picture_comparison.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "estimators/estimator_list.h"

namespace stilb::run {
namespace {

constexpr std::size_t kPixels = 1024;
constexpr std::size_t kReplicates = 16;
constexpr std::uint64_t kPathsOfAReplicate = 16;

/// Pixels in the camera's field, drawn at random.
std::vector<std::size_t> chosen_pixels(const std::vector<bool>& blind, math::RandomKey key) {
    std::vector<std::size_t> chosen;
    for (std::uint64_t i = 0; i < kPixels; ++i) {
        const double u = math::SampleStream(key, i).next();
        const auto pixel = static_cast<std::size_t>(u * static_cast<double>(blind.size()));
        if (!blind[pixel]) chosen.push_back(pixel);
    }
    return chosen;
}

estimators::Problem without_patches(estimators::Problem problem) {
    problem.patches = {};
    return problem;
}

}  // namespace

PictureComparison::PictureComparison(const estimators::Problem& problem, const std::vector<bool>& blind,
                                     math::KeyOf<Stream> key)
    : pixels_(chosen_pixels(blind, key.derived(Stream::choice))),
      traced_cd_m2_(kReplicates * pixels_.size()) {
    const auto paths = estimators::make_path(without_patches(problem));
    const int width = problem.camera->resolution[0];
    Stage stage(problem.monitor, "comparison with path tracing", pixels_.size());
    parallel_for(pixels_.size(), [&](std::size_t i) {
        const int pixel = static_cast<int>(pixels_[i]);
        const estimators::PixelBlock block{pixel % width, pixel / width, 1, 1};
        for (std::size_t r = 0; r < kReplicates; ++r) {
            estimators::Tally sums(1);
            for (std::uint64_t path = 0; path < kPathsOfAReplicate; ++path)
                paths->start({{key.derived(Stream::paths).derived(r)}, path, r})->sample(block, sums);
            traced_cd_m2_[r * pixels_.size() + i] = sums.sum[0].luminance() / double{kPathsOfAReplicate};
        }
        stage.advance();
    });
}

PictureComparison::Bias PictureComparison::bias_of(const std::function<Shown(std::size_t)>& shown) const {
    if (pixels_.empty()) return {};
    std::vector<double> values, differences = traced_cd_m2_;
    // All replicates are compared with the same picture, so that its own noise looks like a bias: its square,
    // known from the standard errors of many pixels, is taken away.
    double noise = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const auto [value, error] = shown(pixels_[i]);
        values.push_back(value);
        if (value > 0) noise += error * error / (value * value) / static_cast<double>(pixels_.size());
        for (std::size_t r = 0; r < kReplicates; ++r) differences[r * pixels_.size() + i] -= value;
    }
    const statistics::BiasBounds bounds = statistics::bias_bounds({differences, pixels_.size()}, values);
    const auto without_noise = [&](double bias) { return std::sqrt(std::max(0.0, bias * bias - noise)); };
    return {without_noise(bounds.relative_at_least), without_noise(bounds.relative)};
}

}  // namespace stilb::run
