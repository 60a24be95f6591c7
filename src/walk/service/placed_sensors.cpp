#include "walk/service/placed_sensors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <variant>

#include "io/text/table.h"
#include "stilb/error.h"
#include "walk/service/requests.h"

namespace stilb::walk {
namespace {

constexpr std::size_t kMostSensors = 200, kLongestName = 100;
constexpr int kMostFiles = 1000;

/// The rule of scene files (io/scene/scene_file.cpp): names become parts of the names of other files.
bool is_control_or_slash(unsigned char c) { return c < ' ' || c == 0x7f || c == '/' || c == '\\'; }

std::string name_in(const nlohmann::json& placed) {
    std::string name(text_of(placed, "name"));
    if (name.empty() || name.size() > kLongestName || std::ranges::any_of(name, is_control_or_slash)) {
        throw InputError(
            fmt::format("\"name\" must be a text of 1 to {} bytes without / and \\ and control characters.",
                        kLongestName));
    }
    return name;
}

bool is_taken(const std::string& name, const std::vector<Sensor>& sensors) {
    return std::ranges::find(sensors, name, &Sensor::name) != sensors.end();
}

Sensor read_placed(const nlohmann::json& placed) {
    if (!placed.is_object()) throw InputError("Each sensor must be a JSON object.");
    const std::string_view type = text_of(placed, "type");
    const bool is_luminance = type == sensors::Luminance::kType;
    if (!is_luminance && type != sensors::IlluminancePoints::kType)
        throw InputError("\"type\" of a sensor must be \"illuminance\" or \"luminance\".");
    const std::string_view direction = is_luminance ? "direction" : "normal";
    require_members(placed, std::array<std::string_view, 4>{"name", "type", "position", direction},
                    "The sensor");
    const Vec3 position = position_of(placed, "position"), unit = direction_of(placed, direction);
    if (is_luminance) return {name_in(placed), sensors::Luminance{{LineOfSight{position, unit}}}};
    return {name_in(placed), sensors::IlluminancePoints{{MeasuringPoint{position, unit}}}};
}

/// A number with six digits behind the point at most.
std::string number_text(double number) {
    std::string text = fmt::format("{:.6f}", number);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text += '0';
    return text == "-0.0" ? "0.0" : text;
}

std::string vector_text(const Vec3& v) {
    return fmt::format("[{}, {}, {}]", number_text(v.x), number_text(v.y), number_text(v.z));
}

/// The name as a key: in quotes unless TOML allows it without.
std::string key_text(const std::string& name) {
    const auto is_bare = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    };
    if (std::ranges::all_of(name, is_bare)) return name;
    std::string quoted = "\"";
    for (const char c : name) quoted += c == '"' ? std::string("\\\"") : std::string(1, c);
    return quoted + '"';
}

/// The path beside the scene; `number` counts from 1.
std::filesystem::path path_beside(const std::filesystem::path& scene, int number) {
    std::filesystem::path name = scene.stem();
    name += number == 1 ? std::string("-sensors.toml") : fmt::format("-sensors-{}.toml", number);
    return scene.parent_path() / name;
}

}  // namespace

std::vector<Sensor> read_placed_sensors(std::string_view json, const std::vector<Sensor>& present) {
    const nlohmann::json request = parse_request(json);
    require_members(request, std::array<std::string_view, 1>{"sensors"}, "The request");
    const auto list = request.find("sensors");
    if (list == request.end() || !list->is_array() || list->empty() || list->size() > kMostSensors)
        throw InputError(fmt::format("\"sensors\" must be a list of 1 to {} sensors.", kMostSensors));
    std::vector<Sensor> sensors;
    for (const nlohmann::json& placed : *list) {
        Sensor sensor = read_placed(placed);
        const std::string wanted = sensor.name;
        for (int number = 2; is_taken(sensor.name, sensors) || is_taken(sensor.name, present); ++number)
            sensor.name = fmt::format("{}_{}", wanted, number);
        sensors.push_back(std::move(sensor));
    }
    return sensors;
}

std::string to_toml(const std::vector<Sensor>& sensors) {
    std::string text;
    for (const Sensor& sensor : sensors) {
        const Location location = sensor.location(0);
        const Location::Direction& direction = location.directions.front();
        text += fmt::format("{}[sensors.{}]\ntype = \"{}\"\nposition = {}\n{} = {}\n",
                            text.empty() ? "" : "\n", key_text(sensor.name), sensor.type(),
                            vector_text(location.position), direction.name, vector_text(direction.value));
    }
    return text;
}

std::optional<std::filesystem::path> save_beside(const std::filesystem::path& scene, std::string_view text) {
    if (io::is_standard_output(scene)) return std::nullopt;
    for (int number = 1; number <= kMostFiles; ++number) {
        const std::filesystem::path path = path_beside(scene, number);
        // "x": only if there is no such file, in one step.
        const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wx"),
                                                                   std::fclose);
        if (!file && errno == EEXIST) continue;
        if (!file) return std::nullopt;
        const bool is_written = std::fwrite(text.data(), 1, text.size(), file.get()) == text.size() &&
                                std::fflush(file.get()) == 0;
        if (is_written) return path;
        std::error_code error;
        std::filesystem::remove(path, error);
        return std::nullopt;
    }
    return std::nullopt;
}

std::string keep_placed_sensors(std::string_view json, const std::vector<Sensor>& present,
                                const std::filesystem::path& scene) {
    const std::string toml = to_toml(read_placed_sensors(json, present));
    const std::string comment =
        fmt::format("# Sensors that were placed in a walk through {}: paste them into that file.\n\n",
                    scene.filename().string());
    const auto saved = save_beside(scene, comment + toml);
    if (!saved) throw InputError("No file can be written beside the scene. Copy the text instead.");
    return nlohmann::ordered_json{{"toml", toml}, {"saved", saved->filename().string()}}.dump(
        -1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace stilb::walk
