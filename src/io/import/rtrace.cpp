#include "io/import/rtrace.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "io/text/radiance_units.h"
#include "io/text/text.h"
#include "io/text/utf8.h"
#include "sensors/fields.h"
#include "stilb/error.h"

namespace stilb::io {

Sensor read_points(std::string_view content, const std::string& name) {
    constexpr double largest_m = 1e9;
    IlluminancePoints points;
    for (TextLines lines(content); lines.next();) {
        const SourceLocation where{name, lines.number()};
        std::string_view rest = lines.line();
        rest = trimmed(rest.substr(0, rest.find('#')));
        if (rest.empty()) continue;
        std::array<double, 6> numbers{};
        std::size_t count = 0;
        for (; !rest.empty(); ++count) {
            const std::string_view word = next_word(rest);
            const auto number = parse_number(word);
            if (!number || std::abs(*number) > largest_m)
                throw InputError(fmt::format("found {}. Allowed: numbers from -1e9 to 1e9.", in_quotes(word)),
                                 where);
            if (count < numbers.size()) numbers[count] = *number;
            rest = trimmed(rest);
        }
        if (count != numbers.size()) {
            throw InputError(
                fmt::format("found {} numbers. Needed: six, the position and the normal, x y z nx ny nz.",
                            count),
                where);
        }
        const Vec3 normal{numbers[3], numbers[4], numbers[5]};
        if (!(length(normal) > 0))
            throw InputError("the normal is 0 0 0. Allowed: any other direction.", where);
        points.points.push_back({{numbers[0], numbers[1], numbers[2]}, normalized(normal)});
        if (points.points.size() > sensors::kMostReadings)
            throw InputError(fmt::format("there are more than {} points.", sensors::kMostReadings), where);
    }
    if (points.points.empty())
        throw InputError("there is no point. Needed: lines of six numbers, x y z nx ny nz.", {name});
    return {std::string(kPointsSensor), std::move(points)};
}

Sensor read_points(const std::filesystem::path& path) {
    return read_points(read_text_file(path), path == "-" ? "standard input" : path.string());
}

void require_irradiances(const std::vector<Sensor>& sensors) {
    for (const Sensor& sensor : sensors) {
        for (std::size_t j = 0; j < sensor.size(); ++j) {
            if (!std::holds_alternative<MeasuringPoint>(sensor.measurand(j)) || sensor.rates_glare()) {
                throw InputError(fmt::format(
                    "the format radiance writes irradiances at points, but sensor {} is of type {}. Choose "
                    "sensors of illuminance.",
                    in_quotes(sensor.name), sensor.type()));
            }
        }
    }
}

std::string to_irradiance_lines(const RunResult& result) {
    std::string text;
    for (const run::SensorResult& sensor : result.sensors) {
        if (sensor.sensor.derived()) continue;
        for (const run::Reading& reading : sensor.readings) {
            const Rgb irradiance = radiometric(reading.rgb);
            text += fmt::format("{:e}\t{:e}\t{:e}\t\n", irradiance[0], irradiance[1], irradiance[2]);
        }
    }
    return text;
}

}  // namespace stilb::io
