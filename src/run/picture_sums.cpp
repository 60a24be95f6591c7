#include "run/picture_sums.h"

#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/rgb.h"
#include "statistics/interval.h"

namespace stilb::run {

PictureSums::PictureSums(const std::array<int, 2>& resolution, std::uint64_t replicates, Errors errors)
    : width_(static_cast<std::size_t>(resolution[0])),
      replicates_(replicates),
      errors_(errors),
      rgb_(width_ * static_cast<std::size_t>(resolution[1])),
      luminance_(rgb_.size() * replicates) {}

void PictureSums::add(const std::vector<std::array<float, 3>>& pass) {
    const std::size_t replicate = passes_ % replicates_;
    parallel_for_parts(rgb_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            for (std::size_t b = 0; b < kBands; ++b) rgb_[i][b] += pass[i][b];
            luminance_[i * replicates_ + replicate] +=
                static_cast<float>(Rgb{{pass[i][0], pass[i][1], pass[i][2]}}.luminance());
        }
    });
    ++passes_;
}

double PictureSums::luminance_cd_m2(std::size_t pixel) const {
    double sum = 0;
    for (std::size_t r = 0; r < replicates_; ++r) sum += double{luminance_[pixel * replicates_ + r]};
    return sum / static_cast<double>(passes_);
}

double PictureSums::own_standard_error_cd_m2(std::size_t pixel) const {
    const std::uint64_t used = replicates();
    if (used < 2) return std::numeric_limits<double>::infinity();
    const double all = static_cast<double>(passes_), mean = luminance_cd_m2(pixel);
    double variance = 0;
    for (std::uint64_t r = 0; r < used; ++r) {
        const std::uint64_t passes = passes_ / replicates_ + (r < passes_ % replicates_ ? 1 : 0);
        const double own = static_cast<double>(passes);
        const double deviation = (double{luminance_[pixel * replicates_ + r]} - own * mean) / all;
        variance += deviation * deviation;
    }
    return std::sqrt(variance * static_cast<double>(used) / static_cast<double>(used - 1));
}

statistics::PooledErrors<float> PictureSums::errors() const {
    const int degrees = static_cast<int>(replicates()) - 1;
    std::vector<float> values(rgb_.size()), own(rgb_.size());
    parallel_for_parts(rgb_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            values[i] = static_cast<float>(luminance_cd_m2(i));
            own[i] = static_cast<float>(own_standard_error_cd_m2(i));
        }
    });
    if (errors_ == Errors::own) return {std::move(own), std::vector<int>(rgb_.size(), degrees)};
    return statistics::pool_errors<float>(width_, values, own, degrees);
}

double PictureSums::attained_error(const std::vector<bool>& blind) const {
    if (replicates() < 2) return std::numeric_limits<double>::infinity();
    const statistics::PooledErrors<float> errors = this->errors();
    const int most = *std::ranges::max_element(errors.degrees_of_freedom);
    const statistics::StudentQuantiles quantiles((1 + statistics::kStoppedConfidence) / 2, most);
    std::vector<double> half_widths;
    for (std::size_t i = 0; i < blind.size(); ++i) {
        if (blind[i]) continue;
        const double half_width = quantiles(errors.degrees_of_freedom[i]) * double{errors.standard_errors[i]};
        half_widths.push_back(half_width > 0 ? half_width / luminance_cd_m2(i) : 0);
    }
    return statistics::attained_error_of(std::move(half_widths));
}

Pixels PictureSums::pixels() const {
    Pixels pixels;
    pixels.rgb_cd_m2.resize(rgb_.size());
    const float per_pass = 1 / static_cast<float>(passes_);
    parallel_for_parts(rgb_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            for (std::size_t b = 0; b < kBands; ++b) pixels.rgb_cd_m2[i][b] = rgb_[i][b] * per_pass;
        }
    });
    if (replicates() > 1) pixels.standard_error_cd_m2 = errors().standard_errors;
    return pixels;
}

}  // namespace stilb::run
