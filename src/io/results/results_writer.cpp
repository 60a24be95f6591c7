
#include "io/results/results_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/parallel.h"
#include "base/version.h"
#include "estimators/estimator_list.h"
#include "io/text/table.h"
#include "sensors/areas/measured_raster.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

using Json = nlohmann::ordered_json;

/// Of the document, which a reader of results needs to know: higher where keys change their meaning.
constexpr int kFormat = 1;

/// The surface point whose luminance reading `j` of a sensor is: the end of the line of sight, or the
/// point of a goniometer. Nothing where the line of sight leaves the scene, or the run did not record it.
std::optional<Vec3> sub_point(const SensorResult& result, const Sensor& sensor, std::size_t j) {
    const Measurand measurand = sensor.measurand(j);
    if (const auto* ray = std::get_if<EmergentRay>(&measurand)) return ray->position;
    return result.sub_points.empty() ? std::nullopt : result.sub_points[j];
}

Json interval_json(const statistics::Estimate& e) { return {e.lower, e.upper}; }

/// Uniformity and diversity are defined for an illuminated area; luminances in several directions have none.
Json summary_json(const statistics::GridSummary& summary, const Sensor& sensor) {
    Json values, intervals;
    for (std::size_t i = 0; i < kStatisticNames.size(); ++i) {
        const auto statistic = static_cast<Statistic>(i);
        if (is_ratio(statistic) && !sensor.has_ratios()) continue;
        const std::string name(name_of(statistic));
        values[name] = summary[statistic].value;
        intervals[name + "_interval"] = interval_json(summary[statistic]);
    }
    values.update(intervals);
    return values;
}

Json requirement_json(const RatedRequirement& rated, const statistics::GridSummary& summary) {
    const sensors::Criterion& criterion = *rated.requirement.criterion;
    const statistics::Estimate& estimate = summary[criterion.statistic];
    Json json{{"key", criterion.key},
              {criterion.limit == sensors::Limit::at_least ? "at_least" : "at_most", rated.requirement.limit},
              {"value", estimate.value},
              {"interval", interval_json(estimate)},
              {"verdict", run::name_of(rated.verdict)}};
    if (!rated.reason.empty()) json["reason"] = rated.reason;
    return json;
}

/// What an eye sees of lamps, and why a rating leaves some of them out.
Json glare_json(const run::GlareView& view) {
    Json json;
    if (view.background_cd_m2) json["background_cd_m2"] = *view.background_cd_m2;
    if (view.threshold_cd_m2) json["threshold_cd_m2"] = *view.threshold_cd_m2;
    json["sources"] = Json::array();
    for (const run::GlareSource& source : view.sources) {
        Json& own = json["sources"].emplace_back(Json{{"light", source.light},
                                                      {"luminance_cd_m2", source.luminance_cd_m2},
                                                      {"solid_angle_sr", source.solid_angle_sr},
                                                      {"position_index", source.position_index},
                                                      {"counted", is_counted(source.standing)}});
        if (const auto remark = text_of(source.standing); !remark.empty()) own["remark"] = remark;
    }
    return json;
}

Json vector_json(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

/// The parallelogram of cells in whose middles an area is measured.
Json raster_json(const Grid& raster) {
    return {{"corner", vector_json(raster.corner)},
            {"edge_u", vector_json(raster.edge_u)},
            {"edge_v", vector_json(raster.edge_v)},
            {"count", raster.count}};
}

Json sensor_json(const SensorResult& result, const Sensor& sensor) {
    const Quantity quantity = sensor.quantity();
    Json json{
        {"name", sensor.name}, {"type", sensor.type()}, {"quantity", quantity.name}, {"unit", quantity.unit}};
    if (const auto count = sensor.count()) json["count"] = *count;
    if (const auto* grid = std::get_if<Grid>(&sensor.kind)) json.update(raster_json(*grid));
    json["attained_error"] = result.attained_error;
    if (result.patch_error) json["patch_error"] = *result.patch_error;
    if (const auto* area = std::get_if<Area>(&sensor.kind)) {
        if (const Grid* raster = sensors::raster_of(sensor)) json["raster"] = raster_json(*raster);
        json["spacing_m"] = area->cell_m;
        json["left_out"] = area->left_out;
    }
    if (sensor.derived()) json["formula"] = sensor.derived()->formula.text();
    json["values"] = nullptr;  // with_readings() fills them in
    if (!sensor.derived()) json["summary"] = summary_json(result.summary, sensor);
    for (const RatedRequirement& rated : result.requirements)
        json["requirements"].push_back(requirement_json(rated, result.summary));
    for (const run::GlareView& view : result.glare) json["glare"].push_back(glare_json(view));
    for (const run::Share& share : result.shares)
        json["shares"].push_back(
            {{"name", share.name}, {"values", nullptr}, {"summary", summary_json(share.summary, sensor)}});
    return json;
}

Json sensors_json(const RunResult& result) {
    Json list = Json::array();
    for (const SensorResult& sensor : result.sensors) list.push_back(sensor_json(sensor, sensor.sensor));
    return list;
}

Json room_power_json(const run::RoomPower& room) {
    return {{"extent", {vector_json(room.extent.min), vector_json(room.extent.max)}},
            {"floor_m2", room.floor_m2},
            {"installed_w", room.power_w},
            {"w_m2", room.w_m2()},
            {"lamps_of_unknown_power", room.unknown}};
}

Json power_json(const RunResult& result) {
    const scene::InstalledPower& power = result.power;
    Json json{{"installed_w", power.power_w ? Json(*power.power_w) : Json()}, {"unknown", power.unknown}};
    for (const run::RoomPower& room : result.rooms) json["rooms"].push_back(room_power_json(room));
    const std::optional<run::PowerDensity>& density = result.power_density;
    if (!density) return json;
    json["task_area_m2"] = density->area_m2;
    json["w_m2"] = density->w_m2;
    json["w_m2_per_100_lx"] = density->w_m2_per_100_lx.value;
    json["w_m2_per_100_lx_interval"] = interval_json(density->w_m2_per_100_lx);
    return json;
}

/// A state of the lamps.
Json light_scene_json(const RunResult& lit) {
    Json json = Json::object();
    if (const auto verdict = run::verdict_of(lit)) json["verdict"] = run::name_of(*verdict);
    if (lit.power.has_lamps()) json["power"] = power_json(lit);
    json["sensors"] = sensors_json(lit);
    return json;
}

Json light_json(const estimators::FirstShotLight& light) {
    return {{"name", light.name},
            {"replaced", light.is_replaced},
            {"samples", light.samples},
            {"reason", light.why}};
}

Json patches_json(const estimators::PatchReport& report) {
    Json lights = Json::array();
    for (const estimators::FirstShotLight& light : report.lights) lights.push_back(light_json(light));
    return {{"count", report.count},
            {"size_m", report.size_m},
            {"first_shot",
             {{"variant", name_of(report.first_shot)},
              {"resolution", report.resolution ? Json(*report.resolution) : Json()},
              {"missed", report.missed},
              {"bytes_per_patch", report.bytes_per_patch},
              {"lights", std::move(lights)}}}};
}

/// Appends an object of numbers to a text, member by member: as trees, half a million readings would take a
/// second.
class ObjectText {
  public:
    explicit ObjectText(std::string& text) : text_(text) { text_ += '{'; }
    ObjectText(const ObjectText&) = delete;
    ObjectText& operator=(const ObjectText&) = delete;
    ~ObjectText() { text_ += '}'; }

    void add(std::string_view name, double value) {
        append_name(name);
        append(value);
    }
    void add(std::string_view name, std::span<const double> values) {
        append_name(name);
        char before = '[';
        for (const double value : values) {
            text_ += before;
            append(value);
            before = ',';
        }
        text_ += ']';
    }
    void add(std::string_view name, const Vec3& v) { add(name, std::array{v.x, v.y, v.z}); }
    void add_null(std::string_view name) {
        append_name(name);
        text_ += "null";
    }

  private:
    void append_name(std::string_view name) {
        text_.append(is_empty_ ? "\"" : ",\"").append(name).append("\":");
        is_empty_ = false;
    }
    /// As the library writes numbers: as many digits as tell them apart, and never like an integer; null
    /// where it is no number.
    void append(double value) {
        if (!std::isfinite(value)) {
            text_ += "null";
            return;
        }
        std::array<char, 32> digits{};
        const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
        const std::string_view number(digits.data(), end);
        text_ += number;
        if (number.find_first_of(".e") == std::string_view::npos) text_ += ".0";
    }

    std::string& text_;
    bool is_empty_ = true;
};

void add_location(const SensorResult& result, std::size_t j, ObjectText& object) {
    const Sensor& sensor = result.sensor;
    const Location location = sensor.location(j);
    object.add("position", location.position);
    for (const Location::Direction& direction : location.directions)
        object.add(direction.name, direction.value);
    if (sensor.measures_luminance()) {
        if (const auto hit = sub_point(result, sensor, j)) {
            object.add("hit", *hit);
        } else {
            object.add_null("hit");
        }
    }
    for (const Location::Angle& angle : location.angles) object.add(angle.name, angle.value_deg);
}

/// `means`: replicates x `readings`.
void add_replicates(std::span<const double> means, std::size_t readings, std::size_t j, ObjectText& object) {
    std::vector<double> values;
    for (std::size_t i = j; i < means.size(); i += readings) values.push_back(means[i]);
    object.add("replicates", values);
}

/// The readings of a sensor, or of one of its shares.
struct ListedReadings {
    const SensorResult& sensor;
    const run::Share* share = nullptr;
};

/// In the order of the document.
std::vector<ListedReadings> listed_readings(const RunResult& result) {
    std::vector<ListedReadings> all;
    for (const SensorResult& sensor : result.sensors) {
        all.push_back({sensor});
        for (const run::Share& share : sensor.shares) all.push_back({sensor, &share});
    }
    for (const RunResult& lit : result.light_scenes)
        std::ranges::move(listed_readings(lit), std::back_inserter(all));
    return all;
}

void append_reading(const ListedReadings& listed, std::size_t j, ReplicateValues replicates,
                    std::string& text) {
    const auto& [result, share] = listed;
    ObjectText object(text);
    if (!result.sensor.derived() && !share) add_location(result, j, object);
    const statistics::Estimate& estimate = share ? share->readings[j] : result.readings[j].estimate;
    object.add("value", estimate.value);
    object.add("standard_error", estimate.standard_error);
    object.add("interval", std::array{estimate.lower, estimate.upper});
    if (const Reading& reading = result.readings[j]; !share) {
        if (reading.patch_error) object.add("patch_error", *reading.patch_error);
        if (!result.sensor.derived()) object.add("rgb", reading.rgb.band);
    }
    if (replicates == ReplicateValues::written)
        add_replicates(share ? share->replicate_means : result.replicate_means, result.readings.size(), j,
                       object);
}

/// Appends the readings of a sensor as JSON, in their order, a line for each; in parts, which are made in
/// parallel.
void append_readings(const ListedReadings& listed, ReplicateValues replicates,
                     std::vector<std::string>& parts) {
    constexpr std::size_t kPart = 1024;
    const std::size_t count = listed.sensor.readings.size(), before = parts.size();
    parts.resize(before + (count + kPart - 1) / kPart);
    parallel_for(parts.size() - before, [&](std::size_t p) {
        std::string& part = parts[before + p];
        for (std::size_t j = p * kPart; j < std::min(count, (p + 1) * kPart); ++j) {
            part += j > 0 ? ",\n    " : "\n    ";
            append_reading(listed, j, replicates, part);
        }
    });
}

/// `document` with an array of the readings in place of each `"values": null`.
std::vector<std::string> with_readings(std::string_view document, std::span<const ListedReadings> all,
                                       ReplicateValues replicates) {
    constexpr std::string_view kKey = "\"values\": ", kNull = "null";
    std::vector<std::string> parts;
    for (const ListedReadings& listed : all) {
        // It occurs for each of these only, because quotation marks within texts are escaped.
        const std::size_t end = document.find(kKey) + kKey.size();
        parts.push_back(fmt::format("{}[", document.substr(0, end)));
        append_readings(listed, replicates, parts);
        parts.emplace_back("\n   ]");
        document.remove_prefix(end + kNull.size());
    }
    parts.emplace_back(document);
    return parts;
}

}  // namespace

std::vector<std::string> json_parts(const RunResult& result, const std::string& scene,
                                    ReplicateValues replicates) {
    const estimators::EstimatorEntry& technique = estimators::find_estimator(result.technique);
    Json json{{"stilb", program_version()},
              {"format", kFormat},
              {"scene", scene},
              {"scene_name", result.scene_name},
              {"scene_hash", result.scene_hash.empty() ? Json() : Json(result.scene_hash)},
              {"sensors_hash", result.sensors_hash.empty() ? Json() : Json(result.sensors_hash)},
              {"method", result.method},
              {"technique", result.technique},
              {"sample", technique.sample},
              {"seed", result.seed},
              {"elapsed_s", result.elapsed_s},
              {"paths", result.samples},
              {"replicates", result.replicates},
              {"rays", result.rays},
              {"converged", result.converged},
              {"stopped", run::name_of(result.stop_reason)},
              {"attained_error", result.attained_error}};
    if (!result.seeds.empty()) json["seeds"] = result.seeds;
    if (const auto verdict = run::verdict_of(result)) json["verdict"] = run::name_of(*verdict);
    json["warnings"] = texts_of(result.warnings);
    json["warning_kinds"] = kind_names_of(result.warnings);
    if (result.maintenance) json["maintenance"] = *result.maintenance;
    if (result.power.has_lamps()) json["power"] = power_json(result);
    if (result.patches) {
        json["first_shot_set_up_s"] = result.patches->set_up_s;
        json["patches"] = patches_json(*result.patches);
    }
    for (const run::LevelOfDetail& level : result.levels_of_detail) {
        json["levels_of_detail"].push_back({{"object", level.object},
                                            {"degree", level.degree},
                                            {"full_degree", level.full_degree},
                                            {"error_m", level.error_m},
                                            {"allowed_m", level.allowed_m}});
    }
    json["sensors"] = sensors_json(result);
    for (const RunResult& lit : result.light_scenes) json["scenes"][lit.scene_name] = light_scene_json(lit);
    return with_readings(json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n",
                         listed_readings(result), replicates);
}

std::string to_json(const RunResult& result, const std::string& scene) {
    return fmt::format("{}", fmt::join(json_parts(result, scene, ReplicateValues::left_out), ""));
}

namespace {

/// Columns of a sensor's readings, made from the location of each.
class ReadingColumns {
  public:
    explicit ReadingColumns(std::size_t readings) : readings_(readings) {}

    void add(std::string name, const auto& number_of) {
        std::vector<double> cells;
        for (std::size_t j = 0; j < readings_; ++j) cells.push_back(number_of(j));
        columns_.push_back({std::move(name), std::move(cells)});
    }
    void add_vector(const std::array<std::string, 3>& names, const auto& vector_of) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            add(names[axis], [&](std::size_t j) { return vector_of(j)[axis]; });
    }
    const std::vector<Column>& columns() const { return columns_; }

  private:
    std::size_t readings_;
    std::vector<Column> columns_;
};

/// All readings of a sensor have the same directions and angles.
void add_locations(ReadingColumns& columns, const Sensor& sensor) {
    std::vector<Location> locations;
    for (std::size_t j = 0; j < sensor.size(); ++j) locations.push_back(sensor.location(j));
    columns.add_vector({"x_m", "y_m", "z_m"}, [&](std::size_t j) { return locations[j].position; });
    if (locations.empty()) return;
    for (std::size_t d = 0; d < locations.front().directions.size(); ++d) {
        const std::string name(locations.front().directions[d].name);
        columns.add_vector({name + "_x", name + "_y", name + "_z"},
                           [&](std::size_t j) { return locations[j].directions[d].value; });
    }
    for (std::size_t a = 0; a < locations.front().angles.size(); ++a) {
        columns.add(std::string(locations.front().angles[a].name) + "_deg",
                    [&](std::size_t j) { return locations[j].angles[a].value_deg; });
    }
}

/// The unit and names of several words as parts of a column's name, such as "cd_m2".
std::string in_column(std::string_view text) {
    std::string name(text);
    for (char& c : name) {
        if (c == '/' || c == ' ') c = '_';
    }
    return name;
}

void add_readings(ReadingColumns& columns, const SensorResult& result, const Sensor& sensor) {
    const std::vector<Reading>& readings = result.readings;
    const Quantity quantity = sensor.quantity();
    const std::string unit = quantity.unit.empty() ? "" : fmt::format("_{}", in_column(quantity.unit));
    const auto estimate = [&](std::size_t j) -> const statistics::Estimate& { return readings[j].estimate; };
    columns.add(in_column(quantity.name) + unit, [&](std::size_t j) { return estimate(j).value; });
    columns.add("standard_error" + unit, [&](std::size_t j) { return estimate(j).standard_error; });
    columns.add("interval_low" + unit, [&](std::size_t j) { return estimate(j).lower; });
    columns.add("interval_high" + unit, [&](std::size_t j) { return estimate(j).upper; });
    if (sensor.derived()) return;
    for (const run::Share& share : result.shares) {
        const std::string of = "_of_" + in_column(share.name);
        columns.add(in_column(quantity.name) + unit + of,
                    [&](std::size_t j) { return share.readings[j].value; });
        columns.add("standard_error" + unit + of,
                    [&](std::size_t j) { return share.readings[j].standard_error; });
    }
    constexpr std::array<const char*, kBands> bands{"red", "green", "blue"};
    for (std::size_t b = 0; b < kBands; ++b)
        columns.add(bands[b] + unit, [&](std::size_t j) { return readings[j].rgb[b]; });
}

void write_sensor(const SensorResult& result, const Sensor& sensor, const std::filesystem::path& path) {
    ReadingColumns columns(result.readings.size());
    if (!sensor.derived()) add_locations(columns, sensor);
    if (sensor.measures_luminance()) {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        columns.add_vector({"hit_x_m", "hit_y_m", "hit_z_m"}, [&](std::size_t j) {
            return sub_point(result, sensor, j).value_or(Vec3{none, none, none});
        });
    }
    add_readings(columns, result, sensor);
    write_csv(columns.columns(), path);
}

void create_folder(const std::filesystem::path& directory) {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error)
        throw InputError(fmt::format("the folder cannot be created: {}", error.message()),
                         {directory.string()});
}

std::filesystem::path csv_path(const std::filesystem::path& directory, const Sensor& sensor) {
    return directory / (sensor.name + ".csv");
}

}  // namespace

void prepare_results_csv(std::span<const Sensor> sensors, const std::filesystem::path& directory) {
    create_folder(directory);
    for (const Sensor& sensor : sensors) require_writable(csv_path(directory, sensor));
}

void write_results_csv(const RunResult& result, const std::filesystem::path& directory) {
    create_folder(directory);
    for (const SensorResult& sensor : result.sensors)
        write_sensor(sensor, sensor.sensor, csv_path(directory, sensor.sensor));
    for (const RunResult& lit : result.light_scenes) write_results_csv(lit, directory / lit.scene_name);
}

}  // namespace stilb::io
