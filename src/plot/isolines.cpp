
#include "plot/isolines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace stilb::plot {

namespace {

/// An edge between neighbouring nodes; each is crossed at most once.
using EdgeId = std::int64_t;

struct Segment {
    EdgeId from, to;
};

/// Cell centres as nodes, with one more ring of nodes on the grid's edge.
class Nodes {
  public:
    Nodes(std::span<const double> values, int nu, int nv) : values_(values), nu_(nu), nv_(nv) {}

    int columns() const { return nu_ + 2; }
    int rows() const { return nv_ + 2; }
    double value(int i, int j) const {
        if (j == 0 || j > nv_)
            return beyond(along_u(i, j == 0 ? 0 : nv_ - 1), along_u(i, j == 0 ? 1 : nv_ - 2));
        return along_u(i, j - 1);
    }
    Point place(int i, int j) const {
        return {std::clamp(i - 0.5, 0.0, double(nu_)), std::clamp(j - 0.5, 0.0, double(nv_))};
    }
    EdgeId edge_right_of(int i, int j) const { return 2 * (EdgeId{j} * columns() + i); }
    EdgeId edge_above(int i, int j) const { return edge_right_of(i, j) + 1; }

    Point crossing(EdgeId edge, double level) const {
        const int i = static_cast<int>(edge / 2 % columns());
        const int j = static_cast<int>(edge / 2 / columns());
        const bool right = edge % 2 == 0;
        const int i2 = right ? i + 1 : i;
        const int j2 = right ? j : j + 1;
        const double t = (level - value(i, j)) / (value(i2, j2) - value(i, j));
        const Point a = place(i, j);
        const Point b = place(i2, j2);
        return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    }

  private:
    /// Half a cell past the border cell, on the straight line through it and its inner neighbour.
    static double beyond(double border, double inner) {
        return std::isfinite(inner) ? 1.5 * border - 0.5 * inner : border;
    }
    /// The value at column i of nodes and row v of cells.
    double along_u(int i, int v) const {
        if (i == 0 || i > nu_) return beyond(cell(i == 0 ? 0 : nu_ - 1, v), cell(i == 0 ? 1 : nu_ - 2, v));
        return cell(i - 1, v);
    }
    /// A grid of one column or row is extended with the same value.
    double cell(int u, int v) const {
        return values_[static_cast<std::size_t>(std::clamp(v, 0, nv_ - 1)) * static_cast<std::size_t>(nu_) +
                       static_cast<std::size_t>(std::clamp(u, 0, nu_ - 1))];
    }

    std::span<const double> values_;
    int nu_, nv_;
};

void add_segments(const Nodes& nodes, int i, int j, double level, std::vector<Segment>& segments) {
    // Corners and edges counterclockwise from the lower left; edge k joins corners k and k + 1.
    const std::array<double, 4> corner{nodes.value(i, j), nodes.value(i + 1, j), nodes.value(i + 1, j + 1),
                                       nodes.value(i, j + 1)};
    if (std::any_of(corner.begin(), corner.end(), [](double value) { return !std::isfinite(value); })) return;
    const std::array<EdgeId, 4> edge{nodes.edge_right_of(i, j), nodes.edge_above(i + 1, j),
                                     nodes.edge_right_of(i, j + 1), nodes.edge_above(i, j)};
    std::array<EdgeId, 4> crossed{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        if ((corner[k] < level) != (corner[(k + 1) % 4] < level)) crossed[count++] = edge[k];
    }
    if (count == 2) segments.push_back({crossed[0], crossed[1]});
    if (count == 4) {
        // A saddle: the mean decides which two corners are connected.
        const bool center_below = (corner[0] + corner[1] + corner[2] + corner[3]) / 4 < level;
        const std::size_t first = (corner[0] < level) == center_below ? 0 : 1;
        segments.push_back({crossed[first], crossed[first + 1]});
        segments.push_back({crossed[first + 2], crossed[(first + 3) % 4]});
    }
}

/// Joins segments that share an edge to polylines of edges.
class Polylines {
  public:
    explicit Polylines(std::span<const Segment> segments)
        : segments_(segments), used_(segments.size(), false) {
        for (std::size_t s = 0; s < segments.size(); ++s) {
            touching_[segments[s].from].push_back(s);
            touching_[segments[s].to].push_back(s);
        }
    }

    std::vector<std::vector<EdgeId>> join() {
        std::vector<std::vector<EdgeId>> polylines;
        for (std::size_t s = 0; s < segments_.size(); ++s) {
            if (used_[s]) continue;
            used_[s] = true;
            std::vector<EdgeId> polyline{segments_[s].from, segments_[s].to};
            extend(polyline);
            std::reverse(polyline.begin(), polyline.end());
            extend(polyline);
            polylines.push_back(std::move(polyline));
        }
        return polylines;
    }

  private:
    void extend(std::vector<EdgeId>& polyline) {
        for (bool grown = true; grown;) {
            grown = false;
            for (const std::size_t s : touching_[polyline.back()]) {
                if (used_[s]) continue;
                used_[s] = grown = true;
                polyline.push_back(segments_[s].from == polyline.back() ? segments_[s].to
                                                                        : segments_[s].from);
                break;
            }
        }
    }

    std::span<const Segment> segments_;
    std::vector<bool> used_;
    std::unordered_map<EdgeId, std::vector<std::size_t>> touching_;
};

}  // namespace

std::vector<std::vector<Point>> find_isolines(std::span<const double> values, int nu, int nv, double level) {
    const Nodes nodes(values, nu, nv);
    std::vector<Segment> segments;
    for (int j = 0; j + 1 < nodes.rows(); ++j) {
        for (int i = 0; i + 1 < nodes.columns(); ++i) add_segments(nodes, i, j, level, segments);
    }
    std::vector<std::vector<Point>> lines;
    for (const std::vector<EdgeId>& polyline : Polylines(segments).join()) {
        std::vector<Point>& line = lines.emplace_back();
        for (const EdgeId edge : polyline) line.push_back(nodes.crossing(edge, level));
    }
    return lines;
}

namespace {

constexpr double kLeastStraightness = 0.8;
constexpr int kCandidates = 48;
constexpr double kClearance = 3;

double distance_between(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Points by the distance along the line.
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
        // Among equally straight stretches, the one nearest to the line's middle.
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

void LabelPlacer::avoid(const PageRectangle& text) {
    const double radius = text.height / 2;
    const int disks = std::max(1, static_cast<int>(std::ceil(text.width / text.height)));
    for (int i = 0; i < disks; ++i)
        taken_.push_back({{text.left + (i + 0.5) / disks * text.width, text.center().y}, radius});
}

bool LabelPlacer::is_free(const Point& center, double radius) const {
    const double margin = std::min({center.x - frame_.left, frame_.right() - center.x, center.y - frame_.top,
                                    frame_.bottom() - center.y});
    return margin >= radius && std::none_of(taken_.begin(), taken_.end(), [&](const Disk& disk) {
               return distance_between(disk.center, center) < disk.radius + radius;
           });
}

}  // namespace stilb::plot
