// Paces of a picture: in a run that stops by its error, cells that are sure enough take fewer samples than
// others.
//
// A replicate's pace in a cell follows from the spread of the other replicates (paces.h). So the number of
// its samples is independent of them, and their mean keeps its expectation. A pixel's value must be the plain
// mean of these means: weights by numbers of samples would depend on what the replicate itself has found, as
// this helps to decide the numbers of the others. For the same reason paces are decided once: a second
// decision would see numbers of samples that the replicate has had a part in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "math/random.h"

namespace stilb::run {

/// The cells of a picture, blocks of pixels, which have a pace of their own in each replicate.
class PicturePaces {
  public:
    using Paces = std::vector<std::vector<estimators::Pace>>;  ///< of the cells, for each replicate

    /// `key`: of the place of the cells, which differs from run to run, so that their edges do not show.
    /// `paces`: those of a run that goes on. Throws std::invalid_argument where they are of other cells.
    PicturePaces(const std::array<int, 2>& resolution, math::RandomKey key, Paces paces = {});

    /// To be called once, before all that follows, where there are no paces. `means`: replicates x pixels, of
    /// those that see anything; `pixels`: the numbers of these, not none. `samples`: of each pixel in each
    /// replicate by now.
    void decide(std::span<const double> means, std::span<const std::size_t> pixels, std::uint64_t samples);
    const Paces& all() const { return paces_; }

    /// The samples that a pixel takes in the first `rounds` passes of a replicate.
    std::uint64_t taken(std::size_t replicate, std::size_t pixel, std::uint64_t rounds) const {
        return paces_[replicate][cell_of(pixel)].taken(rounds);
    }

    /// The blocks of a pass that take their sample of this number.
    struct Part {
        std::uint64_t sample = 0;
        std::vector<estimators::PixelBlock> blocks;
    };
    /// The cells that take part in pass `round` of a replicate. A cell's samples are numbered without gaps:
    /// low-discrepancy points stay even.
    std::vector<Part> parts_of(std::size_t replicate, std::uint64_t round) const;

  private:
    std::uint32_t cell_of(std::size_t pixel) const;

    std::size_t width_ = 0, columns_ = 0;
    std::array<std::size_t, 2>
        shift_{};  ///< of the pixels, so that the first cells are as large as the others
    std::vector<estimators::PixelBlock> cells_;
    Paces paces_;
};

}  // namespace stilb::run
