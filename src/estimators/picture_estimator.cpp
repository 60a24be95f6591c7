#include "estimators/picture_estimator.h"

#include <algorithm>

namespace stilb {

std::vector<PixelBlock> blocks_of(const std::array<int, 2>& resolution) {
    constexpr int size = 16;
    std::vector<PixelBlock> blocks;
    for (int top = 0; top < resolution[1]; top += size) {
        for (int left = 0; left < resolution[0]; left += size) {
            blocks.push_back(
                {blocks.size(), left, top, std::min(size, resolution[0] - left), std::min(size, resolution[1] - top)});
        }
    }
    return blocks;
}

}  // namespace stilb
