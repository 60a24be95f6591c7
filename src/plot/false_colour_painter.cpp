#include "plot/false_colour_painter.h"

#include <algorithm>
#include <cmath>

#include "plot/axis.h"
#include "plot/isolines.h"

namespace stilb::plot {
namespace {

constexpr int kMostDecades = 4;
constexpr int kBarTicks = 9;
/// The number of cells from which they are drawn as one image: many rectangles would be slow, and an SVG of
/// them huge.
constexpr std::size_t kMostRectangles = 20'000;

double length_of(std::span<const Point> line) {
    double sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        sum += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
    return sum;
}

std::uint32_t to_rgb(const io::Colour& colour) {
    const auto [red, green, blue] = io::bytes_of(colour);
    return std::uint32_t{red} << 16 | std::uint32_t{green} << 8 | std::uint32_t{blue};
}

/// The panel's first row of values comes last in the image.
PixelImage image_of(const FalseColourPanel& panel, const Scale& scale, const io::ColourMap& map) {
    PixelImage image{panel.nu, panel.nv, {}};
    image.pixels.reserve(panel.values.size());
    for (int v = panel.nv - 1; v >= 0; --v) {
        for (int u = 0; u < panel.nu; ++u) {
            const double value = panel.value_at(u, v);
            image.pixels.push_back(std::isnan(value) ? PixelImage::kTransparent
                                                     : to_rgb(map.at(scale.fraction_of(value))));
        }
    }
    return image;
}

constexpr double kLowerLine = 0.8;    ///< the size of further lines over the first
constexpr double kLineSpacing = 1.3;  ///< from line to line, over the lower one's size
constexpr double kCapitals = 0.73;    ///< the height of digits over the font's size
/// Between a number and the isolines that it interrupts.
constexpr double kSpaceAround = 2;

double line_size(const CellNumber& number, std::size_t line) {
    return line == 0 ? number.size : kLowerLine * number.size;
}

/// From the top of the first digits to the bottom of the last ones.
double text_height(const CellNumber& number) {
    double height = kCapitals * number.size;
    for (std::size_t line = 1; line < number.lines.size(); ++line)
        height += kLineSpacing * line_size(number, line);
    return height;
}

}  // namespace

PageRectangle text_box(const CellNumber& number) {
    double width = 0;
    for (std::size_t line = 0; line < number.lines.size(); ++line)
        width = std::max(width, text_width(number.lines[line], line_size(number, line)));
    const double height = text_height(number);
    return {number.center.x - width / 2, number.center.y - height / 2, width, height};
}

Scale choose_scale(std::span<const double> values, const FalseColourOptions& options) {
    // Light is not negative: values below 0 are noise around a value near 0.
    std::vector<double> lit;
    for (const double value : values) lit.push_back(value < 0 ? 0 : value);
    AxisRange range = nice_range(options.scale, lit);
    if (options.scale == ScaleType::logarithmic) {
        range.low = std::max(range.low, range.high * std::pow(10.0, -kMostDecades));
    }
    range.low = options.minimum.value_or(range.low);
    range.high = options.maximum.value_or(range.high);
    return Scale(options.scale, range);
}

double bar_extent(const Scale& scale) {
    return kBarWidth + axis_extent(nice_ticks(scale, kBarTicks), Side::right);
}

PageRectangle cell_in(const PageRectangle& frame, const FalseColourPanel& panel, int u, int v) {
    const double width = frame.width / panel.nu;
    const double height = frame.height / panel.nv;
    return {frame.left + u * width, frame.bottom() - (v + 1) * height, width, height};
}

FalseColourPainter::FalseColourPainter(Canvas& canvas, const Scale& scale)
    : canvas_(canvas), scale_(scale), ticks_(nice_ticks(scale, kBarTicks)) {}

void FalseColourPainter::draw_cells(const FalseColourPanel& panel, const PageRectangle& frame) {
    const bool has_holes =
        std::any_of(panel.values.begin(), panel.values.end(), [](double value) { return std::isnan(value); });
    if (has_holes) draw_hatching(frame);
    if (panel.values.size() > kMostRectangles) {
        canvas_.image(frame, image_of(panel, scale_, map_));
        return;
    }
    for (int v = 0; v < panel.nv; ++v) {
        for (int u = 0; u < panel.nu; ++u) {
            const double value = panel.value_at(u, v);
            if (!std::isnan(value))
                canvas_.fill_rectangle(cell_in(frame, panel, u, v), map_.at(scale_.fraction_of(value)));
        }
    }
}

void FalseColourPainter::draw_hatching(const PageRectangle& place) {
    constexpr double kSpacing = 6;
    canvas_.fill_rectangle(place, io::grey(0.86));
    canvas_.clipped(place, [&] {
        // Lines x + y = n * spacing.
        const double last = place.right() + place.bottom();
        for (double sum = std::ceil((place.left + place.top) / kSpacing) * kSpacing; sum < last;
             sum += kSpacing) {
            canvas_.line({sum - place.top, place.top}, {sum - place.bottom(), place.bottom()},
                         {io::grey(0.62), 1});
        }
    });
}

std::vector<Isoline> FalseColourPainter::find_lines(const FalseColourPanel& panel,
                                                    const PageRectangle& frame) const {
    // Along the scale's own measure, so that lines on a logarithmic scale lie where the colours say; the
    // lower limit stands in for values without a logarithm.
    std::vector<double> fractions;
    for (const double value : panel.values) {
        fractions.push_back(std::isnan(value) ? value : std::max(scale_.fraction_of(value), -1.0));
    }
    std::vector<Isoline> isolines;
    for (const Tick& tick : ticks_.major) {
        const double level = scale_.fraction_of(tick.value);
        if (level <= 0 || level >= 1) continue;  // a level at an end has the colour of all values beyond it
        for (std::vector<Point> line : find_isolines(fractions, panel.nu, panel.nv, level)) {
            for (Point& point : line) {
                point = {frame.left + point.x / panel.nu * frame.width,
                         frame.bottom() - point.y / panel.nv * frame.height};
            }
            if (length_of(line) >= kSmallSize) isolines.push_back({std::move(line), tick.label});
        }
    }
    return isolines;
}

std::vector<Isoline> FalseColourPainter::draw_isolines(const FalseColourPanel& panel,
                                                       const PageRectangle& frame,
                                                       std::span<const CellNumber> numbers) {
    std::vector<Isoline> isolines = find_lines(panel, frame);
    std::vector<PageRectangle> gaps;
    for (const CellNumber& number : numbers) {
        const PageRectangle box = text_box(number);
        gaps.push_back({box.left - kSpaceAround, box.top - kSpaceAround, box.width + 2 * kSpaceAround,
                        box.height + 2 * kSpaceAround});
    }
    canvas_.clipped_outside(gaps, [&] {
        for (const Isoline& isoline : isolines) {
            // White in a dark casing: seen on every colour.
            canvas_.polyline(isoline.points, {io::with_alpha(io::grey(0), 0.5), 2.6});
            canvas_.polyline(isoline.points, {io::grey(1), 1.2});
        }
    });
    return isolines;
}

void FalseColourPainter::label_isolines(std::span<const Isoline> isolines, const PageRectangle& frame) {
    LabelPlacer placer(frame);
    for (const Isoline& isoline : isolines) {
        const auto place = placer.place(isoline.points, text_width(isoline.label, kSmallSize));
        if (!place) continue;
        canvas_.text(place->center, isoline.label,
                     {.size = kSmallSize,
                      .colour = io::grey(0),
                      .horizontal = HorizontalPart::center,
                      .vertical = VerticalPart::middle,
                      .angle_rad = place->angle_rad,
                      .halo = io::grey(1)});
    }
}

void FalseColourPainter::draw_number(const CellNumber& number) {
    // The halo is seen only where the surroundings differ.
    const io::Colour background = map_.at(scale_.fraction_of(number.value));
    double baseline = number.center.y - text_height(number) / 2 + kCapitals * number.size;
    for (std::size_t line = 0; line < number.lines.size(); ++line) {
        const double size = line_size(number, line);
        if (line > 0) baseline += kLineSpacing * size;
        canvas_.text({number.center.x, baseline}, number.lines[line],
                     {.size = size,
                      .colour = readable_on(background),
                      .horizontal = HorizontalPart::center,
                      .halo = background});
    }
}

void FalseColourPainter::draw_bar(const PageRectangle& bar, const std::string& unit) {
    constexpr int kStrips = 256;
    for (int i = 0; i < kStrips; ++i) {
        const double top = bar.top + bar.height * i / kStrips;
        canvas_.fill_rectangle({bar.left, top, bar.width, bar.bottom() - top},
                               map_.at(1 - (i + 0.5) / kStrips));
    }
    canvas_.stroke_rectangle(bar, {kInk, 0.8});
    draw_axis(canvas_, scale_, ticks_, Side::right, bar);
    canvas_.text({bar.left, bar.top - 10}, unit, {.size = kNameSize, .colour = kInk, .weight = Weight::bold});
}

}  // namespace stilb::plot
