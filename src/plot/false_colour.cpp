
#include "plot/false_colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>

#include "plot/axis.h"
#include "plot/canvas.h"
#include "plot/false_colour_painter.h"

namespace stilb::plot {

namespace {

constexpr double kNameGap = 12;
constexpr double kColumnGap = 32;
constexpr double kRowGap = 24;
/// The width that rows fill, unless they would become too high.
constexpr double kContentWidth = 860;
/// The height of all rows together.
constexpr double kMostHeight = 600;
constexpr double kLeastRowHeight = 100;
constexpr std::size_t kMostColumns = 6;
constexpr double kNiceAspect = 1.5;

bool has_size(const FalseColourPanel& panel) { return panel.width_m > 0 && panel.height_m > 0; }

double aspect_of(const FalseColourPanel& panel) {
    const double aspect = has_size(panel) ? panel.width_m / panel.height_m : double(panel.nu) / panel.nv;
    return std::clamp(aspect, 0.05, 20.0);
}

std::string headline_of(const FalseColourPanel& panel) {
    std::string count = fmt::format("{} × {} values", panel.nu, panel.nv);
    if (!has_size(panel)) return count;
    return fmt::format("{:.2f} m × {:.2f} m, {}", panel.width_m, panel.height_m, count);
}

/// Lengths along a side that is `drawn` long on the sheet; the last one names the unit.
Ticks length_ticks(double length_m, double drawn) {
    Ticks ticks =
        nice_ticks(Scale(ScaleType::linear, {0, length_m}), std::clamp(static_cast<int>(drawn / 50), 2, 11));
    ticks.minor.clear();
    ticks.major.back().label += " m";
    return ticks;
}

double header_height(const FalseColourPanel& panel) { return panel.subtitle.empty() ? 20 : 36; }

/// The layout of a panel: the frame holds the cells, the box also the header and the axes.
struct Tile {
    PageRectangle frame;
    PageRectangle box;
};

Tile make_tile(const FalseColourPanel& panel, double height) {
    double left = 0;
    double below = 4;
    if (has_size(panel)) {
        const Ticks ticks = length_ticks(panel.height_m, height);
        left = axis_extent(ticks, Side::left);
        below += axis_extent(ticks, Side::bottom);
    }
    const PageRectangle frame{left, header_height(panel), aspect_of(panel) * height, height};
    const double name = text_width(panel.name, kNameSize, Weight::bold) + kNameGap +
                        text_width(headline_of(panel), kSmallSize);
    const double header = left + std::max(name, text_width(panel.subtitle, kSmallSize));
    return {frame, {0, 0, std::max(frame.right(), header), frame.bottom() + below}};
}

void move(Tile& tile, double x, double y) {
    for (PageRectangle* rectangle : {&tile.frame, &tile.box}) {
        rectangle->left += x;
        rectangle->top += y;
    }
}

struct Layout {
    std::vector<Tile> tiles;
    double width = 0, height = 0;
};

using Panels = std::span<const FalseColourPanel>;

/// Tiles of one height side by side, from (0, 0).
Layout lay_out_row(Panels panels, double height) {
    Layout row;
    for (const FalseColourPanel& panel : panels) {
        Tile& tile = row.tiles.emplace_back(make_tile(panel, height));
        move(tile, row.tiles.size() > 1 ? row.width + kColumnGap : 0, 0);
        row.width = tile.box.right();
        row.height = std::max(row.height, tile.box.height);
    }
    return row;
}

/// The row that fills the content's width, or is as high as a row may be.
Layout fill_row(Panels panels, double most_height) {
    double low = kLeastRowHeight;
    double high = most_height;
    while (high - low > 0.5) {
        const double height = (low + high) / 2;
        (lay_out_row(panels, height).width > kContentWidth ? high : low) = height;
    }
    return lay_out_row(panels, std::floor(low));
}

Layout lay_out(Panels panels, std::size_t columns) {
    const std::size_t rows = (panels.size() + columns - 1) / columns;
    const double most_height = std::max(kLeastRowHeight, kMostHeight / double(rows));
    Layout layout;
    for (std::size_t i = 0; i < rows; ++i) {
        const std::size_t first = i * columns;
        Layout row = fill_row(panels.subspan(first, std::min(columns, panels.size() - first)), most_height);
        if (i > 0) layout.height += kRowGap;
        for (Tile& tile : row.tiles) {
            move(tile, 0, layout.height);
            layout.tiles.push_back(tile);
        }
        layout.width = std::max(layout.width, row.width);
        layout.height += row.height;
    }
    return layout;
}

/// Chooses the number of columns that gives the whole sheet the best proportions.
Layout lay_out(Panels panels) {
    Layout best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t columns = 1; columns <= std::min(panels.size(), kMostColumns); ++columns) {
        Layout layout = lay_out(panels, columns);
        const double badness = std::abs(std::log(layout.width / layout.height / kNiceAspect));
        if (badness >= least) continue;
        least = badness;
        best = std::move(layout);
    }
    return best;
}

std::vector<double> all_values(const FalseColour& picture) {
    std::vector<double> all;
    for (const FalseColourPanel& panel : picture.panels)
        all.insert(all.end(), panel.values.begin(), panel.values.end());
    return all;
}

int decimals_of(const FalseColourPanel& panel) {
    double largest = 0;
    for (const double value : panel.values) {
        if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    }
    return three_digit_decimals(largest);
}

/// The font size at which every number fits its cell; 0 where that would be too small to read.
double number_size(const FalseColourPanel& panel, const PageRectangle& frame) {
    constexpr double kLeast = 6;
    constexpr double kMost = 13;
    const PageRectangle place = cell_in(frame, panel, 0, 0);
    const double highest = std::min(kMost, 0.6 * place.height);
    if (highest < kLeast) return 0;
    const int decimals = decimals_of(panel);
    double widest = 0;  // at size 1
    for (const double value : panel.values) {
        if (!std::isfinite(value)) continue;
        widest = std::max(widest, text_width(number_text(value, decimals), 10) / 10);
    }
    if (widest == 0) return 0;
    const double size = std::min(highest, 0.84 * place.width / widest);
    return size < kLeast ? 0 : size;
}

/// Draws one panel after the other, with their common data.
class PanelPainter {
  public:
    PanelPainter(Canvas& canvas, FalseColourPainter& painter, const FalseColourOptions& options)
        : canvas_(canvas), painter_(painter), options_(options) {}

    void draw(const FalseColourPanel& panel, const Tile& tile) {
        draw_header(panel, tile);
        painter_.draw_cells(panel, tile.frame);
        const double text_size = options_.numbers ? number_size(panel, tile.frame) : 0;
        if (options_.isolines) {
            const std::vector<Isoline> isolines = painter_.draw_isolines(panel, tile.frame);
            if (text_size == 0) painter_.label_isolines(isolines, tile.frame);
        }
        if (text_size > 0) draw_numbers(panel, tile.frame, text_size);
        canvas_.stroke_rectangle(tile.frame, {kInk, 0.8});
        if (has_size(panel)) draw_lengths(panel, tile.frame);
    }

  private:
    void draw_header(const FalseColourPanel& panel, const Tile& tile) {
        const Point at{tile.frame.left, tile.box.top + 10};
        canvas_.text(at, panel.name, {.size = kNameSize, .colour = kInk, .weight = Weight::bold});
        const double indent =
            panel.name.empty() ? 0 : text_width(panel.name, kNameSize, Weight::bold) + kNameGap;
        canvas_.text({at.x + indent, at.y}, headline_of(panel), {.size = kSmallSize, .colour = kFaintInk});
        canvas_.text({at.x, at.y + 17}, panel.subtitle, {.size = kSmallSize, .colour = kInk});
    }

    void draw_lengths(const FalseColourPanel& panel, const PageRectangle& frame) {
        const auto draw = [&](double length_m, double drawn, Side side) {
            draw_axis(canvas_, Scale(ScaleType::linear, {0, length_m}), length_ticks(length_m, drawn), side,
                      frame);
        };
        draw(panel.width_m, frame.width, Side::bottom);
        draw(panel.height_m, frame.height, Side::left);
    }

    void draw_numbers(const FalseColourPanel& panel, const PageRectangle& frame, double size) {
        const int decimals = decimals_of(panel);
        auto value = panel.values.begin();
        for (int v = 0; v < panel.nv; ++v) {
            for (int u = 0; u < panel.nu; ++u, ++value)
                painter_.draw_number(cell_in(frame, panel, u, v).center(), *value, decimals, size);
        }
    }

    Canvas& canvas_;
    FalseColourPainter& painter_;
    const FalseColourOptions& options_;
};

void require_consistency(const FalseColour& picture) {
    if (picture.panels.empty()) throw std::invalid_argument("the false-colour picture has no panels");
    for (const FalseColourPanel& panel : picture.panels) {
        const bool counts_fit =
            panel.nu > 0 && panel.nv > 0 &&
            panel.values.size() / static_cast<std::size_t>(panel.nu) == static_cast<std::size_t>(panel.nv) &&
            panel.values.size() % static_cast<std::size_t>(panel.nu) == 0;
        if (!counts_fit) throw std::invalid_argument("panel '" + panel.name + "': counts and values differ");
    }
}

}  // namespace

void draw_false_colour(const FalseColour& picture, const FalseColourOptions& options,
                       const std::filesystem::path& path) {
    require_consistency(picture);
    const Scale scale = choose_scale(all_values(picture), options);
    Layout layout = lay_out(picture.panels);
    for (Tile& tile : layout.tiles) move(tile, kSheetMargin, kSheetMargin + kTitleHeight);

    // The bar stands beside the cells of the first row.
    const PageRectangle& first = layout.tiles.front().frame;
    const double content_bottom = kSheetMargin + kTitleHeight + layout.height;
    const double last_frame_bottom = layout.tiles.back().frame.bottom();
    const PageRectangle bar{kSheetMargin + layout.width + kBarGap, first.top, kBarWidth,
                            std::max(kLeastBarHeight, last_frame_bottom - first.top)};
    Canvas canvas(path, bar.left + bar_extent(scale) + kSheetMargin,
                  std::max(content_bottom, bar.bottom() + 8) + kSheetMargin - 8);
    canvas.text({layout.tiles.front().frame.left, kSheetMargin + kTitleSize}, picture.title,
                {.size = kTitleSize, .colour = kInk, .weight = Weight::bold});
    FalseColourPainter painter(canvas, scale);
    PanelPainter panel_painter(canvas, painter, options);
    for (std::size_t i = 0; i < picture.panels.size(); ++i) {
        panel_painter.draw(picture.panels[i], layout.tiles[i]);
    }
    painter.draw_bar(bar, picture.unit);
    canvas.save();
}

namespace {

constexpr std::size_t kSamples = 257;
/// Pieces by which the curve's length is measured: many per sample, so that steps come out equal to 1e-3.
constexpr std::size_t kPieces = 32 * (kSamples - 1);

struct Knot {
    double lightness, chroma, hue_degrees;
};

/// The knots of the curve: hues in one direction, chroma as strong as sRGB has it at that lightness.
constexpr std::array<Knot, 5> kKnots{{
    {0.13, 0.035, 280},
    {0.34, 0.155, 290},
    {0.55, 0.200, 358},
    {0.76, 0.150, 60},
    {0.97, 0.070, 105},
}};

io::Oklab to_oklab(const Knot& knot) {
    const double hue = knot.hue_degrees * std::numbers::pi / 180;
    return {knot.lightness, knot.chroma * std::cos(hue), knot.chroma * std::sin(hue)};
}

io::Oklab combine(double s, const io::Oklab& x, double t, const io::Oklab& y) {
    return {s * x.lightness + t * y.lightness, s * x.a + t * y.a, s * x.b + t * y.b};
}

/// Cubic through the knots (Catmull-Rom; straight beyond the ends), parameter 0 to 1.
io::Oklab curve_at(double parameter) {
    const double place = parameter * (kKnots.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), kKnots.size() - 2);
    const double t = place - static_cast<double>(i);
    const io::Oklab from = to_oklab(kKnots[i]);
    const io::Oklab to = to_oklab(kKnots[i + 1]);
    const io::Oklab before = i > 0 ? to_oklab(kKnots[i - 1]) : combine(2, from, -1, to);
    const io::Oklab after = i + 2 < kKnots.size() ? to_oklab(kKnots[i + 2]) : combine(2, to, -1, from);
    const io::Oklab ends = combine((1 + 2 * t) * (1 - t) * (1 - t), from, t * t * (3 - 2 * t), to);
    const double leave = t * (1 - t) * (1 - t) / 2;
    const double arrive = t * t * (t - 1) / 2;
    const io::Oklab slopes = combine(leave, combine(1, to, -1, before), arrive, combine(1, after, -1, from));
    return combine(1, ends, 1, slopes);
}

}  // namespace

ColourMap::ColourMap() {
    std::vector<io::Oklab> points(kPieces + 1);
    std::vector<double> length(kPieces + 1);
    for (std::size_t i = 0; i <= kPieces; ++i) {
        points[i] = curve_at(static_cast<double>(i) / kPieces);
        if (i > 0) length[i] = length[i - 1] + distance(points[i - 1], points[i]);
    }
    std::size_t i = 0;
    for (std::size_t sample = 0; sample < kSamples; ++sample) {
        const double wanted = length.back() * static_cast<double>(sample) / (kSamples - 1);
        while (i + 2 < length.size() && length[i + 1] < wanted) ++i;
        const double t = (wanted - length[i]) / (length[i + 1] - length[i]);
        samples_.push_back(combine(1 - t, points[i], t, points[i + 1]));
    }
}

io::Colour ColourMap::at(double fraction) const {
    const double place = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(samples_.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), samples_.size() - 2);
    const double t = place - static_cast<double>(i);
    return from_oklab(combine(1 - t, samples_[i], t, samples_[i + 1]));
}

}  // namespace stilb::plot
