#include "run/pictures/picture_sums.h"

#include <fmt/format.h>

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
      replicates_(plan_.replicates) {
    if (!plan_.paces.empty()) paces_.emplace(resolution_, cells_key(), plan_.paces);
}

math::RandomKey PictureSums::cells_key() const {
    return key_of_seed(plan_.seed).derived(RunStream::picture_cells);
}

void PictureSums::write(ByteWriter& bytes) const {
    plan_.write(bytes);
    bytes.add_list(more_seeds_);
    for (const int size : resolution_) bytes.add(std::int32_t{size});
    bytes.add(std::uint64_t{layers_});
    for (const auto& [passes, sums] : replicates_) {
        bytes.add(passes);
        if (passes > 0) bytes.add_list(sums);
    }
}

PictureSums PictureSums::read(ByteReader& bytes) {
    RunPlan plan = RunPlan::read(bytes);
    auto more_seeds = bytes.take_list<std::vector<std::uint64_t>>("other seeds");
    std::array<int, 2> resolution{};
    for (int& size : resolution) size = bytes.take<std::int32_t>("the size of the picture");
    const auto layers = bytes.take<std::uint64_t>("the number of layers");
    if (std::ranges::min(resolution) < 1) bytes.fail("the picture has no pixels");
    // Before they take memory: damaged bytes may say anything.
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(resolution[0]) * static_cast<std::uint64_t>(resolution[1]);
    if (!plan.paces.empty() &&
        plan.paces.front().size() < pixels / (estimators::kBlockSize * estimators::kBlockSize))
        bytes.fail("the paces are not those of the pixels");
    try {
        PictureSums sums(resolution, std::move(plan), layers);
        sums.more_seeds_ = std::move(more_seeds);
        for (Replicate& replicate : sums.replicates_) {
            replicate.passes = bytes.take<std::uint64_t>("the number of passes");
            if (replicate.passes == 0) continue;
            replicate.sums = bytes.take_list<Colours>("the colours");
            if (replicate.sums.size() % pixels != 0 || replicate.sums.size() / pixels - 1 != layers)
                bytes.fail("the sums are not those of the pixels");
        }
        return sums;
    } catch (const std::invalid_argument& error) {
        bytes.fail(error.what());
    }
}

void PictureSums::merge(PictureSums other) {
    if (other.resolution_ != resolution_ || other.layers_ != layers_)
        throw std::invalid_argument("the pictures have another size, or other layers");
    if (other.seeds() != seeds() || !more_seeds_.empty()) {
        merge_seeds(std::move(other));
        return;
    }
    if (other.plan_ != plan_) throw std::invalid_argument("the parts are of runs of different plans");
    other.for_each_begun([&](std::uint64_t r) {
        if (replicates_[r].passes > 0) throw std::invalid_argument("both have made the same passes");
        replicates_[r] = std::move(other.replicates_[r]);
    });
}

void PictureSums::merge_seeds(PictureSums other) {
    forget_paces();
    other.forget_paces();
    const std::vector<std::uint64_t> own = seeds(), others = other.seeds();
    for (const std::uint64_t seed : others) {
        if (std::ranges::find(own, seed) != own.end())
            throw std::invalid_argument(fmt::format("both have passes of seed {}", seed));
    }
    other.plan_.seed = plan_.seed;
    if (other.plan_ != plan_) throw std::invalid_argument("the runs have different plans");
    more_seeds_.insert(more_seeds_.end(), others.begin(), others.end());
    other.for_each_begun([&](std::uint64_t r) {
        const Replicate& more = other.replicates_[r];
        Replicate& replicate = replicates_[r];
        replicate.passes += more.passes;
        replicate.sums.resize(more.sums.size());
        for (std::size_t i = 0; i < more.sums.size(); ++i) {
            for (std::size_t b = 0; b < kBands; ++b) replicate.sums[i][b] += more.sums[i][b];
        }
    });
}

void PictureSums::forget_paces() {
    for_each_begun([&](std::uint64_t r) {
        auto& [passes, sums] = replicates_[r];
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const double factor = static_cast<double>(passes) / static_cast<double>(taken(r, i % pixels_));
            for (float& band : sums[i]) band = static_cast<float>(band * factor);
        }
    });
    paces_.reset();
    plan_.paces.clear();
}

std::vector<std::uint64_t> PictureSums::seeds() const {
    std::vector<std::uint64_t> all{plan_.seed};
    all.insert(all.end(), more_seeds_.begin(), more_seeds_.end());
    return all;
}

std::uint64_t PictureSums::passes() const {
    std::uint64_t all = 0;
    for (const Replicate& replicate : replicates_) all += replicate.passes;
    return all;
}

std::uint64_t PictureSums::replicates() const {
    std::uint64_t count = 0;
    for_each_begun([&](std::uint64_t) { ++count; });
    return count;
}

std::uint64_t PictureSums::next_pass(const RunPart& part) const {
    std::uint64_t first = std::numeric_limits<std::uint64_t>::max();
    for (std::uint64_t r = 0; r < replicates_.size(); ++r) {
        if (part.has(r)) first = std::min(first, replicates_[r].passes * replicates_.size() + r);
    }
    return first;
}

void PictureSums::add(std::uint64_t replicate, const std::vector<std::array<float, 3>>& pass) {
    auto& [passes, sums] = replicates_[replicate];
    sums.resize(pass.size());
    parallel_for_parts(pass.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            for (std::size_t b = 0; b < kBands; ++b) sums[i][b] += pass[i][b];
        }
    });
    ++passes;
}

void PictureSums::set_paces(const std::vector<bool>& blind) {
    std::vector<std::size_t> seen;
    for (std::size_t i = 0; i < pixels_; ++i) {
        if (!blind[i]) seen.push_back(i);
    }
    const std::uint64_t samples = replicates_.front().passes;
    std::vector<double> means;
    for (std::uint64_t r = 0; r < replicates_.size(); ++r) {
        for (const std::size_t i : seen) means.push_back(sum_cd_m2(r, i) / static_cast<double>(samples));
    }
    paces_.emplace(resolution_, cells_key());
    paces_->decide(means, seen, samples);
    plan_.paces = paces_->all();
}

std::uint64_t PictureSums::taken(std::uint64_t replicate, std::size_t pixel) const {
    const std::uint64_t passes = replicates_[replicate].passes;
    return paces_ ? paces_->taken(replicate, pixel, passes) : passes;
}

PictureSums::Share PictureSums::share_of(std::uint64_t replicate, std::size_t pixel) const {
    const auto samples = static_cast<double>(taken(replicate, pixel));
    return plan_.has_paces ? Share{1 / samples, 1} : Share{1, samples};
}

double PictureSums::weights() const { return static_cast<double>(plan_.has_paces ? replicates() : passes()); }

double PictureSums::sum_cd_m2(std::uint64_t replicate, std::size_t pixel) const {
    const auto& [r, g, b] = replicates_[replicate].sums[pixel];
    return Rgb{{r, g, b}}.luminance();
}

double PictureSums::luminance_cd_m2(std::size_t pixel) const {
    double sum = 0;
    for_each_begun([&](std::uint64_t r) { sum += sum_cd_m2(r, pixel) * share_of(r, pixel).scale; });
    return sum / weights();
}

double PictureSums::luminance_of_replicate_cd_m2(std::uint64_t replicate, std::size_t pixel) const {
    const auto [scale, weight] = share_of(replicate, pixel);
    return sum_cd_m2(replicate, pixel) * scale / weight;
}

std::array<float, 3> PictureSums::rgb_cd_m2(std::size_t pixel, std::size_t layer) const {
    std::array<float, 3> sum{};
    for_each_begun([&](std::uint64_t r) {
        const auto scale = static_cast<float>(share_of(r, pixel).scale);
        const std::array<float, 3>& rgb = replicates_[r].sums[layer * pixels_ + pixel];
        for (std::size_t b = 0; b < kBands; ++b) sum[b] += rgb[b] * scale;
    });
    const float per_weight = 1 / static_cast<float>(weights());
    for (float& band : sum) band *= per_weight;
    return sum;
}

double PictureSums::own_standard_error_cd_m2(std::size_t pixel) const {
    const auto used = static_cast<double>(replicates());
    if (used < 2) return std::numeric_limits<double>::infinity();
    const double mean = luminance_cd_m2(pixel);
    double variance = 0;
    for_each_begun([&](std::uint64_t r) {
        const auto [scale, weight] = share_of(r, pixel);
        const double deviation = (sum_cd_m2(r, pixel) * scale - weight * mean) / weights();
        variance += deviation * deviation;
    });
    return std::sqrt(variance * used / (used - 1));
}

double PictureSums::variance_per_sample(std::size_t pixel) const {
    double sum = 0;
    for_each_begun([&](std::uint64_t r) { sum += 1 / static_cast<double>(taken(r, pixel)); });
    const auto used = static_cast<double>(replicates());
    return sum / (used * used);
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
        rgb.resize(pixels_);
        parallel_for_parts(pixels_, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) rgb[i] = rgb_cd_m2(i, layer);
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
        for_each_begun([&](std::uint64_t r) { samples += static_cast<double>(taken(r, i)); });
        ++seen;
    }
    return samples / seen;
}

}  // namespace stilb::run
