// Batches of samples of readings, and their sums.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/bytes.h"
#include "base/rgb.h"
#include "estimators/streams.h"
#include "math/random.h"

namespace stilb::estimators {

/// The samples that a packet of readings, or a cell of a picture, takes: the first `all`, none of the next
/// `pause`, and then one for each `every` samples.
struct Pace {
    std::uint64_t all = 0, every = 1, pause = 0;

    /// How many it takes of the first `samples` ones.
    std::uint64_t taken(std::uint64_t samples) const {
        const std::uint64_t begin = all + pause;
        return std::min(samples, all) + (samples > begin ? (samples - begin + every - 1) / every : 0);
    }
    bool operator==(const Pace&) const = default;
};

/// The unit of work for readings: samples first ... first + count - 1 of the replicate that `key` identifies.
/// The contribution of a batch depends on these and the paces alone.
struct Batch {
    math::KeyOf<BatchStream> key;
    std::uint64_t first = 0;
    std::uint64_t count = 0;
    /// The pace of each packet of readings (Estimator::packets()). If there are none, all readings take all
    /// samples.
    std::span<const Pace> paces = {};

    /// The samples that a packet takes, numbered without gaps: low-discrepancy points stay even.
    Batch of_packet(std::size_t packet) const {
        if (paces.empty()) return *this;
        const std::uint64_t begin = paces[packet].taken(first);
        return {key, begin, paces[packet].taken(first + count) - begin};
    }
};

/// The sums of batches of one replicate, as a value: parts of a replicate are added, or stored as bytes. The
/// value of a reading is known part + sum / samples taken.
struct Tally {
    std::vector<Rgb> sum;               ///< one for each reading [lx or cd/m2, x samples taken]
    std::vector<double> largest;        ///< largest single contribution to each reading, before division
    std::vector<float> largest_direct;  ///< the same of light that comes straight from lamps
    std::uint64_t rays = 0;
    std::uint64_t invalid = 0;    ///< non-finite contributions, which are left out
    std::uint64_t continued = 0;  ///< rays that path tracing continues beyond a guess
    /// Methods on patches: what the readings lack, by path tracing behind the same rays for some of the
    /// samples [lx or cd/m2, x comparisons]; empty for other methods.
    std::vector<Rgb> lacking;
    std::uint64_t comparisons = 0;
    std::uint64_t samples = 0;
    std::vector<std::uint64_t> taken;  ///< samples, by packet (Batch::paces)
    /// Channels x readings, where the problem has channels: what the sums consist of.
    std::vector<Rgb> parts;

    explicit Tally(std::size_t readings, std::size_t packets = 0, std::size_t channels = 0)
        : sum(readings),
          largest(readings),
          largest_direct(readings),
          taken(packets),
          parts(channels * readings) {}

    std::size_t channels() const { return sum.empty() ? 0 : parts.size() / sum.size(); }
    bool is_of_same_readings(const Tally& other) const {
        return sum.size() == other.sum.size() && taken.size() == other.taken.size() &&
               parts.size() == other.parts.size();
    }
    /// Counts the samples of a batch whose contributions are added.
    void count(const Batch& batch);

    /// Adds what a reading lacks in one comparison.
    void add_lacking(std::size_t reading, const Rgb& difference) {
        if (difference.is_finite()) lacking[reading] += difference;
    }
    /// Begins another comparison of all readings.
    void begin_comparison() {
        lacking.resize(sum.size());
        ++comparisons;
    }

    /// Adds other batches, of as many readings and packets. The last bits of the sums depend on the order.
    Tally& operator+=(const Tally& others);

    void write(ByteWriter& bytes) const;
    static Tally read(ByteReader& bytes);

    /// Adds light that comes straight from lamps: it does not tell whether samples find any other.
    void add_direct(std::size_t reading, const Rgb& contribution) {
        add(reading, contribution, 0);
        largest_direct[reading] =
            std::max(largest_direct[reading], static_cast<float>(std::abs(contribution.luminance())));
    }
    /// Adds a contribution to a reading.
    void add(std::size_t reading, const Rgb& contribution) {
        add(reading, contribution, std::abs(contribution.luminance()));
    }
    /// Adds the sum of several, of which the largest is known.
    void add(std::size_t reading, const Rgb& contributions, double largest_of_them) {
        if (!contributions.is_finite()) {
            ++invalid;
            return;
        }
        sum[reading] += contributions;
        largest[reading] = std::max(largest[reading], largest_of_them);
    }
};

}  // namespace stilb::estimators
