#include "io/import/textures/palette.h"

#include <algorithm>
#include <numeric>
#include <queue>

namespace stilb::io {
namespace {

/// Given colours with a common colour in the palette.
struct ColourGroup {
    std::span<std::uint32_t> members;
    Rgb mean;
    std::size_t band = 0;      ///< in which they differ most
    double variance = 0;       ///< in this band
    double squared_error = 0;  ///< the variance times the weight

    bool operator<(const ColourGroup& other) const { return squared_error < other.squared_error; }
};

ColourGroup group_of(std::span<std::uint32_t> members, std::span<const WeightedColour> given) {
    ColourGroup group;
    group.members = members;
    double weight = 0;
    for (const std::uint32_t i : members) {
        weight += given[i].weight;
        group.mean += given[i].weight * given[i].rgb;
    }
    group.mean *= 1 / weight;
    Rgb variance;
    for (const std::uint32_t i : members) {
        const Rgb apart = given[i].rgb + -1 * group.mean;
        variance += given[i].weight / weight * (apart * apart);
    }
    group.band = static_cast<std::size_t>(std::ranges::max_element(variance.band) - variance.band.begin());
    group.variance = variance.max();
    group.squared_error = group.variance * weight;
    return group;
}

}  // namespace

Palette make_palette(std::span<const WeightedColour> given, std::size_t most) {
    constexpr double kSameColour = 1e-3;
    if (given.empty()) return {};
    std::vector<std::uint32_t> order(given.size());
    std::iota(order.begin(), order.end(), 0u);
    std::priority_queue<ColourGroup> open;
    std::vector<ColourGroup> done;
    open.push(group_of(order, given));
    while (!open.empty()) {
        const ColourGroup group = open.top();
        open.pop();
        const bool is_last = open.size() + done.size() + 1 >= most;
        // The variance says that some colours lie on each side of the mean.
        if (is_last || group.variance <= kSameColour * kSameColour) {
            done.push_back(group);
            continue;
        }
        const auto above = std::partition(group.members.begin(), group.members.end(), [&](std::uint32_t i) {
            return given[i].rgb[group.band] <= group.mean[group.band];
        });
        const auto below = static_cast<std::size_t>(above - group.members.begin());
        open.push(group_of(group.members.first(below), given));
        open.push(group_of(group.members.subspan(below), given));
    }
    std::ranges::sort(done, {}, [](const ColourGroup& group) { return group.mean.luminance(); });
    Palette palette;
    palette.colour_of.resize(given.size());
    for (const ColourGroup& group : done) {
        for (const std::uint32_t i : group.members)
            palette.colour_of[i] = static_cast<std::uint32_t>(palette.colours.size());
        palette.colours.push_back(group.mean);
    }
    return palette;
}

}  // namespace stilb::io
