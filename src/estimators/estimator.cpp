#include "estimators/estimator.h"

#include <algorithm>

namespace stilb::estimators {

ReadingSums& ReadingSums::operator+=(const ReadingSums& batch) {
    for (std::size_t i = 0; i < sum.size(); ++i) {
        sum[i] += batch.sum[i];
        largest[i] = std::max(largest[i], batch.largest[i]);
        largest_direct[i] = std::max(largest_direct[i], batch.largest_direct[i]);
    }
    lacking.resize(std::max(lacking.size(), batch.lacking.size()));
    for (std::size_t i = 0; i < batch.lacking.size(); ++i) lacking[i] += batch.lacking[i];
    comparisons += batch.comparisons;
    rays += batch.rays;
    invalid += batch.invalid;
    continued += batch.continued;
    return *this;
}
namespace {

struct Range {
    int first = 0, count = 0;
};

std::vector<Range> divided(int length, int first_count, int others_count) {
    std::vector<Range> ranges{{0, std::min(first_count, length)}};
    for (int first = first_count; first < length; first += others_count) {
        ranges.push_back({first, std::min(others_count, length - first)});
    }
    return ranges;
}

}  // namespace

std::vector<PixelBlock> blocks_of(const std::array<int, 2>& resolution, const std::array<int, 2>& offset,
                                  int edge) {
    std::vector<PixelBlock> blocks;
    for (const Range& rows : divided(resolution[1], offset[1], edge)) {
        for (const Range& columns : divided(resolution[0], offset[0], edge)) {
            blocks.push_back({columns.first, rows.first, columns.count, rows.count});
        }
    }
    return blocks;
}

}  // namespace stilb::estimators
