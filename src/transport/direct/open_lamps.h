// Lamps of which a receiver may see a part, where they are too many for a shadow ray to each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stilb::transport {

/// Some of the lamps are chosen for a sample, evenly, by their light without shadows; a part of the choices
/// is equal for all, because the brightest ones may be hidden.
class OpenLamps {
  public:
    /// The largest number of lamps of a sample.
    static constexpr std::size_t kChosen = 32;

    /// `unshadowed_lx`: above 0.
    void add(std::size_t lamp, double unshadowed_lx) {
        lamps_.push_back(static_cast<std::uint32_t>(lamp));
        sums_.push_back(unshadowed_lx);
    }
    /// After all lamps are added.
    void finish();

    /// Lamps of a sample.
    std::size_t choices() const { return lamps_.size() < kChosen ? lamps_.size() : kChosen; }
    struct Choice {
        std::size_t lamp = 0;
        double factor = 1;  ///< over the expected number of times that it is chosen
    };
    /// Choice `i` of a sample. `first`: of the sample, in [0, 1).
    Choice choose(std::size_t i, double first) const;

  private:
    std::vector<std::uint32_t> lamps_;
    std::vector<double> sums_;  ///< running sums of weights
};

}  // namespace stilb::transport
