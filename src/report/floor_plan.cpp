#include "report/floor_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "plot/isolines.h"
#include "report/drawing.h"
#include "report/plan_lines.h"

namespace stilb::report {
namespace {

constexpr double kMostPlanWidth = 620, kMostPlanHeight = 760;
/// Texts on the plan, as the style sheet has them.
constexpr double kTextSize = 8.5;
/// A symbol for lamps that are smaller on the plan, and for points.
constexpr double kSymbol = 4;
constexpr double kArrow = 24, kArrowHead = 5;
/// Directions that are closer to the vertical have no arrow (the sine).
constexpr double kVertical = 0.05;
/// Single readings that are marked on the plan, of one sensor.
constexpr std::size_t kMostMarks = 40;

class FloorPlan {
  public:
    FloorPlan(const Scene& scene, const Bounds& bounds)
        : scene_(scene),
          frame_(frame_of(bounds)),
          drawing_(frame_.rectangle().right() + kDrawingMargin, frame_.rectangle().bottom() + kAxisBelow,
                   "Floor plan with luminaires and isolux lines"),
          labels_(frame_.rectangle()) {}

    double ratio() const { return frame_.ratio; }
    bool has_marks() const { return !marks_.empty(); }

    /// Draws the outline of each area with a line of twice the band's width, then covers what lies inside of
    /// the area. Wide bands come first.
    void draw_bands(std::span<const MeasuredPlane> planes) {
        std::vector<const MeasuredPlane*> bands;
        for (const MeasuredPlane& plane : planes) {
            if (!plane.is_whole() && plane.is_horizontal()) bands.push_back(&plane);
        }
        const auto width_m = [](const MeasuredPlane* plane) {
            return std::get<Area>(plane->result->sensor.kind).band_m[1];
        };
        std::ranges::stable_sort(bands, std::ranges::greater{}, width_m);
        for (const MeasuredPlane* band : bands) {
            const double width = 2 * width_m(band) * frame_.pixels_per_m();
            drawing_.stroked_path("band-edge", outline_path(*band), width + 1);
            drawing_.stroked_path("band", outline_path(*band), width - 1);
        }
        for (const MeasuredPlane* band : bands) drawing_.path("paper", outline_path(*band));
    }

    void draw_areas(std::span<const MeasuredPlane> planes) {
        for (const MeasuredPlane& plane : planes) {
            if (plane.is_whole()) drawing_.path("area", outline_path(plane));
        }
    }

    void draw_lines(const PlanLines& lines) {
        drawing_.path("edge", path_of_lines(lines.seen));
        drawing_.path("wall", path_of_lines(lines.cut));
    }

    void draw_isolines(const MeasuredPlane& plane, std::span<const plot::Tick> levels) {
        const plot::FalseColourPanel& panel = plane.panel;
        for (const auto& [level, label] : levels) {
            for (std::vector<Point> line : plot::find_isolines(panel.values, panel.nu, panel.nv, level)) {
                for (Point& point : line) point = on_plan(plane.at(point.x, point.y));
                drawing_.path("isoline", path_of(line));
                const auto place = labels_.place(line, plot::text_width(label, kTextSize));
                if (!place) continue;
                const double half_height = 0.36 * kTextSize;
                const Point base{place->center.x - half_height * std::sin(place->angle_rad),
                                 place->center.y + half_height * std::cos(place->angle_rad)};
                drawing_.text("isoline-label", base, label, Drawing::Anchor::middle, place->angle_rad);
            }
        }
    }

    void draw_lights() {
        for (const Light& light : scene_.lights) {
            if (location_of(light) != LightLocation::infinity) draw_light(light);
        }
    }

    void draw_marks(const SensorResult& result) {
        const Sensor& sensor = result.sensor;
        if (std::holds_alternative<Grid>(sensor.kind) || std::holds_alternative<Area>(sensor.kind)) return;
        for (std::size_t j = 0; j < std::min(sensor.size(), kMostMarks); ++j) {
            const Location location = sensor.location(j);
            const Point at = on_plan(location.position);
            drawing_.path("mark", fmt::format("M{0} {2}L{1} {2}M{3} {4}L{3} {5}", pixels(at.x - kSymbol),
                                              pixels(at.x + kSymbol), pixels(at.y), pixels(at.x),
                                              pixels(at.y - kSymbol), pixels(at.y + kSymbol)));
            if (!location.directions.empty()) draw_arrow("mark", at, location.directions.front().value);
            const std::string number = sensor.size() > 1 ? fmt::format(" {}", j + 1) : "";
            drawing_.text("mark-label", {at.x + kSymbol + 2, at.y - 2 + lines_below(at) * kTextSize},
                          sensor.name + number);
        }
    }

    Html finish() {
        draw_metres(drawing_, frame_);
        return drawing_.html();
    }

  private:
    static ScaledFrame frame_of(const Bounds& bounds) {
        constexpr double kShare = 0.02;  // of the extent
        const Vec3 extent = bounds.max - bounds.min;
        const double around_m = std::max(kShare * std::max(extent.x, extent.y), 1e-3);
        return {
            {bounds.min.x - around_m, bounds.max.x + around_m},
            {bounds.min.y - around_m, bounds.max.y + around_m},
            usual_ratio(extent.x + 2 * around_m, extent.y + 2 * around_m, kMostPlanWidth, kMostPlanHeight),
            {kAxisLeft, kDrawingMargin}};
    }

    /// The number of earlier marks in this place, below whose names that of the next one stands.
    double lines_below(const Point& at) {
        const auto earlier = std::ranges::count_if(
            marks_, [&](const Point& mark) { return std::hypot(mark.x - at.x, mark.y - at.y) < kSymbol; });
        marks_.push_back(at);
        return static_cast<double>(earlier);
    }

    Point on_plan(const Vec3& position) const { return frame_.at(position.x, position.y); }

    std::string path_of_lines(std::span<const PlanLine> lines) const {
        std::string path;
        for (const auto& [from, to] : lines)
            path += path_of(std::array{frame_.at(from.x, from.y), frame_.at(to.x, to.y)});
        return path;
    }

    std::string outline_path(const MeasuredPlane& plane) const {
        std::string path;
        for (const std::vector<Vec3>& ring : outlines_of(plane.result->sensor)) {
            std::vector<Point> points;
            for (const Vec3& corner : ring) points.push_back(on_plan(corner));
            path += path_of(points, Ends::closed);
        }
        return path;
    }

    void draw_arrow(std::string_view css_class, const Point& from, const Vec3& direction) {
        const double sine = std::hypot(direction.x, direction.y);
        if (sine < kVertical) return;
        const Point along{direction.x / sine, -direction.y / sine};
        const double reach = kArrow * std::min(sine, 1.0);
        const Point tip{from.x + reach * along.x, from.y + reach * along.y};
        const auto barb = [&](double side) {
            return Point{tip.x - kArrowHead * (along.x + side * along.y),
                         tip.y - kArrowHead * (along.y - side * along.x)};
        };
        drawing_.path(css_class,
                      path_of(std::array{from, tip}) + path_of(std::array{barb(0.5), tip, barb(-0.5)}));
    }

    /// Its opening to scale, or a symbol.
    void draw_light(const Light& light) {
        std::vector<Point> outline;
        Point middle, lowest;
        if (const auto object = emitting_object(light)) {
            for (const PlanPoint& corner : outline_from_above(scene_.object(*object).shape))
                outline.push_back(frame_.at(corner.x, corner.y));
            const auto [left, right] = std::ranges::minmax_element(outline, {}, &Point::x);
            const auto [top, bottom] = std::ranges::minmax_element(outline, {}, &Point::y);
            middle = {(left->x + right->x) / 2, (top->y + bottom->y) / 2};
            lowest = {middle.x, std::max(bottom->y, middle.y + kSymbol)};
            drawing_.path("luminaire", path_of(outline, Ends::closed));
            if (std::max(right->x - left->x, bottom->y - top->y) < 2 * kSymbol)
                drawing_.circle("luminaire", middle, kSymbol);
        } else {
            middle = on_plan(point_origin(light)->position);
            lowest = {middle.x, middle.y + kSymbol};
            drawing_.circle("luminaire", middle, kSymbol);
        }
        if (const Luminaire* luminaire = luminaire_of(light)) draw_arrow("aim", middle, luminaire->nadir);
        drawing_.text("luminaire-label", {lowest.x, lowest.y + kTextSize + 1}, light.name,
                      Drawing::Anchor::middle);
    }

    const Scene& scene_;
    ScaledFrame frame_;
    Drawing drawing_;
    plot::LabelPlacer labels_;
    std::vector<Point> marks_;
};

Html legend(const PlanLines& lines, const FloorPlan& plan, bool has_isolines) {
    std::string words =
        fmt::format("Scale 1 : {:g} in print. Section at z = {:.4g} m", plan.ratio(), lines.height_m);
    words += ": walls and high things are cut (bold), lower ones are seen from above. ";
    words += "Luminaires with their luminous openings; arrows: their aim where it is not vertical. ";
    if (has_isolines) words += "Blue: measured areas and isolux lines [lx]. ";
    if (plan.has_marks()) words += "Crosses: single sensors with their directions.";
    return element("figcaption", words);
}

}  // namespace

Html floor_plan(const Scene& scene, const rays::RayCaster& caster, std::span<const SensorResult> results,
                std::span<const MeasuredPlane> planes) {
    Bounds bounds = scene::bounds_of(scene);
    if (bounds.is_empty() || bounds.min.x == bounds.max.x || bounds.min.y == bounds.max.y) return {};
    const PlanLines lines = plan_lines(scene, caster, usual_plan_height(bounds));
    FloorPlan plan(scene, bounds);
    plan.draw_bands(planes);
    plan.draw_lights();
    plan.draw_lines(lines);
    plan.draw_areas(planes);
    bool has_isolines = false;
    if (!planes.empty()) {
        const std::vector<plot::Tick> levels = scale_ticks(common_scale(planes));
        for (const MeasuredPlane& plane : planes) {
            if (!plane.is_horizontal() || !plane.is_whole()) continue;
            plan.draw_isolines(plane, levels);
            has_isolines = true;
        }
    }
    for (const SensorResult& result : results) plan.draw_marks(result);
    return element("figure", {{"class", "plan"}}, plan.finish() + legend(lines, plan, has_isolines));
}

}  // namespace stilb::report
