// A sheet to draw on, saved as PNG or SVG: the same calls give the same picture in both. Only this
// implementation includes Cairo.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/image/tone_curve.h"

namespace stilb::plot {

/// All lengths are in units of 1/96 inch; y grows downwards. A PNG has two pixels to the unit.
struct Point {
    double x = 0, y = 0;
};

struct PageRectangle {
    double left = 0, top = 0, width = 0, height = 0;

    double right() const { return left + width; }
    double bottom() const { return top + height; }
    Point center() const { return {left + width / 2, top + height / 2}; }
};

struct Stroke {
    io::Colour colour;
    double width = 1;
    std::vector<double> dashes{};  ///< lengths on, off, ...; solid where empty
};

enum class Weight { regular, bold };
/// The part of the text that lies at the given point.
enum class HorizontalPart { left, center, right };
enum class VerticalPart { top, middle, baseline };

struct TextStyle {
    double size = 11;
    io::Colour colour{};
    Weight weight = Weight::regular;
    HorizontalPart horizontal = HorizontalPart::left;
    VerticalPart vertical = VerticalPart::baseline;
    double angle_rad = 0;  ///< clockwise
    std::optional<io::Colour> halo{};
};

/// Pixels row by row from the top: 0xRRGGBB, or kTransparent.
struct PixelImage {
    static constexpr std::uint32_t kTransparent = 0xff000000;
    int width = 0, height = 0;  ///< up to 32767
    std::vector<std::uint32_t> pixels;
};

inline constexpr double kUpwards = -std::numbers::pi / 2;

/// Advance width of one line of text.
double text_width(const std::string& text, double size, Weight weight = Weight::regular);

/// Throws InputError where no picture can be written to `path`: for another extension than .png or .svg (any
/// case), and as io::require_output() does. `inputs`: the files that are read for the picture.
void require_picture_path(const std::filesystem::path& path, std::span<const std::filesystem::path> inputs);

class Canvas {
  public:
    /// A white sheet. The extension of `path` selects the format: .png or .svg (any case); InputError
    /// for others, and where the sheet is too large for a .png.
    Canvas(std::filesystem::path path, double width, double height);
    ~Canvas();
    Canvas(Canvas&&) noexcept;
    Canvas& operator=(Canvas&&) noexcept;

    /// A rectangle with hard edges, so that neighbours leave no seam.
    void fill_rectangle(const PageRectangle& rectangle, const io::Colour& colour);
    /// An image whose pixels stay sharp at any magnification.
    void image(const PageRectangle& place, const PixelImage& image);
    void stroke_rectangle(const PageRectangle& rectangle, const Stroke& stroke);
    void line(const Point& from, const Point& to, const Stroke& stroke);
    /// An open line with round joins.
    void polyline(std::span<const Point> points, const Stroke& stroke);
    void fill_polygon(std::span<const Point> points, const io::Colour& colour);
    void fill_circle(const Point& center, double radius, const io::Colour& colour);
    void text(const Point& at, const std::string& text, const TextStyle& style);
    /// Clips the drawing of `draw` to the rectangle.
    void clipped(const PageRectangle& rectangle, const std::function<void()>& draw);
    /// Leaves the rectangles free. They must not overlap.
    void clipped_outside(std::span<const PageRectangle> rectangles, const std::function<void()>& draw);

    /// Replaces the file in one step; nothing may be drawn afterwards. Throws InputError where it cannot be
    /// written.
    void save();

  private:
    struct Cairo;
    void trace(std::span<const Point> points);

    std::filesystem::path path_;
    std::unique_ptr<Cairo> cairo_;
};

}  // namespace stilb::plot
