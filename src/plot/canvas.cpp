
#include "plot/canvas.h"

#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "io/text/file_kind.h"
#include "io/text/table.h"
#include "io/text/utf8.h"
#include "stilb/error.h"

namespace stilb::plot {

struct SurfaceDeleter {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct ContextDeleter {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceDeleter>;
using Context = std::unique_ptr<cairo_t, ContextDeleter>;

namespace {

constexpr double kPixelsPerUnit = 2;
constexpr const char* kFont = "DejaVu Sans";
/// Height of capitals and digits over the font's size.
constexpr double kCapHeight = 0.73;

void require_success(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(cairo_status_to_string(status));
}

/// The output function of Cairo: `closure` is the std::string that collects the file.
cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

void set_font(cairo_t* context, double size, Weight weight) {
    cairo_select_font_face(context, kFont, CAIRO_FONT_SLANT_NORMAL,
                           weight == Weight::bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context, size);
    // Unhinted, text is as wide in a PNG as in an SVG.
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_set_font_options(context, options);
    cairo_font_options_destroy(options);
}

double advance(cairo_t* context, const std::string& text) {
    cairo_text_extents_t extents;
    cairo_text_extents(context, text.c_str(), &extents);
    return extents.x_advance;
}

void set_colour(cairo_t* context, const io::Colour& colour) {
    cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, colour.alpha);
}

void set_stroke(cairo_t* context, const Stroke& stroke) {
    set_colour(context, stroke.colour);
    cairo_set_line_width(context, stroke.width);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(context, stroke.dashes.data(), static_cast<int>(stroke.dashes.size()), 0);
}

/// The kind of picture that the extension stands for. Throws InputError where no picture can have it.
/// Standard output gets PNG.
io::FileKind picture_kind(const std::filesystem::path& path) {
    if (io::is_standard_output(path)) return io::FileKind::png_picture;
    const io::FileKind kind = io::kind_of_name(path);
    if (kind != io::FileKind::png_picture && kind != io::FileKind::svg_drawing) {
        throw InputError(fmt::format(
            "cannot tell the kind of picture from '{}'. End the name in .png or .svg.", path.string()));
    }
    return kind;
}

/// Cairo's images have no more pixels on a side.
void require_size(double width, double height) {
    constexpr double kMostPixels = 32767;
    if (kPixelsPerUnit * std::max(width, height) <= kMostPixels) return;
    throw InputError(
        fmt::format("the picture would have {:.0f} x {:.0f} pixels, but a .png has {:.0f} at most on a side. "
                    "Draw less at "
                    "once, or write an .svg.",
                    kPixelsPerUnit * width, kPixelsPerUnit * height, kMostPixels));
}

}  // namespace

void require_picture_path(const std::filesystem::path& path, std::span<const std::filesystem::path> inputs) {
    io::require_output(path, picture_kind(path), inputs);
}

struct Canvas::Cairo {
    /// The growing text of the SVG. It precedes the surface, because Cairo writes to it until the surface is
    /// finished.
    std::string svg;
    Surface surface;
    Context context;
};

Canvas::Canvas(std::filesystem::path path, double width, double height)
    : path_(std::move(path)), cairo_(std::make_unique<Cairo>()) {
    if (picture_kind(path_) == io::FileKind::svg_drawing) {
        cairo_->surface.reset(cairo_svg_surface_create_for_stream(append, &cairo_->svg, width, height));
        cairo_svg_surface_set_document_unit(cairo_->surface.get(), CAIRO_SVG_UNIT_PX);
    } else {
        require_size(width, height);
        cairo_->surface.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                                         static_cast<int>(width * kPixelsPerUnit),
                                                         static_cast<int>(height * kPixelsPerUnit)));
        cairo_surface_set_device_scale(cairo_->surface.get(), kPixelsPerUnit, kPixelsPerUnit);
    }
    cairo_->context.reset(cairo_create(cairo_->surface.get()));
    require_success(cairo_status(cairo_->context.get()));
    fill_rectangle({0, 0, width, height}, io::grey(1));
}

Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;

void Canvas::fill_rectangle(const PageRectangle& rectangle, const io::Colour& colour) {
    cairo_t* context = cairo_->context.get();
    set_colour(context, colour);
    cairo_set_antialias(context, CAIRO_ANTIALIAS_NONE);
    cairo_rectangle(context, rectangle.left, rectangle.top, rectangle.width, rectangle.height);
    cairo_fill(context);
    cairo_set_antialias(context, CAIRO_ANTIALIAS_DEFAULT);
}

void Canvas::image(const PageRectangle& place, const PixelImage& image) {
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height));
    require_success(cairo_surface_status(surface.get()));
    unsigned char* row = cairo_image_surface_get_data(surface.get());
    auto pixel = image.pixels.begin();
    for (int y = 0; y < image.height; ++y, row += cairo_image_surface_get_stride(surface.get())) {
        unsigned char* position_in_row = row;
        for (int x = 0; x < image.width; ++x, ++pixel, position_in_row += 4) {
            const std::uint32_t argb = *pixel == PixelImage::kTransparent ? 0 : 0xff000000 | *pixel;
            std::memcpy(position_in_row, &argb, 4);
        }
    }
    cairo_surface_mark_dirty(surface.get());
    cairo_t* context = cairo_->context.get();
    cairo_save(context);
    cairo_translate(context, place.left, place.top);
    cairo_scale(context, place.width / image.width, place.height / image.height);
    cairo_set_source_surface(context, surface.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_NEAREST);
    cairo_paint(context);
    cairo_restore(context);
}

void Canvas::stroke_rectangle(const PageRectangle& rectangle, const Stroke& stroke) {
    cairo_t* context = cairo_->context.get();
    cairo_rectangle(context, rectangle.left, rectangle.top, rectangle.width, rectangle.height);
    set_stroke(context, stroke);
    cairo_stroke(context);
}

void Canvas::line(const Point& from, const Point& to, const Stroke& stroke) {
    const Point points[] = {from, to};
    polyline(points, stroke);
}

void Canvas::polyline(std::span<const Point> points, const Stroke& stroke) {
    trace(points);
    set_stroke(cairo_->context.get(), stroke);
    cairo_stroke(cairo_->context.get());
}

void Canvas::fill_polygon(std::span<const Point> points, const io::Colour& colour) {
    trace(points);
    set_colour(cairo_->context.get(), colour);
    cairo_fill(cairo_->context.get());
}

void Canvas::fill_circle(const Point& center, double radius, const io::Colour& colour) {
    cairo_t* context = cairo_->context.get();
    cairo_new_path(context);
    cairo_arc(context, center.x, center.y, radius, 0, 2 * std::numbers::pi);
    set_colour(context, colour);
    cairo_fill(context);
}

void Canvas::text(const Point& at, const std::string& bytes, const TextStyle& style) {
    const std::string text = io::as_utf8(bytes);  // names of files may be anything
    cairo_t* context = cairo_->context.get();
    set_font(context, style.size, style.weight);
    const double width = advance(context, text);
    const double cap_height = kCapHeight * style.size;
    const double x = style.horizontal == HorizontalPart::left     ? 0
                     : style.horizontal == HorizontalPart::center ? -width / 2
                                                                  : -width;
    const double y = style.vertical == VerticalPart::top      ? cap_height
                     : style.vertical == VerticalPart::middle ? cap_height / 2
                                                              : 0;
    cairo_save(context);
    cairo_translate(context, at.x, at.y);
    cairo_rotate(context, style.angle_rad);
    cairo_move_to(context, x, y);
    if (style.halo) {
        cairo_text_path(context, text.c_str());
        set_stroke(context, {*style.halo, style.size / 3.5});
        cairo_stroke(context);
        cairo_move_to(context, x, y);
    }
    set_colour(context, style.colour);
    cairo_show_text(context, text.c_str());
    cairo_restore(context);
    cairo_new_path(context);
}

void Canvas::clipped(const PageRectangle& rectangle, const std::function<void()>& draw) {
    cairo_t* context = cairo_->context.get();
    cairo_save(context);
    cairo_rectangle(context, rectangle.left, rectangle.top, rectangle.width, rectangle.height);
    cairo_clip(context);
    draw();
    cairo_restore(context);
}

void Canvas::clipped_outside(std::span<const PageRectangle> rectangles, const std::function<void()>& draw) {
    cairo_t* context = cairo_->context.get();
    cairo_save(context);
    double left = 0, top = 0, right = 0, bottom = 0;
    cairo_clip_extents(context, &left, &top, &right, &bottom);
    cairo_rectangle(context, left, top, right - left, bottom - top);
    for (const PageRectangle& free : rectangles)
        cairo_rectangle(context, free.left, free.top, free.width, free.height);
    cairo_set_fill_rule(context, CAIRO_FILL_RULE_EVEN_ODD);
    cairo_clip(context);
    draw();
    cairo_restore(context);
}

void Canvas::save() {
    require_success(cairo_status(cairo_->context.get()));
    cairo_surface_t* surface = cairo_->surface.get();
    std::string png;
    const bool is_svg = cairo_surface_get_type(surface) == CAIRO_SURFACE_TYPE_SVG;
    if (!is_svg) require_success(cairo_surface_write_to_png_stream(surface, append, &png));
    cairo_surface_finish(surface);
    require_success(cairo_surface_status(surface));
    io::replace_file(path_, is_svg ? cairo_->svg : png);
}

void Canvas::trace(std::span<const Point> points) {
    cairo_t* context = cairo_->context.get();
    cairo_new_path(context);
    for (const Point& point : points) cairo_line_to(context, point.x, point.y);
}

double text_width(const std::string& text, double size, Weight weight) {
    const Surface surface(cairo_recording_surface_create(CAIRO_CONTENT_ALPHA, nullptr));
    const Context context(cairo_create(surface.get()));
    set_font(context.get(), size, weight);
    return advance(context.get(), text);
}

}  // namespace stilb::plot
