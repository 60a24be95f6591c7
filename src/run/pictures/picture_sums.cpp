#include "run/pictures/picture_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/parallel.h"
#include "base/rgb.h"
#include "run/streams.h"
#include "statistics/interval.h"

namespace stilb::run {

PictureSums::PictureSums(const std::array<int, 2>& resolution, RunPlan plan, std::size_t layers)
    : plan_(std::move(plan)),
      resolution_(resolution),
      pixels_(static_cast<std::size_t>(resolution[0]) * static_cast<std::size_t>(resolution[1])),
      layers_(layers),
      colours_(plan_.has_paces ? plan_.replicates : 1),
      rgb_(pixels_ * colours_ * (1 + layers_)),
      luminance_(pixels_ * plan_.replicates) {
    if (!plan_.paces.empty()) paces_.emplace(resolution_, cells_key(), plan_.paces);
}

math::RandomKey PictureSums::cells_key() const {
    return key_of_seed(plan_.seed).derived(RunStream::picture_cells);
}

void PictureSums::write(ByteWriter& bytes) const {
    plan_.write(bytes);
    for (const int size : resolution_) bytes.add(std::int32_t{size});
    bytes.add(passes_);
    bytes.add(std::uint64_t{layers_});
    bytes.add_list(rgb_);
    bytes.add_list(luminance_);
}

PictureSums PictureSums::read(ByteReader& bytes) {
    RunPlan plan = RunPlan::read(bytes);
    std::array<int, 2> resolution{};
    for (int& size : resolution) size = bytes.take<std::int32_t>("the size of the picture");
    const auto passes = bytes.take<std::uint64_t>("the number of passes");
    const auto layers = bytes.take<std::uint64_t>("the number of layers");
    auto rgb = bytes.take_list<std::vector<std::array<float, 3>>>("the colours");
    auto luminance = bytes.take_list<std::vector<float>>("the luminances");
    const std::uint64_t pixels = luminance.size() / plan.replicates;
    if (std::ranges::min(resolution) < 1 ||
        pixels != std::uint64_t{static_cast<std::uint32_t>(resolution[0])} *
                      static_cast<std::uint32_t>(resolution[1]) ||
        luminance.size() != pixels * plan.replicates || layers > rgb.size() ||
        rgb.size() != pixels * (plan.has_paces ? plan.replicates : 1) * (1 + layers))
        bytes.fail("the sums are not those of the pixels");
    try {
        PictureSums sums(resolution, std::move(plan), layers);
        sums.passes_ = passes;
        sums.rgb_ = std::move(rgb);
        sums.luminance_ = std::move(luminance);
        return sums;
    } catch (const std::invalid_argument& error) {
        bytes.fail(error.what());
    }
}

void PictureSums::add(const std::vector<std::array<float, 3>>& pass) {
    const std::size_t replicate = passes_ % plan_.replicates, colour = passes_ % colours_;
    parallel_for_parts(pixels_, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            for (std::size_t layer = 0; layer <= layers_; ++layer) {
                std::array<float, 3>& sum = rgb_[(layer * pixels_ + i) * colours_ + colour];
                for (std::size_t b = 0; b < kBands; ++b) sum[b] += pass[layer * pixels_ + i][b];
            }
            luminance_[i * plan_.replicates + replicate] +=
                static_cast<float>(Rgb{{pass[i][0], pass[i][1], pass[i][2]}}.luminance());
        }
    });
    ++passes_;
}

void PictureSums::set_paces(const std::vector<bool>& blind) {
    std::vector<std::size_t> seen;
    for (std::size_t i = 0; i < pixels_; ++i) {
        if (!blind[i]) seen.push_back(i);
    }
    const std::uint64_t samples = passes_ / plan_.replicates;
    std::vector<double> means;
    for (std::uint64_t r = 0; r < plan_.replicates; ++r) {
        for (const std::size_t i : seen)
            means.push_back(double{luminance_[i * plan_.replicates + r]} / static_cast<double>(samples));
    }
    paces_.emplace(resolution_, cells_key());
    paces_->decide(means, seen, samples);
    plan_.paces = paces_->all();
}

std::uint64_t PictureSums::taken(std::uint64_t replicate, std::size_t pixel) const {
    const std::uint64_t rounds =
        passes_ / plan_.replicates + (replicate < passes_ % plan_.replicates ? 1 : 0);
    return paces_ ? paces_->taken(replicate, pixel, rounds) : rounds;
}

PictureSums::Share PictureSums::share_of(std::uint64_t replicate, std::size_t pixel) const {
    const auto samples = static_cast<double>(taken(replicate, pixel));
    return plan_.has_paces ? Share{1 / samples, 1} : Share{1, samples};
}

double PictureSums::weights() const { return static_cast<double>(plan_.has_paces ? replicates() : passes_); }

double PictureSums::luminance_cd_m2(std::size_t pixel) const {
    double sum = 0;
    for (std::uint64_t r = 0; r < replicates(); ++r)
        sum += double{luminance_[pixel * plan_.replicates + r]} * share_of(r, pixel).scale;
    return sum / weights();
}

double PictureSums::luminance_of_replicate_cd_m2(std::uint64_t replicate, std::size_t pixel) const {
    const auto [scale, weight] = share_of(replicate, pixel);
    return double{luminance_[pixel * plan_.replicates + replicate]} * scale / weight;
}

std::array<float, 3> PictureSums::rgb_cd_m2(std::size_t pixel,
                                            std::span<const std::array<float, 3>> sums) const {
    std::array<float, 3> sum{};
    for (std::uint64_t c = 0; c < std::min(colours_, replicates()); ++c) {
        const auto scale = static_cast<float>(share_of(c, pixel).scale);
        for (std::size_t b = 0; b < kBands; ++b) sum[b] += sums[pixel * colours_ + c][b] * scale;
    }
    const float per_weight = 1 / static_cast<float>(weights());
    for (float& band : sum) band *= per_weight;
    return sum;
}

double PictureSums::own_standard_error_cd_m2(std::size_t pixel) const {
    const std::uint64_t used = replicates();
    if (used < 2) return std::numeric_limits<double>::infinity();
    const double mean = luminance_cd_m2(pixel);
    double variance = 0;
    for (std::uint64_t r = 0; r < used; ++r) {
        const auto [scale, weight] = share_of(r, pixel);
        const double sum = double{luminance_[pixel * plan_.replicates + r]};
        const double deviation = (sum * scale - weight * mean) / weights();
        variance += deviation * deviation;
    }
    return std::sqrt(variance * static_cast<double>(used) / static_cast<double>(used - 1));
}

double PictureSums::variance_per_sample(std::size_t pixel) const {
    const std::uint64_t used = replicates();
    double sum = 0;
    for (std::uint64_t r = 0; r < used; ++r) sum += 1 / static_cast<double>(taken(r, pixel));
    return sum / static_cast<double>(used * used);
}

statistics::PooledErrors<float> PictureSums::errors() const {
    const int degrees = static_cast<int>(replicates()) - 1;
    std::vector<float> values(pixels_), own(pixels_), scales(paces_ ? pixels_ : 0);
    parallel_for_parts(pixels_, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            values[i] = static_cast<float>(luminance_cd_m2(i));
            own[i] = static_cast<float>(own_standard_error_cd_m2(i));
            if (!paces_) continue;
            scales[i] = static_cast<float>(std::sqrt(variance_per_sample(i)));
            own[i] /= scales[i];
        }
    });
    if (!plan_.pools_errors) return {std::move(own), std::vector<int>(pixels_, degrees)};
    // Neighbours of other cells may have other numbers of samples: what they share is the error of one
    // sample.
    statistics::PooledErrors<float> pooled =
        statistics::pool_errors<float>(static_cast<std::size_t>(resolution_[0]), values, own, degrees);
    for (std::size_t i = 0; i < scales.size(); ++i) pooled.standard_errors[i] *= scales[i];
    return pooled;
}

double PictureSums::attained_error(const std::vector<bool>& blind) const {
    if (replicates() < 2) return std::numeric_limits<double>::infinity();
    const statistics::PooledErrors<float> errors = this->errors();
    const statistics::StudentQuantiles quantiles((1 + statistics::kStoppedConfidence) / 2,
                                                 errors.degrees_of_freedom);
    std::vector<double> values, half_widths;
    for (std::size_t i = 0; i < blind.size(); ++i) {
        if (blind[i]) continue;
        values.push_back(luminance_cd_m2(i));
        half_widths.push_back(quantiles(errors.degrees_of_freedom[i]) * double{errors.standard_errors[i]});
    }
    const double dark = statistics::dark_level(values);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (half_widths[i] > 0) half_widths[i] /= std::max(values[i], dark);
    }
    return statistics::attained_error_of(std::move(half_widths));
}

Pixels PictureSums::pixels() const {
    Pixels pixels;
    const auto set = [&](std::size_t layer, std::vector<std::array<float, 3>>& rgb) {
        const auto sums = std::span(rgb_).subspan(layer * pixels_ * colours_, pixels_ * colours_);
        rgb.resize(pixels_);
        parallel_for_parts(pixels_, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) rgb[i] = rgb_cd_m2(i, sums);
        });
    };
    set(0, pixels.rgb_cd_m2);
    pixels.layers_cd_m2.resize(layers_);
    for (std::size_t layer = 0; layer < layers_; ++layer) set(1 + layer, pixels.layers_cd_m2[layer]);
    if (replicates() > 1) pixels.standard_error_cd_m2 = errors().standard_errors;
    return pixels;
}

double PictureSums::samples_per_pixel(const std::vector<bool>& blind) const {
    double samples = 0, seen = 0;
    for (std::size_t i = 0; i < pixels_; ++i) {
        if (blind[i]) continue;
        for (std::uint64_t r = 0; r < replicates(); ++r) samples += static_cast<double>(taken(r, i));
        ++seen;
    }
    return samples / seen;
}

}  // namespace stilb::run
