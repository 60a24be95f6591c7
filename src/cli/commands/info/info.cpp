// stilb info: the contents of a scene, a luminaire, a mesh or a state file, with warnings.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands/info/info_report.h"
#include "cli/commands/info/state_report.h"
#include "cli/commands/info/ugr_report.h"
#include "cli/progress.h"
#include "cli/scene_argument.h"
#include "io/import/obj/obj_scene.h"
#include "io/import/textures/textured_surfaces.h"
#include "io/results/results_text.h"
#include "io/text/file_kind.h"
#include "io/text/text.h"
#include "run/readings/campaign.h"
#include "stilb/error.h"

namespace stilb::cli {

namespace {

struct InfoRequest {
    std::string file;
    std::vector<std::string> overrides;
    bool json = false, has_ugr = false;
};

InfoReport report_file(const InfoRequest& request, const Monitor& monitor) {
    const std::string& file = request.file;
    const io::FileKind kind = io::kind_of_file(file);
    if (kind == io::FileKind::ies_luminaire || kind == io::FileKind::eulumdat_luminaire)
        return report_luminaire(file, request.has_ugr ? UgrTables::written : UgrTables::left_out);
    if (request.has_ugr)
        throw InputError("is no luminaire file. Allowed with --ugr: IES LM-63, EULUMDAT.", {file});
    switch (kind) {
        case io::FileKind::obj_mesh:
            // With materials of its own, or options for it, it is a scene.
            if (io::names_materials(file) || !request.overrides.empty()) break;
            return report_mesh(file, monitor);
        case io::FileKind::ply_mesh:
            return report_mesh(file, monitor);
        case io::FileKind::run:
            return report_state(file);
        default:
            break;
    }
    return report_scene(read_scene(file, request.overrides, monitor), file, monitor);
}

}  // namespace

void add_info(CommandLine& line) {
    Command command = line.add_command(
        "info", "Show the contents of a scene, luminaire, mesh or state file, with warnings");
    command.set_examples(
        "  stilb info office.toml\n"
        "  stilb info downlight.ies\n"
        "  stilb info panel.ldt --ugr\n"
        "  stilb info room.obj --json\n"
        "  stilb info hall.run\n");
    auto request = std::make_shared<InfoRequest>();
    command
        .add("FILE", request->file,
             "Scene (TOML, - for standard input; .gltf, .glb; .obj with materials; .rad), luminaire (.ies, "
             ".ldt), mesh (.obj, .ply) or state of a run (.run)")
        .required();
    add_overrides(command, request->overrides);
    command.add("--ugr", request->has_ugr,
                "For a luminaire, print the tables of its Unified Glare Rating, too: 19 rooms, five sets of "
                "reflectances, crosswise and endwise");
    command.add(
        "--json", request->json,
        "One JSON document instead of the text: {\"file\", \"materials\", \"objects\", \"lights\", "
        "\"total_flux_lm\", \"maintenance\", \"luminaires\", \"sensors\", \"power\", \"notes\", "
        "\"run\", \"state\", \"warnings\", \"memory\"}, as far as the file has them; units are in the keys");
    command.run([request] {
        const InfoReport report = [&] {
            const LoadingProgress progress;
            return report_file(*request, progress.monitor());
        }();
        fmt::print("{}", request->json
                             ? report.dump(1, ' ', false, InfoReport::error_handler_t::replace) + "\n"
                             : to_text(report));
        return kExitDone;
    });
}

// The report of `stilb info` as text.

namespace {

using Json = InfoReport;

std::string text(const Json& json, const char* key) { return json.at(key).get<std::string>(); }
double number(const Json& json, const char* key) { return json.at(key).get<double>(); }
std::size_t count(const Json& json, const char* key) { return json.at(key).get<std::size_t>(); }

/// The colours of a texture, which are materials, count once: "wall (texture)".
std::string joined(const Json& names) {
    std::string result;
    std::set<std::string> textures;
    for (const Json& name : names) {
        auto word = name.get<std::string>();
        if (const std::string texture(io::material_of_colour(word)); !texture.empty()) {
            if (!textures.insert(texture).second) continue;
            word = texture + " (texture)";
        }
        result += fmt::format("{}{}", result.empty() ? "" : ", ", word.empty() ? "(none)" : word);
    }
    return result;
}

std::string point_text(const Json& p) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", p[0].get<double>(), p[1].get<double>(),
                       p[2].get<double>());
}

std::string extent_text(const Json& extent) {
    if (extent[0] == extent[1]) return "at " + point_text(extent[0]);
    return fmt::format("from {} to {}", point_text(extent[0]), point_text(extent[1]));
}

/// A share to three digits, another number to four; an array as "0.1 x 0.2".
std::string parameter_text(const Json& value) {
    if (value.is_array()) {
        std::string text;
        for (const Json& element : value) text += (text.empty() ? "" : " x ") + parameter_text(element);
        return text;
    }
    const double number = value.get<double>();
    return std::abs(number) <= 1 ? fmt::format("{:.3g}", number) : fmt::format("{:.4g}", number);
}

/// The materials with the colours of each texture as one, which has their number and range of reflectances.
Json with_whole_textures(const Json& materials) {
    Json list = Json::array();
    std::map<std::string, std::size_t> places;
    for (Json material : materials) {
        const std::string name = text(material, "name"), texture(io::material_of_colour(name));
        if (!texture.empty()) {
            const double reflectance = number(material, "reflectance");
            if (const auto known = places.find(texture); known != places.end()) {
                Json& whole = list[known->second];
                whole["colours"] = count(whole, "colours") + 1;
                whole["brightest"] = std::max(number(whole, "brightest"), reflectance);
                whole["reflectance"] = std::min(number(whole, "reflectance"), reflectance);
                continue;
            }
            places[texture] = list.size();
            material["name"] = texture + " (texture)";
            material["colours"] = 1;
            material["brightest"] = reflectance;
        }
        list.push_back(std::move(material));
    }
    return list;
}

std::string material_text(const Json& material) {
    if (material.contains("colours")) {
        return fmt::format("{:16} {:9} reflectance {:.3g} to {:.3g}, {} colours", text(material, "name"),
                           text(material, "type"), number(material, "reflectance"),
                           number(material, "brightest"), count(material, "colours"));
    }
    // The internal transmittance is part of the transmittance.
    static const std::set<std::string> left_out{"name", "type", "reflectance", "rgb",
                                                "internal_transmittance"};
    std::string parameters;
    for (const auto& [key, value] : material.items()) {
        if (!left_out.contains(key) && !key.ends_with("_by_angle"))
            parameters +=
                fmt::format("{}{} {}", parameters.empty() ? " (" : ", ", key, parameter_text(value));
    }
    return fmt::format("{:16} {:9} reflectance {:.3g}{}{}", text(material, "name"), text(material, "type"),
                       number(material, "reflectance"), parameters, parameters.empty() ? "" : ")");
}

std::string object_text(const Json& object) {
    const std::size_t triangles = count(object, "triangles"), parts = count(object, "parts");
    const std::size_t open = count(object, "open_edges");
    std::string line = fmt::format("{:16} {:9} {:.4g} m2", text(object, "name"), text(object, "shape"),
                                   number(object, "area_m2"));
    if (triangles > 0) line += fmt::format(", {} triangles", triangles);
    if (object.contains("degree")) line += fmt::format(", degree {}", count(object, "degree"));
    if (object.contains("vertices")) line += fmt::format(", {} vertices", count(object, "vertices"));
    if (parts > 1) line += fmt::format(", {} parts", parts);
    line += open == 0 ? ", closed" : fmt::format(", {} open edge{}", open, open == 1 ? "" : "s");
    line += fmt::format(", {}", extent_text(object.at("extent")));
    const Json& materials = object.at("materials");
    line += fmt::format("{}{}", materials.size() > 1 ? "\n    materials: " : ", ", joined(materials));
    if (object.contains("groups")) {
        line += fmt::format("\n    groups: {}\n    triangles without area, left out: {}",
                            joined(object.at("groups")), count(object, "degenerate_triangles_left_out"));
    }
    return line;
}

/// "peak_intensity_cd" and a number become "peak intensity 80 cd", "object" and a text "object panel".
std::string light_detail_text(const std::string& key, const Json& value) {
    const auto [words, unit] = io::words_of_key(key);
    if (value.is_string()) return fmt::format("{} {}", words, value.get<std::string>());
    return fmt::format("{} {:.5g}{}{}", words, value.get<double>(), unit.empty() ? "" : " ", unit);
}

std::string light_text(const Json& light) {
    std::vector<std::string> details;
    if (light.contains("flux_lm")) details.push_back(fmt::format("{:.5g} lm", number(light, "flux_lm")));
    for (const auto& [key, value] : light.items()) {
        if (key != "name" && key != "type" && key != "flux_lm")
            details.push_back(light_detail_text(key, value));
    }
    return fmt::format("{:16} {:11} {}", text(light, "name"), text(light, "type"), fmt::join(details, ", "));
}

std::string luminaire_text(const Json& luminaire) {
    std::string line =
        fmt::format("{} ({}): {}\n    {:.5g} lm, peak {:.5g} cd; {}", text(luminaire, "file"),
                    text(luminaire, "format"), text(luminaire, "name"), number(luminaire, "flux_lm"),
                    number(luminaire, "peak_intensity_cd"), text(luminaire, "flux_check"));
    line += luminaire["power_w"].is_null() ? "; power not stated"
                                           : fmt::format("; {:.4g} W", number(luminaire, "power_w"));
    if (luminaire.contains("planes")) {
        line += fmt::format("\n    {} planes of {} angles", count(luminaire, "planes"),
                            count(luminaire, "angles"));
    }
    if (luminaire.contains("ugr")) line += ugr_text(luminaire["ugr"]);
    return line;
}

std::string size_text(const Json& size, const char* things) {
    return fmt::format("{} x {} {}", size[0].get<int>(), size[1].get<int>(), things);
}

std::string camera_text(const Json& camera) {
    return fmt::format("{}, {}, {:.4g} degrees across, from {} to {}",
                       size_text(camera.at("resolution"), "pixels"), text(camera, "projection"),
                       number(camera, "fov_deg"), point_text(camera.at("position")),
                       point_text(camera.at("target")));
}

std::string readings_text(const Json& sensor) {
    if (sensor.contains("count")) return size_text(sensor["count"], "points");
    const std::size_t readings = count(sensor, "points");
    const sensors::Noun noun = sensors::readings_of_type(text(sensor, "type"));
    const std::size_t left_out = sensor.contains("left_out") ? count(sensor, "left_out") : 0;
    return fmt::format("{} {}{}", readings, readings == 1 ? noun.one : noun.many,
                       io::left_out_text(left_out));
}

std::string required_text(const Json& sensor) {
    if (!sensor.contains("require")) return "";
    std::string result;
    for (const auto& [key, limit] : sensor["require"].items())
        result += fmt::format("{} {} {:g}", result.empty() ? ", required:" : ",", key, limit.get<double>());
    return result;
}

std::string sensor_details(const Json& sensor) {
    if (sensor.contains("resolution")) return camera_text(sensor);
    if (sensor.contains("formula")) return text(sensor, "formula");
    return readings_text(sensor) + ", " + extent_text(sensor.at("extent"));
}

std::string sensor_text(const Json& sensor) {
    return fmt::format("{:16} {:15} {}{}", text(sensor, "name"), text(sensor, "type"), sensor_details(sensor),
                       required_text(sensor));
}

std::string run_text(const Json& run) {
    std::string line = "Run: ";
    for (const auto& [key, value] : run.items()) {
        const std::string shown = value.is_string()
                                      ? value.get<std::string>()
                                      : value.dump(-1, ' ', false, Json::error_handler_t::replace);
        line += fmt::format("{}{} {}", key == "method" ? "" : ", ", key, shown);
    }
    return line + "\n";
}

std::string memory_text(const Json& memory) {
    constexpr double mega = 1e6, small_bytes = 1e7;
    std::string result =
        fmt::format("Memory to read it: {:.1f} MB at most; the meshes take {:.2f} MB\n",
                    number(memory, "peak_bytes") / mega, number(memory, "meshes_bytes") / mega);
    const double readings_bytes = memory.contains("readings_bytes") ? number(memory, "readings_bytes") : 0;
    if (readings_bytes > small_bytes)
        result +=
            fmt::format("Memory to measure: about {:.0f} MB, and {:.0f} MB more where the light is guessed\n",
                        readings_bytes / mega, run::kGuessBytes / mega);
    return result;
}

std::string installed_text(const Json& power) {
    const auto unknown = power.at("unknown").get<std::vector<std::string>>();
    std::optional<double> installed_w;
    if (!power.at("installed_w").is_null()) installed_w = number(power, "installed_w");
    std::string line = "Installed power: " + io::power_text(installed_w, unknown);
    if (power.contains("w_m2"))
        line += fmt::format("; {:.3g} W/m2 of the task area ({:.4g} m2)", number(power, "w_m2"),
                            number(power, "task_area_m2"));
    return line + "\n";
}

using Describe = std::string (*)(const Json&);

/// The maintenance factors that the flux contains.
std::string maintained(const Json& report) {
    if (!report.contains("maintenance")) return "";
    return fmt::format(" ({})", io::maintenance_text(report["maintenance"].get<std::array<double, 2>>()));
}

std::string section_text(const Json& report, const char* key, const char* title, Describe describe) {
    if (!report.contains(key) || report[key].empty()) return "";
    const Json& list = report[key];
    std::string result = fmt::format("\n{} ({})", title, list.size());
    if (key == std::string_view("lights") && number(report, "total_flux_lm") > 0)
        result += fmt::format(", {:.5g} lm in all{}", number(report, "total_flux_lm"), maintained(report));
    for (const Json& item : list) result += fmt::format("\n  {}", describe(item));
    return result + "\n";
}

}  // namespace

std::string to_text(const InfoReport& report) {
    if (report.contains("state")) return text(report, "file") + "\n" + state_text(report["state"]);
    const bool is_named = report.contains("name") && !text(report, "name").empty();
    std::string result = text(report, "file");
    result += is_named ? fmt::format(": {}\n", text(report, "name")) : "\n";
    InfoReport shown = report;
    if (report.contains("materials")) shown["materials"] = with_whole_textures(report["materials"]);
    result += section_text(shown, "materials", "Materials", material_text);
    result += section_text(report, "objects", "Objects", object_text);
    result += section_text(report, "lights", "Lights", light_text);
    result += section_text(report, "luminaires", "Luminaires", luminaire_text);
    result += section_text(report, "sensors", "Sensors", sensor_text);
    result +=
        section_text(report, "warnings", "Warnings", [](const Json& w) { return w.get<std::string>(); });
    result += "\n";
    if (report.contains("notes")) {
        for (const Json& note : report["notes"]) result += note.get<std::string>() + "\n";
    }
    if (report.contains("power")) result += installed_text(report["power"]);
    if (report.contains("run")) result += run_text(report["run"]);
    if (report.contains("memory")) result += memory_text(report["memory"]);
    return report["warnings"].empty() ? result + "No warnings\n" : result;
}

}  // namespace stilb::cli
