#include "report/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace stilb::report {
namespace {

constexpr double kPixelsPerMetre = 96 / 0.0254;
constexpr double kTick = 4;

std::string_view name_of(Drawing::Anchor anchor) {
    constexpr std::array<std::string_view, 3> kNames{"start", "middle", "end"};
    return kNames[static_cast<std::size_t>(anchor)];
}

/// At least three labels; `distance`: between them.
plot::Ticks metre_ticks(const plot::AxisRange& range, double drawn, double distance) {
    plot::Ticks ticks = plot::nice_ticks(plot::Scale(plot::ScaleType::linear, range),
                                         std::clamp(static_cast<int>(drawn / distance), 3, 15));
    if (!ticks.major.empty()) ticks.major.back().label += " m";
    return ticks;
}

}  // namespace

std::string pixels(double length) {
    const double rounded = std::round(100 * length) / 100;
    return fmt::format("{:.7g}", rounded == 0 ? 0 : rounded);
}

std::string path_of(std::span<const Point> points, Ends ends) {
    std::string path;
    for (std::size_t i = 0; i < points.size(); ++i)
        path += fmt::format("{}{} {}", i == 0 ? 'M' : 'L', pixels(points[i].x), pixels(points[i].y));
    return ends == Ends::closed ? path + 'Z' : path;
}

std::string hexadecimal(const io::Colour& colour) {
    const auto [red, green, blue] = io::bytes_of(colour);
    return fmt::format("#{:02x}{:02x}{:02x}", red, green, blue);
}

Drawing::Drawing(double width, double height, std::string label)
    : width_(width), height_(height), label_(std::move(label)) {}

void Drawing::path(std::string_view css_class, const std::string& path) {
    if (path.empty()) return;
    shapes_ += element("path", {{"class", std::string(css_class)}, {"d", path}}) + raw("\n");
}

void Drawing::filled_path(std::string_view css_class, const std::string& path, const io::Colour& fill) {
    shapes_ += element("path", {{"class", std::string(css_class)},
                                {"style", fmt::format("fill:{0};stroke:{0}", hexadecimal(fill))},
                                {"d", path}}) +
               raw("\n");
}

void Drawing::stroked_path(std::string_view css_class, const std::string& path, double width) {
    shapes_ +=
        element("path", {{"class", std::string(css_class)}, {"stroke-width", pixels(width)}, {"d", path}}) +
        raw("\n");
}

void Drawing::line(std::string_view css_class, const Point& from, const Point& to) {
    path(css_class, path_of(std::array{from, to}));
}

void Drawing::circle(std::string_view css_class, const Point& center, double radius) {
    shapes_ += element("circle", {{"class", std::string(css_class)},
                                  {"cx", pixels(center.x)},
                                  {"cy", pixels(center.y)},
                                  {"r", pixels(radius)}}) +
               raw("\n");
}

void Drawing::text(std::string_view css_class, const Point& at, const std::string& text, Anchor anchor,
                   double angle_rad) {
    const std::string place = fmt::format("translate({} {}) rotate({})", pixels(at.x), pixels(at.y),
                                          pixels(angle_rad * 180 / std::numbers::pi));
    shapes_ += element("text",
                       {{"class", std::string(css_class)},
                        {"transform", place},
                        {"text-anchor", std::string(name_of(anchor))}},
                       report::text(text)) +
               raw("\n");
}

void Drawing::number(const Point& center, const std::string& text, double size, const io::Colour& colour) {
    constexpr double kHalfOfDigits = 0.365;
    shapes_ += element("text",
                       {{"class", "value"},
                        {"x", pixels(center.x)},
                        {"y", pixels(center.y + kHalfOfDigits * size)},
                        {"text-anchor", "middle"},
                        {"font-size", pixels(size)},
                        {"style", "fill:" + hexadecimal(colour)}},
                       report::text(text)) +
               raw("\n");
}

void Drawing::clipped(const std::string& id, const std::string& region, const Drawing& contents) {
    if (contents.shapes_.is_empty()) return;
    shapes_ += element("clipPath", {{"id", id}}, element("path", {{"d", region}})) +
               element("g", {{"clip-path", fmt::format("url(#{})", id)}}, raw("\n") + contents.shapes_) +
               raw("\n");
}

Html Drawing::html() const {
    return element("svg",
                   {{"xmlns", "http://www.w3.org/2000/svg"},
                    {"width", pixels(width_)},
                    {"height", pixels(height_)},
                    {"viewBox", fmt::format("0 0 {} {}", pixels(width_), pixels(height_))},
                    {"role", "img"},
                    {"aria-label", label_}},
                   raw("\n") + shapes_);
}

double ScaledFrame::pixels_per_m() const { return kPixelsPerMetre / ratio; }

plot::PageRectangle ScaledFrame::rectangle() const {
    return {origin.x, origin.y, pixels_per_m() * (x_m.high - x_m.low), pixels_per_m() * (y_m.high - y_m.low)};
}

Point ScaledFrame::at(double x, double y) const {
    return {origin.x + pixels_per_m() * (x - x_m.low), origin.y + pixels_per_m() * (y_m.high - y)};
}

double usual_ratio(double width_m, double height_m, double most_width, double most_height) {
    const double least =
        kPixelsPerMetre * std::max({width_m / most_width, height_m / most_height, 1 / kPixelsPerMetre});
    for (double decade = std::pow(10, std::floor(std::log10(least)));; decade *= 10) {
        for (const double step : {1.0, 2.0, 2.5, 5.0, 7.5}) {
            if (step * decade >= least) return step * decade;
        }
    }
}

void draw_metres(Drawing& drawing, const ScaledFrame& frame) {
    constexpr double kColumn = 50, kRow = 34, kTextHeight = 7;
    const plot::PageRectangle box = frame.rectangle();
    drawing.path("frame", path_of(std::array<Point, 4>{{{box.left, box.top},
                                                        {box.right(), box.top},
                                                        {box.right(), box.bottom()},
                                                        {box.left, box.bottom()}}},
                                  Ends::closed));
    for (const auto& [value, label] : metre_ticks(frame.x_m, box.width, kColumn).major) {
        const double x = frame.at(value, 0).x;
        drawing.line("tick", {x, box.bottom()}, {x, box.bottom() + kTick});
        drawing.text("axis", {x, box.bottom() + kTick + 3 + kTextHeight}, label, Drawing::Anchor::middle);
    }
    for (const auto& [value, label] : metre_ticks(frame.y_m, box.height, kRow).major) {
        const double y = frame.at(0, value).y;
        drawing.line("tick", {box.left - kTick, y}, {box.left, y});
        drawing.text("axis", {box.left - kTick - 3, y + kTextHeight / 2}, label, Drawing::Anchor::end);
    }
}

}  // namespace stilb::report
