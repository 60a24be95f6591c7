// Work where it is needed: packets of readings that are sure enough take fewer samples than others. They do
// so whatever ends the run, so that a number of samples gives what a run by its error gave with as many.
// Cells of a picture (picture_paces.h) are packets of pixels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "statistics/interval.h"

namespace stilb::run {

/// Paces of the packets for one replicate, from a number of samples on that all have taken. `packets`: the
/// packet of each reading. `readings`: of each sensor, in order. A packet takes `reserve` times the samples
/// that its error needs: the spread of few replicates says it roughly, and where it misses rare light, it
/// says too little.
///
/// The pace follows from the spread of the other replicates alone. So it is independent of the replicate's
/// own samples, and the replicate's means keep their expectation.
std::vector<estimators::Pace> paces_of(std::size_t replicate, const statistics::ReplicateTable& table,
                                       std::span<const std::uint32_t> packets,
                                       std::span<const std::size_t> readings, std::uint64_t samples,
                                       double reserve);

}  // namespace stilb::run
