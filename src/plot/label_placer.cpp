#include "plot/label_placer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace stilb::plot {
namespace {

constexpr double kLeastStraightness = 0.8;
constexpr int kCandidates = 48;
constexpr double kClearance = 3;

double distance_between(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Points by the distance walked along the line.
class Walk {
  public:
    explicit Walk(std::span<const Point> line) : line_(line), walked_(line.size(), 0) {
        for (std::size_t i = 1; i < line.size(); ++i) {
            walked_[i] = walked_[i - 1] + distance_between(line[i - 1], line[i]);
        }
    }

    double length() const { return walked_.back(); }

    Point at(double distance) const {
        const auto next = std::lower_bound(walked_.begin() + 1, walked_.end() - 1, distance);
        const auto i = static_cast<std::size_t>(next - walked_.begin());
        const double piece = walked_[i] - walked_[i - 1];
        const double t = piece > 0 ? (distance - walked_[i - 1]) / piece : 0;
        return {line_[i - 1].x + t * (line_[i].x - line_[i - 1].x),
                line_[i - 1].y + t * (line_[i].y - line_[i - 1].y)};
    }

  private:
    std::span<const Point> line_;
    std::vector<double> walked_;
};

}  // namespace

std::optional<LabelPlace> LabelPlacer::place(std::span<const Point> line, double label_width) {
    if (line.size() < 2) return std::nullopt;
    const Walk walk(line);
    const double slack = walk.length() - label_width;
    if (slack < 0) return std::nullopt;
    const double radius = label_width / 2 + kClearance;
    std::optional<LabelPlace> best;
    double straightest = kLeastStraightness;
    for (int i = 0; i <= kCandidates; ++i) {
        const double from = slack * i / kCandidates;
        const Point start = walk.at(from);
        const Point end = walk.at(from + label_width);
        const Point center = walk.at(from + label_width / 2);
        // Of equally straight stretches the one nearest to the line's middle.
        const double straightness =
            distance_between(start, end) / label_width - 0.02 * std::abs(2.0 * i / kCandidates - 1);
        if (straightness <= straightest || !is_free(center, radius)) continue;
        straightest = straightness;
        const bool rightwards = end.x >= start.x;
        best = LabelPlace{center, rightwards ? std::atan2(end.y - start.y, end.x - start.x)
                                             : std::atan2(start.y - end.y, start.x - end.x)};
    }
    if (best) taken_.push_back({best->center, radius});
    return best;
}

bool LabelPlacer::is_free(const Point& center, double radius) const {
    const double margin = std::min({center.x - frame_.left, frame_.right() - center.x, center.y - frame_.top,
                                    frame_.bottom() - center.y});
    return margin >= radius && std::none_of(taken_.begin(), taken_.end(), [&](const Disk& disk) {
               return distance_between(disk.center, center) < disk.radius + radius;
           });
}

}  // namespace stilb::plot
