#include "report/text_places.h"

#include <algorithm>
#include <array>

namespace stilb::report {
namespace {

using plot::PageRectangle;

constexpr double kGap = 2;
/// Distances from a thing, in heights of the text.
constexpr std::array<double, 3> kRows{0, 1, 2};

bool overlap(const PageRectangle& a, const PageRectangle& b) {
    return a.left < b.right() && b.left < a.right() && a.top < b.bottom() && b.top < a.bottom();
}

bool contains(const PageRectangle& frame, const PageRectangle& inner) {
    return inner.left >= frame.left && inner.right() <= frame.right() && inner.top >= frame.top &&
           inner.bottom() <= frame.bottom();
}

}  // namespace

std::optional<PageRectangle> TextPlaces::take_first(const std::vector<PageRectangle>& candidates) {
    const auto is_free = [&](const PageRectangle& text, bool may_cover_things) {
        const auto covers = [&](const PageRectangle& other) { return overlap(text, other); };
        return contains(frame_, text) && std::ranges::none_of(texts_, covers) &&
               (may_cover_things || std::ranges::none_of(things_, covers));
    };
    for (const bool may_cover_things : {false, true}) {
        for (const PageRectangle& text : candidates) {
            if (!is_free(text, may_cover_things)) continue;
            texts_.push_back(text);
            return text;
        }
    }
    return std::nullopt;
}

std::optional<PageRectangle> TextPlaces::place_beside(const PageRectangle& thing, double width,
                                                      double height) {
    std::vector<PageRectangle> candidates;
    const auto [x, y] = thing.center();
    for (const double row : kRows) {
        const double away = kGap + row * height;
        const double below = thing.bottom() + away, above = thing.top - away - height;
        candidates.push_back({x - width / 2, below, width, height});
        candidates.push_back({x - width / 2, above, width, height});
        for (const double top : {y - height / 2 + row * height, y - height / 2 - row * height}) {
            candidates.push_back({thing.right() + kGap, top, width, height});
            candidates.push_back({thing.left - kGap - width, top, width, height});
        }
        for (const double top : {below, above}) {
            candidates.push_back({thing.left, top, width, height});
            candidates.push_back({thing.right() - width, top, width, height});
        }
    }
    return take_first(candidates);
}

std::optional<PageRectangle> TextPlaces::place_within(const PageRectangle& thing, double width,
                                                      double height) {
    const double left = thing.left + kGap, right = thing.right() - kGap - width, top = thing.top + kGap,
                 bottom = thing.bottom() - kGap - height;
    if (right < left || bottom < top) return std::nullopt;
    return take_first({{left, top, width, height},
                       {left, bottom, width, height},
                       {right, top, width, height},
                       {right, bottom, width, height}});
}

}  // namespace stilb::report
