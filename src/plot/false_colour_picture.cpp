
#include "plot/false_colour_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "plot/axis.h"
#include "plot/canvas.h"
#include "plot/false_colour_painter.h"
#include "sensors/areas/measured_raster.h"
#include "stilb/error.h"

namespace stilb::plot {

namespace {

constexpr const char* kUnit = "cd/m²";
constexpr double kGridPixelsPerUnit = 2;
/// Pixels of a PNG: pictures are magnified up to the first, averaged beyond the second.
constexpr int kMagnifiedSide = 1000, kLongestSide = 4096;
constexpr int kIsolineColumns = 160;
constexpr double kNumberWidth = 70, kNumberHeight = 44;
constexpr double kHeaderHeight = 38;

/// Rows from the bottom, as in panels.
FalseColourPanel panel_of(const io::Picture& picture) {
    std::optional<sensors::CameraView> view;
    if (picture.camera) view.emplace(*picture.camera);
    FalseColourPanel panel;
    panel.nu = picture.width;
    panel.nv = picture.height;
    panel.values.reserve(picture.pixel_count());
    for (int y = picture.height - 1; y >= 0; --y) {
        const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width);
        for (int x = 0; x < picture.width; ++x) {
            const bool is_seen = !view || view->direction_at(x + 0.5, y + 0.5);
            panel.values.push_back(is_seen ? picture.luminance_cd_m2(row + static_cast<std::size_t>(x))
                                           : std::numeric_limits<double>::quiet_NaN());
        }
    }
    return panel;
}

/// Columns or rows from `begin` to before `end`.
struct Stretch {
    int begin = 0, end = 0;
};

/// The middle `share` of part i of n, one cell at least.
Stretch stretch(int count, int n, int i, double share) {
    const double middle = (i + 0.5) * count / n;
    const double half = 0.5 * share * count / n;
    const int begin = std::clamp(static_cast<int>(std::lround(middle - half)), 0, count - 1);
    return {begin, std::clamp(static_cast<int>(std::lround(middle + half)), begin + 1, count)};
}

/// The mean; NaN where half of the values or more are NaN.
double mean_of(const FalseColourPanel& panel, const Stretch& u, const Stretch& v) {
    double sum = 0;
    int count = 0;
    for (int j = v.begin; j < v.end; ++j) {
        for (int i = u.begin; i < u.end; ++i) {
            const double value = panel.value_at(i, j);
            if (std::isnan(value)) continue;
            sum += value;
            ++count;
        }
    }
    const bool is_known = 2 * count > (u.end - u.begin) * (v.end - v.begin);
    return is_known ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

/// nu x nv means, each over the middle `share` of its part of the panel (along both sides).
FalseColourPanel averaged(const FalseColourPanel& panel, int nu, int nv, double share = 1) {
    FalseColourPanel result;
    result.nu = nu;
    result.nv = nv;
    for (int v = 0; v < nv; ++v) {
        for (int u = 0; u < nu; ++u)
            result.values.push_back(
                mean_of(panel, stretch(panel.nu, nu, u, share), stretch(panel.nv, nv, v, share)));
    }
    return result;
}

FalseColourPanel with_columns(const FalseColourPanel& panel, int columns) {
    if (columns >= panel.nu) return panel;
    return averaged(panel, columns,
                    std::max(1, static_cast<int>(std::lround(double(columns) * panel.nv / panel.nu))));
}

/// Small enough to be drawn pixel by pixel.
FalseColourPanel drawable(const FalseColourPanel& panel) {
    const double reduction = std::max(1.0, std::max(panel.nu, panel.nv) / double(kLongestSide));
    return with_columns(panel, std::max(1, static_cast<int>(panel.nu / reduction)));
}

/// A whole number of the PNG's pixels for each of the panel's.
PageRectangle frame_of(const FalseColourPanel& panel) {
    const int magnification = std::max(1, kMagnifiedSide / std::max(panel.nu, panel.nv));
    return {kSheetMargin, kSheetMargin + kTitleHeight + kHeaderHeight,
            panel.nu * magnification / kGridPixelsPerUnit, panel.nv * magnification / kGridPixelsPerUnit};
}

std::string headline_of(const io::Picture& picture, const FalseColourPanel& panel) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    double sum = 0;
    std::size_t count = 0;
    for (const double value : panel.values) {
        if (!std::isfinite(value)) continue;
        least = std::min(least, value);
        most = std::max(most, value);
        sum += value;
        ++count;
    }
    std::string text = fmt::format("{} × {} pixels", picture.width, picture.height);
    if (count == 0) return text + ", none with a value";
    const auto add = [&](const char* name, double value) {
        text += fmt::format("   {} {} {}", name, number_text(value, three_digit_decimals(value)), kUnit);
    };
    add("mean", sum / static_cast<double>(count));
    add("minimum", least);
    add("maximum", most);
    return text;
}

/// The side of the square over which a number is the mean, as a share of the distance of numbers.
constexpr double kSpotShare = 0.25;

/// Means about the middles of a coarse grid.
FalseColourPanel spots_of(const FalseColourPanel& panel, const PageRectangle& frame) {
    const auto parts = [](double length, double part, int most) {
        return std::clamp(static_cast<int>(length / part), 1, most);
    };
    return averaged(panel, parts(frame.width, kNumberWidth, panel.nu),
                    parts(frame.height, kNumberHeight, panel.nv), kSpotShare);
}

std::string spot_text(const io::Picture& picture, const FalseColourPanel& spots) {
    const auto pixels = [](int count, int parts) {
        return std::max(1L, std::lround(kSpotShare * count / parts));
    };
    return fmt::format("   numbers: means over {} × {} pixels", pixels(picture.width, spots.nu),
                       pixels(picture.height, spots.nv));
}

std::vector<CellNumber> numbers_of(const FalseColourPanel& means, const PageRectangle& frame) {
    std::vector<CellNumber> numbers;
    for (int v = 0; v < means.nv; ++v) {
        for (int u = 0; u < means.nu; ++u) {
            const double value = means.value_at(u, v);
            if (std::isnan(value)) continue;
            numbers.push_back({cell_in(frame, means, u, v).center(),
                               value,
                               {number_text(value, three_digit_decimals(value))},
                               kSmallSize});
        }
    }
    return numbers;
}

}  // namespace

void draw_false_colour(const io::Picture& picture, const std::string& title,
                       const FalseColourOptions& options, const std::filesystem::path& path) {
    require_consistency(picture);
    const FalseColourPanel whole = panel_of(picture);
    const Scale scale = choose_scale(whole.values, options);
    const FalseColourPanel panel = drawable(whole);
    const PageRectangle frame = frame_of(panel);
    const PageRectangle bar{frame.right() + kBarGap, frame.top, kBarWidth,
                            std::max(kLeastBarHeight, frame.height)};
    std::string headline = headline_of(picture, whole);
    std::vector<CellNumber> numbers;
    if (options.numbers) {
        const FalseColourPanel spots = spots_of(panel, frame);
        numbers = numbers_of(spots, frame);
        headline += spot_text(picture, spots);
    }
    const double text_width_needed =
        std::max(text_width(title, kTitleSize, Weight::bold), text_width(headline, kSmallSize));
    Canvas canvas(path,
                  std::max(bar.left + bar_extent(scale), kSheetMargin + text_width_needed) + kSheetMargin,
                  bar.bottom() + kSheetMargin);
    canvas.text({frame.left, kSheetMargin + kTitleSize}, title,
                {.size = kTitleSize, .colour = kInk, .weight = Weight::bold});
    canvas.text({frame.left, frame.top - kHeaderHeight + 10}, headline, {.size = kSmallSize, .colour = kInk});

    FalseColourPainter painter(canvas, scale);
    painter.draw_cells(panel, frame);
    if (options.isolines) {
        const std::vector<Isoline> isolines =
            painter.draw_isolines(with_columns(panel, kIsolineColumns), frame, numbers);
        if (!options.numbers) painter.label_isolines(isolines, frame);
    }
    for (const CellNumber& number : numbers) painter.draw_number(number);
    canvas.stroke_rectangle(frame, {kInk, 0.8});
    painter.draw_bar(bar, kUnit);
    canvas.save();
}

namespace {

std::string subtitle_of(const io::MeasuredGrid& grid, const FalseColourOptions& options) {
    std::string text;
    const auto add = [&](const char* name, const io::MeasuredValue& measured, int decimals,
                         const std::string& unit) {
        if (std::isnan(measured.value)) return;
        std::string value = number_text(measured.value, decimals);
        if (options.errors && measured.half_width > 0) {
            const int digits = std::max(three_digit_decimals(measured.half_width) - 1, 0);
            value = fmt::format("{} ± {}", number_text(measured.value, digits),
                                number_text(measured.half_width, digits));
        }
        text += fmt::format("{}{} {}{}", text.empty() ? "" : "   ", name, value, unit);
    };
    const io::MeasuredSummary& summary = grid.summary;
    add("mean", summary.mean, three_digit_decimals(summary.mean.value), " " + grid.unit);
    add("minimum", summary.minimum, three_digit_decimals(summary.minimum.value), " " + grid.unit);
    add("uniformity", summary.uniformity, 2, "");
    return text;
}

io::MeasuredValue measured_value(const statistics::Estimate& estimate) {
    return {estimate.value, (estimate.upper - estimate.lower) / 2};
}

io::MeasuredGrid measured_grid(const SensorResult& result, const Grid& of) {
    const Sensor& sensor = result.sensor;
    const Quantity quantity = sensor.quantity();
    io::MeasuredGrid grid;
    grid.name = sensor.name;
    grid.quantity = quantity.name;
    grid.unit = quantity.unit;
    grid.count = of.count;
    // As in files, which have no more than the middles of the cells.
    const auto [nu, nv] = grid.count;
    const double cell_u_m = nu > 1 ? length(of.edge_u) / nu : 0;
    const double cell_v_m = nv > 1 ? length(of.edge_v) / nv : 0;
    grid.width_m = nu * (nu > 1 ? cell_u_m : cell_v_m);
    grid.height_m = nv * (nv > 1 ? cell_v_m : cell_u_m);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    grid.values.assign(of.size(), {none, none});
    const std::vector<std::size_t> cells = sensors::cells_of_readings(sensor);
    for (std::size_t j = 0; j < cells.size(); ++j)
        grid.values[cells[j]] = measured_value(result.readings[j].estimate);
    const statistics::GridSummary& summary = result.summary;
    grid.summary = {measured_value(summary.mean), measured_value(summary.minimum),
                    measured_value(summary.maximum), measured_value(summary.uniformity)};
    return grid;
}

FalseColourPanel panel_of(const io::MeasuredGrid& grid, const FalseColourOptions& options) {
    FalseColourPanel panel{
        grid.name, subtitle_of(grid, options), grid.count[0], grid.count[1], grid.width_m, grid.height_m, {}};
    for (const io::MeasuredValue& measured : grid.values) {
        panel.values.push_back(measured.value);
        if (options.errors) panel.errors.push_back(measured.half_width);
    }
    return panel;
}

void require_errors(const io::MeasuredGrid& grid) {
    const auto has_error = [](const io::MeasuredValue& measured) { return measured.half_width >= 0; };
    if (std::ranges::any_of(grid.values, has_error)) return;
    throw InputError(
        fmt::format("the values of '{}' have no intervals to write. Leave --errors out.", grid.name));
}

void require_some(bool has_grids) {
    if (has_grids) return;
    throw InputError(
        "the results contain no grid and no area, and only these can be drawn. Measure a sensor of type "
        "\"grid\", "
        "\"area\" or \"plane\".");
}

}  // namespace

void require_grids(std::span<const Sensor> sensors) {
    require_some(
        std::ranges::any_of(sensors, [](const Sensor& sensor) { return sensors::raster_of(sensor); }));
}

FalseColour picture_of(const RunResult& result, const std::string& scene, const FalseColourOptions& options) {
    io::ResultsFile results{scene, result.scene_name, {}};
    for (const SensorResult& sensor : result.sensors) {
        if (const Grid* raster = sensors::raster_of(sensor.sensor))
            results.grids.push_back(measured_grid(sensor, *raster));
    }
    return picture_of(results, options);
}

FalseColour picture_of(const io::ResultsFile& results, const FalseColourOptions& options) {
    require_some(!results.grids.empty());
    const io::MeasuredGrid& first = results.grids.front();
    const std::string& scene = results.scene_name.empty() ? results.scene : results.scene_name;
    FalseColour picture{fmt::format("{}: {}", scene, first.quantity), first.unit, {}};
    for (const io::MeasuredGrid& grid : results.grids) {
        if (grid.unit != first.unit) {
            throw InputError(
                fmt::format("'{}' is in {} and '{}' in {}, but one scale cannot show both. Choose sensors of "
                            "one quantity.",
                            first.name, first.unit, grid.name, grid.unit));
        }
        if (options.errors) require_errors(grid);
        picture.panels.push_back(panel_of(grid, options));
    }
    return picture;
}

}  // namespace stilb::plot
