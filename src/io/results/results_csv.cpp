#include "io/results/results_csv.h"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "io/results/sub_point.h"
#include "io/text/table.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

/// Columns of a sensor's readings, made of what is told of each.
class ReadingColumns {
  public:
    explicit ReadingColumns(std::size_t readings) : readings_(readings) {}

    void add(std::string name, const auto& number_of) {
        std::vector<double> cells;
        for (std::size_t j = 0; j < readings_; ++j) cells.push_back(number_of(j));
        columns_.push_back({std::move(name), std::move(cells)});
    }
    void add_vector(const std::array<const char*, 3>& names, const auto& vector_of) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            add(names[axis], [&](std::size_t j) { return vector_of(j)[axis]; });
    }
    const std::vector<Column>& columns() const { return columns_; }

  private:
    std::size_t readings_;
    std::vector<Column> columns_;
};

constexpr std::array kNormal{"normal_x", "normal_y", "normal_z"};
constexpr std::array kDirection{"direction_x", "direction_y", "direction_z"};

template <typename Kind, typename Part>
auto part_of(const Sensor& sensor, Part Kind::*part) {
    return [&sensor, part](std::size_t j) { return std::get<Kind>(sensor.measurands[j]).*part; };
}

void add_places(ReadingColumns& columns, const Sensor& sensor) {
    columns.add_vector({"x_m", "y_m", "z_m"},
                       [&](std::size_t j) { return position_of(sensor.measurands[j]); });
    if (sensor.type == SensorType::luminance) {
        columns.add_vector(kDirection, part_of(sensor, &LineOfSight::direction));
    } else if (sensor.type == SensorType::goniometer) {
        columns.add_vector(kNormal, part_of(sensor, &EmergentRay::normal));
        columns.add_vector(kDirection, part_of(sensor, &EmergentRay::direction));
        columns.add("theta_deg", [&](std::size_t j) { return sensor.angles[j].theta_deg; });
        columns.add("phi_deg", [&](std::size_t j) { return sensor.angles[j].phi_deg; });
    } else {
        columns.add_vector(kNormal, part_of(sensor, &MeasuringPoint::normal));
    }
}

void add_readings(ReadingColumns& columns, const std::vector<Reading>& readings, const Quantity& quantity) {
    const std::string unit = quantity.unit == "lx" ? "_lx" : "_cd_m2";
    const auto estimate = [&](std::size_t j) -> const statistics::Estimate& { return readings[j].estimate; };
    columns.add(std::string(quantity.name) + unit, [&](std::size_t j) { return estimate(j).value; });
    columns.add("standard_error" + unit, [&](std::size_t j) { return estimate(j).standard_error; });
    columns.add("interval_low" + unit, [&](std::size_t j) { return estimate(j).lower; });
    columns.add("interval_high" + unit, [&](std::size_t j) { return estimate(j).upper; });
    constexpr std::array<const char*, kBands> bands{"red", "green", "blue"};
    for (std::size_t b = 0; b < kBands; ++b)
        columns.add(bands[b] + unit, [&](std::size_t j) { return readings[j].rgb[b]; });
}

void write_sensor(const SensorResult& result, const Sensor& sensor, const std::filesystem::path& path) {
    ReadingColumns columns(result.readings.size());
    add_places(columns, sensor);
    if (sensor.measures_luminance()) {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        columns.add_vector({"hit_x_m", "hit_y_m", "hit_z_m"}, [&](std::size_t j) {
            return sub_point(result, sensor, j).value_or(Vec3{none, none, none});
        });
    }
    add_readings(columns, result.readings, sensor.quantity());
    write_csv(columns.columns(), path);
}

}  // namespace

void write_results_csv(const RunResult& result, const std::filesystem::path& directory) {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error)
        throw InputError(fmt::format("the folder cannot be made: {}", error.message()), {directory.string()});
    for (const SensorResult& sensor : result.sensors) {
        write_sensor(sensor, sensor.sensor, directory / (sensor.sensor.name + ".csv"));
    }
}

}  // namespace stilb::io
