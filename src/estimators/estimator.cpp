#include "estimators/estimator.h"

#include <algorithm>

namespace stilb::estimators {

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
