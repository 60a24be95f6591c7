#include "run/pictures/picture_paces.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "base/parallel.h"
#include "run/paces.h"

namespace stilb::run {
namespace {

/// paces.h; more than packets of readings take: the pixels of a cell differ more.
constexpr double kPixelReserve = 3;
constexpr auto kEdge = std::size_t{estimators::kBlockSize};

/// The size of the first cell, of whole packets, so that these are full.
std::array<int, 2> first_cell(math::RandomKey key) {
    const auto [u, v] = math::SampleStream(key, 0).next_two();
    constexpr int packets = estimators::kBlockSize / estimators::kPacketSide;
    return {estimators::kPacketSide * (1 + static_cast<int>(u * packets)),
            estimators::kPacketSide * (1 + static_cast<int>(v * packets))};
}

}  // namespace

PicturePaces::PicturePaces(const std::array<int, 2>& resolution, math::RandomKey key, Paces paces)
    : width_(static_cast<std::size_t>(resolution[0])), paces_(std::move(paces)) {
    const std::array<int, 2> first = first_cell(key);
    for (std::size_t axis = 0; axis < 2; ++axis) shift_[axis] = kEdge - static_cast<std::size_t>(first[axis]);
    columns_ = (width_ - 1 + shift_[0]) / kEdge + 1;
    cells_ = estimators::blocks_of(resolution, first);
    if (!std::ranges::all_of(paces_, [&](const auto& own) { return own.size() == cells_.size(); }))
        throw std::invalid_argument("the paces are those of another picture");
}

std::uint32_t PicturePaces::cell_of(std::size_t pixel) const {
    const std::size_t column = (pixel % width_ + shift_[0]) / kEdge;
    const std::size_t row = (pixel / width_ + shift_[1]) / kEdge;
    return static_cast<std::uint32_t>(row * columns_ + column);
}

void PicturePaces::decide(std::span<const double> means, std::span<const std::size_t> pixels,
                          std::uint64_t samples) {
    std::vector<std::uint32_t> cells;
    for (const std::size_t pixel : pixels) cells.push_back(cell_of(pixel));
    const std::size_t seen = pixels.size();
    paces_.resize(means.size() / seen);
    parallel_for(paces_.size(), [&](std::size_t r) {
        paces_[r] = paces_of(r, {means, seen}, cells, {&seen, 1}, samples, kPixelReserve);
        // The first passes count, too: a cell waits until they are no more than its share of all.
        for (estimators::Pace& pace : paces_[r]) pace.pause = pace.all * (pace.every - 1);
        // The last cells may see nothing.
        paces_[r].resize(cells_.size(), {samples, 1, 0});
    });
}

std::vector<PicturePaces::Part> PicturePaces::parts_of(std::size_t replicate, std::uint64_t round) const {
    std::map<std::uint64_t, Part> parts;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        const estimators::Pace& pace = paces_[replicate][c];
        const std::uint64_t sample = pace.taken(round);
        if (pace.taken(round + 1) == sample) continue;
        Part& part = parts[sample];
        part.sample = sample;
        part.blocks.push_back(cells_[c]);
    }
    std::vector<Part> all;
    for (auto& [sample, part] : parts) all.push_back(std::move(part));
    return all;
}

}  // namespace stilb::run
