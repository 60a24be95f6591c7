#include "report/floor_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "plot/isolines.h"
#include "report/drawing.h"
#include "report/plan_lines.h"
#include "report/text_places.h"
#include "sensors/areas/rooms.h"

namespace stilb::report {
namespace {

constexpr double kMostPlanWidth = 620, kMostPlanHeight = 760, kMostRoomHeight = 440;
/// A room has a plan of its own where it is so many times as large there.
constexpr double kLarger = 1.9;
/// What a room's plan shows around it.
constexpr double kAroundRoom_m = 0.3;
/// Texts on the plan, as the style sheet has them.
constexpr double kTextSize = 8.5, kTextHeight = 9;
/// A symbol for lamps that are smaller on the plan, and for points.
constexpr double kSymbol = 4;
constexpr double kArrow = 24, kArrowHead = 5;
/// Directions that are closer to the vertical have no arrow (the sine).
constexpr double kVertical = 0.05;
/// Single readings that are marked on the plan, of one sensor.
constexpr std::size_t kMostMarks = 40;

class FloorPlan {
  public:
    /// `id`: of the plan, for parts of its markup.
    FloorPlan(const Scene& scene, const ScaledFrame& frame, std::string id)
        : scene_(scene),
          id_(std::move(id)),
          frame_(frame),
          drawing_(frame.rectangle().right() + kDrawingMargin, frame.rectangle().bottom() + kAxisBelow,
                   "Floor plan with luminaires and isolux lines"),
          contents_(0, 0, ""),
          places_(frame.rectangle()),
          line_labels_(frame.rectangle()) {}

    double ratio() const { return frame_.ratio; }
    bool has_marks() const { return has_marks_; }
    bool lacks_names() const { return lacks_names_; }

    /// Draws the outline of each area with a line of twice the band's width, as far as its room reaches, then
    /// covers what lies inside of the area. Wide bands come first.
    void draw_bands(std::span<const MeasuredPlane> planes, std::span<const sensors::Room> rooms) {
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
            Drawing strip(0, 0, "");
            strip.stroked_path("band-edge", outline_path(*band), width + 1);
            strip.stroked_path("band", outline_path(*band), width - 1);
            const sensors::Room* const room = room_of(rooms, std::get<Area>(band->result->sensor.kind));
            contents_.clipped(fmt::format("{}-band-{}", id_, ++bands_),
                              room ? path_of_room(*room) : path_of_frame(), strip);
        }
        for (const MeasuredPlane* band : bands) contents_.path("paper", outline_path(*band));
    }

    void draw_areas(std::span<const MeasuredPlane> planes) {
        for (const MeasuredPlane& plane : planes) {
            if (!plane.is_whole()) continue;
            contents_.path("area", outline_path(plane));
            if (!plane.is_horizontal()) continue;
            std::vector<Point> corners;
            const std::vector<std::vector<Vec3>> outlines = outlines_of(plane.result->sensor);
            for (const Vec3& corner : outlines.front()) corners.push_back(on_plan(corner));
            labels_.push_back({"area-label", plane.result->sensor.name, box_around(corners), Beside::no});
        }
    }

    void draw_lines(const PlanLines& lines) {
        contents_.path("edge", path_of_lines(lines.seen));
        contents_.path("wall", path_of_lines(lines.cut));
    }

    /// After all things and before the isolines, which leave room for the names.
    void place_labels() {
        for (const auto& [css_class, text, thing, beside] : labels_) {
            if (!is_in_frame(thing.center())) continue;
            const double width = plot::text_width(text, kTextSize);
            const auto place = beside == Beside::yes ? places_.place_beside(thing, width, kTextHeight)
                                                     : places_.place_within(thing, width, kTextHeight);
            if (!place) {
                lacks_names_ = true;
                continue;
            }
            constexpr double kBaseline = 0.78;  // of the height, from above
            texts_.text(css_class, {place->left, place->top + kBaseline * place->height}, text);
            line_labels_.avoid(*place);
        }
    }

    void draw_isolines(const MeasuredPlane& plane, std::span<const plot::Tick> levels) {
        const plot::FalseColourPanel& panel = plane.panel;
        for (const auto& [level, label] : levels) {
            for (std::vector<Point> line : plot::find_isolines(panel.values, panel.nu, panel.nv, level)) {
                for (Point& point : line) point = on_plan(plane.at(point.x, point.y));
                contents_.path("isoline", path_of(line));
                const auto place = line_labels_.place(line, plot::text_width(label, kTextSize));
                if (!place) continue;
                const double half_height = 0.36 * kTextSize;
                const Point base{place->center.x - half_height * std::sin(place->angle_rad),
                                 place->center.y + half_height * std::cos(place->angle_rad)};
                contents_.text("isoline-label", base, label, Drawing::Anchor::middle, place->angle_rad);
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
            contents_.path("mark", fmt::format("M{0} {2}L{1} {2}M{3} {4}L{3} {5}", pixels(at.x - kSymbol),
                                               pixels(at.x + kSymbol), pixels(at.y), pixels(at.x),
                                               pixels(at.y - kSymbol), pixels(at.y + kSymbol)));
            if (!location.directions.empty()) draw_arrow("mark", at, location.directions.front().value);
            const std::string number = sensor.size() > 1 ? fmt::format(" {}", j + 1) : "";
            add_label("mark-label", sensor.name + number, box_around(std::array{at}));
            has_marks_ = has_marks_ || is_in_frame(at);
        }
    }

    Html finish() {
        drawing_.clipped(id_, path_of_frame(), contents_);
        drawing_.clipped(id_ + "-names", path_of_frame(), texts_);
        draw_metres(drawing_, frame_);
        return drawing_.html();
    }

  private:
    enum class Beside { no, yes };
    /// A name beside or within a thing.
    struct Label {
        std::string_view css_class;
        std::string text;
        plot::PageRectangle thing;
        Beside beside;
    };

    /// Beside a thing, which other labels should not cover.
    void add_label(std::string_view css_class, const std::string& text, const plot::PageRectangle& thing) {
        labels_.push_back({css_class, text, thing, Beside::yes});
        places_.avoid(thing);
    }

    /// At least as large as a symbol.
    static plot::PageRectangle box_around(std::span<const Point> points) {
        const auto [left, right] = std::ranges::minmax_element(points, {}, &Point::x);
        const auto [top, bottom] = std::ranges::minmax_element(points, {}, &Point::y);
        const double x = (left->x + right->x) / 2, y = (top->y + bottom->y) / 2;
        const double half_width = std::max((right->x - left->x) / 2, kSymbol),
                     half_height = std::max((bottom->y - top->y) / 2, kSymbol);
        return {x - half_width, y - half_height, 2 * half_width, 2 * half_height};
    }

    bool is_in_frame(const Point& point) const {
        const plot::PageRectangle box = frame_.rectangle();
        return point.x >= box.left && point.x <= box.right() && point.y >= box.top && point.y <= box.bottom();
    }

    std::string path_of_frame() const {
        const plot::PageRectangle box = frame_.rectangle();
        return fmt::format("M{} {}h{}v{}h{}z", pixels(box.left), pixels(box.top), pixels(box.width),
                           pixels(box.height), pixels(-box.width));
    }

    /// Its outline and its holes, which turn the other way round.
    std::string path_of_room(const sensors::Room& room) const {
        std::string path;
        for (const sensors::Ring& ring : room.floor) {
            std::vector<Point> points;
            for (const sensors::PlanePoint& corner : ring) points.push_back(frame_.at(corner.x, corner.y));
            path += path_of(points, Ends::closed);
        }
        return path;
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
        contents_.path(css_class,
                       path_of(std::array{from, tip}) + path_of(std::array{barb(0.5), tip, barb(-0.5)}));
    }

    /// Its opening to scale, or a symbol.
    void draw_light(const Light& light) {
        std::vector<Point> outline;
        if (const auto object = emitting_object(light)) {
            for (const PlanPoint& corner : outline_from_above(scene_.object(*object).shape))
                outline.push_back(frame_.at(corner.x, corner.y));
            contents_.path("luminaire", path_of(outline, Ends::closed));
        } else {
            outline = {on_plan(point_origin(light)->position)};
        }
        const plot::PageRectangle box = box_around(outline);
        const Point middle = box.center();
        if (std::max(box.width, box.height) <= 2 * kSymbol) contents_.circle("luminaire", middle, kSymbol);
        if (const Luminaire* luminaire = luminaire_of(light)) draw_arrow("aim", middle, luminaire->nadir);
        add_label("luminaire-label", light.name, box);
    }

    const Scene& scene_;
    std::string id_;
    ScaledFrame frame_;
    Drawing drawing_, contents_, texts_{0, 0, ""};
    TextPlaces places_;
    plot::LabelPlacer line_labels_;
    std::vector<Label> labels_;
    int bands_ = 0;
    bool has_marks_ = false, lacks_names_ = false;
};

ScaledFrame frame_around(const Bounds& bounds, double around_m, double most_height) {
    const Vec3 extent = bounds.max - bounds.min;
    return {{bounds.min.x - around_m, bounds.max.x + around_m},
            {bounds.min.y - around_m, bounds.max.y + around_m},
            usual_ratio(extent.x + 2 * around_m, extent.y + 2 * around_m, kMostPlanWidth, most_height),
            {kAxisLeft, kDrawingMargin}};
}

/// What all plans show.
struct PlanContents {
    const Scene& scene;
    std::span<const SensorResult> results;
    std::span<const MeasuredPlane> planes;
    PlanLines lines;
    std::vector<sensors::Room> rooms;
};

Html plan_figure(const PlanContents& contents, const ScaledFrame& frame, std::size_t number,
                 const std::string& title) {
    FloorPlan plan(contents.scene, frame, fmt::format("plan-{}", number));
    plan.draw_bands(contents.planes, contents.rooms);
    plan.draw_lights();
    plan.draw_lines(contents.lines);
    plan.draw_areas(contents.planes);
    for (const SensorResult& result : contents.results) plan.draw_marks(result);
    plan.place_labels();
    if (!contents.planes.empty()) {
        const std::vector<plot::Tick> levels = scale_ticks(common_scale(contents.planes));
        for (const MeasuredPlane& plane : contents.planes) {
            if (plane.is_horizontal() && plane.is_whole()) plan.draw_isolines(plane, levels);
        }
    }
    std::string words = fmt::format("{}Scale 1 : {:g} in print.", title, plan.ratio());
    if (plan.has_marks()) words += " Crosses: single sensors with their directions.";
    if (plan.lacks_names()) words += " Names without a free place are left out.";
    return element("figure", {{"class", "plan"}}, plan.finish() + element("figcaption", words));
}

Html legend(const PlanContents& contents) {
    std::string words = fmt::format("Section at z = {:.4g} m", contents.lines.height_m);
    words += ": walls and high things are cut (bold), lower ones are seen from above. ";
    words += "Luminaires with their luminous openings; arrows: their aim where it is not vertical. ";
    if (!contents.planes.empty())
        words += "Blue: measured areas with isolux lines [lx]; pale: bands around them.";
    return element("p", {{"class", "note"}}, text(words));
}

/// Whether a sensor measures in the room.
bool has_sensors(const sensors::Room& room, const PlanContents& contents) {
    return std::ranges::any_of(contents.results, [&](const SensorResult& result) {
        const Sensor& sensor = result.sensor;
        if (const auto* area = std::get_if<Area>(&sensor.kind)) return room_of({&room, 1}, *area) != nullptr;
        for (std::size_t j = 0; j < sensor.size(); ++j) {
            if (room.contains(position_of(sensor.measurand(j)))) return true;
        }
        return false;
    });
}

}  // namespace

Html floor_plans(const Scene& scene, const rays::RayCaster& caster, std::span<const SensorResult> results,
                 std::span<const MeasuredPlane> planes) {
    constexpr double kShare = 0.02;  // of the extent
    const Bounds bounds = scene::bounds_of(scene);
    if (bounds.is_empty() || bounds.min.x == bounds.max.x || bounds.min.y == bounds.max.y) return {};
    const PlanContents contents{scene, results, planes, plan_lines(scene, caster, usual_plan_height(bounds)),
                                sensors::find_rooms(scene, caster)};
    const Vec3 extent = bounds.max - bounds.min;
    const ScaledFrame whole =
        frame_around(bounds, std::max(kShare * std::max(extent.x, extent.y), 1e-3), kMostPlanHeight);
    Html html = plan_figure(contents, whole, 0, "");
    std::size_t number = 0;
    for (const sensors::Room& room : contents.rooms) {
        const ScaledFrame frame = frame_around(room.extent(), kAroundRoom_m, kMostRoomHeight);
        if (frame.ratio * kLarger > whole.ratio || !has_sensors(room, contents)) continue;
        ++number;
        html += plan_figure(
            contents, frame, number,
            fmt::format("Room of {:.4g} m², floor at z = {:.4g} m. ", room.area_m2(), room.floor_m));
    }
    return html + legend(contents);
}

}  // namespace stilb::report
