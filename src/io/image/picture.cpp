#include "io/image/picture.h"

#include <fmt/format.h>

#include <stdexcept>

namespace stilb::io {
namespace {

constexpr long long kMostPixels = 100'000'000;
constexpr long long kLongestSide = 100'000;

}  // namespace

bool is_readable_size(long long width, long long height) {
    return width <= kLongestSide && height <= kLongestSide && width * height <= kMostPixels;
}

std::string too_large_message(long long width, long long height) {
    return fmt::format("{} x {} pixels are too many. At most {} can be read, and {} on a side.", width,
                       height, kMostPixels, kLongestSide);
}

void require_consistency(const Picture& picture) {
    const std::size_t count = picture.pixel_count();
    const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
    const bool is_consistent = picture.width > 0 && picture.height > 0 && picture.rgb_cd_m2.size() == count &&
                               fits(picture.standard_error_cd_m2.size()) && fits(picture.normals.size()) &&
                               fits(picture.depth_m.size());
    if (!is_consistent) throw std::invalid_argument("a picture whose size and channels differ");
}

}  // namespace stilb::io
