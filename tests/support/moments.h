// Mean and variance of a stream of numbers.
#pragma once

#include <cmath>
#include <cstdint>

namespace stilb::statistics {

/// Running mean and variance [Welford 1962]; two of them merge as if one had seen both streams [Chan, Golub,
/// LeVeque 1979]. Stable where the mean is large beside the spread.
class RunningMoments {
  public:
    void add(double value) {
        ++count_;
        const double from_old_mean = value - mean_;
        mean_ += from_old_mean / static_cast<double>(count_);
        squares_ += from_old_mean * (value - mean_);
    }

    void merge(const RunningMoments& other) {
        if (other.count_ == 0) return;
        const double total = static_cast<double>(count_ + other.count_);
        const double share = static_cast<double>(other.count_) / total;
        const double apart = other.mean_ - mean_;
        squares_ += other.squares_ + apart * apart * static_cast<double>(count_) * share;
        mean_ += apart * share;
        count_ += other.count_;
    }

    std::uint64_t count() const { return count_; }
    /// 0 for an empty stream.
    double mean() const { return mean_; }
    /// The unbiased variance (division by count - 1); 0 for fewer than two values.
    double variance() const { return count_ < 2 ? 0 : squares_ / static_cast<double>(count_ - 1); }
    /// Standard error of mean(), for independent values.
    double standard_error() const {
        return count_ < 2 ? 0 : std::sqrt(variance() / static_cast<double>(count_));
    }

  private:
    std::uint64_t count_ = 0;
    double mean_ = 0;
    double squares_ = 0;  ///< sum of the squared distances from the mean
};

}  // namespace stilb::statistics
