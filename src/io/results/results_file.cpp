#include "io/results/results_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/vec.h"
#include "io/text/text.h"
#include "io/text/utf8.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

using Json = nlohmann::ordered_json;

/// A raster of more cells is a mistake.
constexpr std::int64_t kMostCells = 10'000'000;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A JSON value and its path ("sensors[2].count"), which every message states.
class Node {
  public:
    Node(const Json& json, std::string path, const std::string& file)
        : json_(json), path_(std::move(path)), file_(file) {}

    [[noreturn]] void fail(const std::string& expected) const {
        throw InputError(
            fmt::format("{} is {}, but should be {}. The file must hold measured results as JSON.",
                        path_.empty() ? "the document" : "'" + path_ + "'", json_.type_name(), expected),
            {file_});
    }

    bool has(const std::string& key) const { return json_.is_object() && json_.contains(key); }

    Node member(const std::string& key) const {
        if (!json_.is_object()) fail("an object");
        const std::string path = path_.empty() ? key : path_ + "." + key;
        const auto found = json_.find(key);
        if (found == json_.end()) {
            throw InputError(
                fmt::format("'{}' is missing. The file must hold measured results as JSON.", path), {file_});
        }
        return {*found, path, file_};
    }

    std::size_t size() const {
        if (!json_.is_array()) fail("an array");
        return json_.size();
    }
    Node element(std::size_t index) const {
        if (!json_.is_array() || index >= json_.size())
            fail(fmt::format("an array of {} or more", index + 1));
        return {json_[index], fmt::format("{}[{}]", path_, index), file_};
    }

    std::string text() const {
        if (!json_.is_string()) fail("a string");
        return json_.get<std::string>();
    }
    double number() const {
        if (!json_.is_number()) fail("a number");
        return json_.get<double>();
    }
    double number_or_none() const { return json_.is_null() ? kNone : number(); }
    int positive_count() const {
        if (!json_.is_number_integer()) fail("a whole number");
        const auto count = json_.get<std::int64_t>();
        if (count < 1 || count > std::numeric_limits<int>::max()) fail("a count of 1 or more");
        return static_cast<int>(count);
    }
    Vec3 point() const { return {element(0).number(), element(1).number(), element(2).number()}; }

  private:
    const Json& json_;
    std::string path_;
    const std::string& file_;
};

/// Length of `count` cells whose centres' first and last lie `span_m` apart; a single cell's is `cell_m`.
double extent_of(double span_m, int count, double cell_m) {
    return count > 1 ? span_m * count / (count - 1) : cell_m;
}

void read_size(const Node& values, MeasuredGrid& grid) {
    const int nu = grid.count[0], nv = grid.count[1];
    const Vec3 first = values.element(0).member("position").point();
    const auto at = [&](int u, int v) {
        return values
            .element(static_cast<std::size_t>(v) * static_cast<std::size_t>(nu) + static_cast<std::size_t>(u))
            .member("position")
            .point();
    };
    const double span_u = length(at(nu - 1, 0) - first);
    const double span_v = length(at(0, nv - 1) - first);
    // A row of single cells is treated as a row of squares.
    grid.width_m = extent_of(span_u, nu, nv > 1 ? span_v / (nv - 1) : 0);
    grid.height_m = extent_of(span_v, nv, nu > 1 ? span_u / (nu - 1) : 0);
}

/// The member `name` of an object, with its interval where the object has one.
MeasuredValue read_value(const Node& object, const std::string& name, const std::string& interval) {
    const double value = object.member(name).number_or_none();
    if (!object.has(interval)) return {value, kNone};
    const Node ends = object.member(interval);
    return {value, (ends.element(1).number_or_none() - ends.element(0).number_or_none()) / 2};
}

std::array<int, 2> read_count(const Node& owner) {
    const Node count = owner.member("count");
    return {count.element(0).positive_count(), count.element(1).positive_count()};
}

void read_values_of_grid(const Node& sensor, MeasuredGrid& grid) {
    grid.count = read_count(sensor);
    const Node values = sensor.member("values");
    const auto [nu, nv] = grid.count;
    if (values.size() != static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv)) {
        values.fail(fmt::format("of {} x {} values", nu, nv));
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        grid.values.push_back(read_value(values.element(i), "value", "interval"));
    }
    read_size(values, grid);
}

/// Readings lie in some of the raster's cells.
void read_values_of_area(const Node& sensor, MeasuredGrid& grid) {
    const Node raster = sensor.member("raster"), values = sensor.member("values");
    const Vec3 corner = raster.member("corner").point();
    const std::array edges{raster.member("edge_u").point(), raster.member("edge_v").point()};
    grid.count = read_count(raster);
    grid.width_m = length(edges[0]);
    grid.height_m = length(edges[1]);
    const auto [nu, nv] = grid.count;
    if (static_cast<std::int64_t>(nu) * nv > kMostCells) raster.fail("of fewer cells");
    grid.values.assign(static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv), {kNone, kNone});
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Node value = values.element(i);
        const Vec3 from_corner = value.member("position").point() - corner;
        std::array<std::size_t, 2> cell{};
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const double place =
                dot(from_corner, edges[axis]) / squared_length(edges[axis]) * grid.count[axis];
            if (!(place >= 0 && place < grid.count[axis])) value.member("position").fail("in the raster");
            cell[axis] = static_cast<std::size_t>(place);
        }
        grid.values[cell[1] * static_cast<std::size_t>(nu) + cell[0]] =
            read_value(value, "value", "interval");
    }
}

MeasuredGrid read_grid(const Node& sensor) {
    MeasuredGrid grid;
    grid.name = sensor.member("name").text();
    grid.quantity = sensor.member("quantity").text();
    grid.unit = sensor.member("unit").text();
    if (sensor.has("raster"))
        read_values_of_area(sensor, grid);
    else
        read_values_of_grid(sensor, grid);
    const Node summary = sensor.member("summary");
    const auto statistic = [&](const std::string& name) {
        return read_value(summary, name, name + "_interval");
    };
    grid.summary = {statistic("mean"), statistic("minimum"), statistic("maximum"), statistic("uniformity")};
    return grid;
}

Json parse_json(std::string_view content, const std::string& name) {
    try {
        return Json::parse(content);
    } catch (const Json::parse_error& error) {
        const std::size_t end = std::min(error.byte, content.size());
        const auto line =
            1 + std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(end), '\n');
        throw InputError("not JSON. The file must hold measured results as JSON.",
                         {name, static_cast<std::size_t>(line)});
    } catch (const Json::out_of_range& error) {
        throw InputError("a number is too large for a double. The file must hold measured results as JSON.",
                         {name});
    }
}

}  // namespace

ResultsFile read_results(std::string_view content, const std::string& name) {
    const Json json = parse_json(content, name);
    const Node root(json, "", name);
    if (!root.has("stilb")) {
        throw InputError(
            "JSON, but not measured results: there is no 'stilb'. The file must be one that Stilb wrote.",
            {name});
    }
    ResultsFile results{root.member("scene").text(), "", {}};
    if (root.has("scene_name")) results.scene_name = root.member("scene_name").text();
    const Node sensors = root.member("sensors");
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const Node sensor = sensors.element(i);
        if (sensor.member("type").text() == "grid" || sensor.has("raster"))
            results.grids.push_back(read_grid(sensor));
    }
    return results;
}

ResultsFile read_results_file(const std::filesystem::path& path) {
    return read_results(read_text_file(path), path.string());
}

}  // namespace stilb::io
