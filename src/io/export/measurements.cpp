// Points of sensors and tables of luminaires: text files that Mitsuba's loader and Radiance read alike.

#include <fmt/format.h>

#include <cmath>

#include "io/export/parts.h"

namespace stilb::io::exporting {
namespace {

constexpr int kPlanes = 145, kRings = 181;  // C every 2.5 degrees from 0 to 360, gamma every degree

/// Position, and normal or viewing direction; nothing for a measurand that the others lack.
std::optional<std::string> line_of(const Measurand& measurand) {
    if (const auto* point = std::get_if<MeasuringPoint>(&measurand))
        return text_of(point->position) + " " + text_of(point->normal) + "\n";
    if (const auto* sight = std::get_if<LineOfSight>(&measurand))
        return text_of(sight->position) + " " + text_of(sight->direction) + "\n";
    return std::nullopt;
}

}  // namespace

std::string photometric_table(const std::function<double(const Vec3&)>& of_direction) {
    std::string text = fmt::format("2\n0 360 {}\n0 180 {}\n", kPlanes, kRings);
    for (int plane = 0; plane < kPlanes; ++plane) {
        for (int ring = 0; ring < kRings; ++ring) {
            const double c = 2 * kPi * plane / (kPlanes - 1), gamma = kPi * ring / (kRings - 1);
            const Vec3 direction{std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c),
                                 std::cos(gamma)};
            text += fmt::format("{:.7g}{}", of_direction(direction), ring + 1 < kRings ? ' ' : '\n');
        }
    }
    return text;
}

std::string photometric_table(const PhotometricSolid& solid) {
    return photometric_table([&](const Vec3& direction) { return solid.intensity_cd(direction); });
}

void write_points(const std::vector<Sensor>& sensors, Output& output) {
    Identifiers identifiers;
    for (const Sensor& sensor : sensors) {
        if (sensor.camera()) continue;
        std::string lines;
        for (std::size_t j = 0; j < sensor.size(); ++j) {
            const auto line = line_of(sensor.measurand(j));
            if (!line) break;
            lines += *line;
        }
        if (lines.empty()) {
            output.warn("sensor", sensor.name,
                        fmt::format("{} sensors have no equal and are left out.", sensor.type()));
        } else {
            output.write(identifiers.make(sensor.name) + ".pts", lines);
        }
    }
}

}  // namespace stilb::io::exporting
