// stilb falsecolor: measured grids, or a luminance picture, in false colours.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line.h"
#include "io/image/picture_file.h"
#include "plot/canvas.h"
#include "plot/false_colour_picture.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

struct FalseColourRequest {
    std::string input;
    std::string output;
    std::vector<std::string> sensors;
    plot::FalseColourOptions options;
};

void keep_only(const std::vector<std::string>& wanted, io::ResultsFile& results, const std::string& file) {
    std::vector<std::string_view> names;
    for (const io::MeasuredGrid& grid : results.grids) names.push_back(grid.name);
    for (const std::string& name : wanted) {
        if (std::find(names.begin(), names.end(), name) != names.end()) continue;
        throw InputError(fmt::format("--sensor {}: the results have no such grid.{} Grids: {}.", name,
                                     did_you_mean(name, names), fmt::join(names, ", ")),
                         {file});
    }
    std::erase_if(results.grids, [&](const io::MeasuredGrid& grid) {
        return std::find(wanted.begin(), wanted.end(), grid.name) == wanted.end();
    });
}

/// Refuses flags of measured grids.
void require_no_grid_flags(const FalseColourRequest& request) {
    if (!request.sensors.empty()) {
        throw InputError("--sensor selects measured grids, but this input is a picture. Leave --sensor out.",
                         {request.input});
    }
    if (request.options.errors) {
        throw InputError(
            "--errors writes the intervals of measured grids, but this input is a picture. The standard "
            "errors "
            "of its pixels are in the channel SE.Y of the .exr.",
            {request.input});
    }
}

std::string title_of(const io::PictureOrigin& origin, const std::string& file) {
    std::string scene = std::filesystem::path(file).filename().string();
    if (!origin.scene.empty()) scene = origin.scene;
    if (!origin.scene_name.empty()) scene = origin.scene_name;
    return fmt::format("{}: luminance{}{}", scene, origin.sensor.empty() ? "" : ", ", origin.sensor);
}

void draw_picture(const FalseColourRequest& request) {
    require_no_grid_flags(request);
    const io::Picture picture = io::read_picture(request.input);
    draw_false_colour(picture, title_of(picture.origin, request.input), request.options, request.output);
}

int run_falsecolor(const FalseColourRequest& request) {
    plot::require_picture_path(request.output, std::array<std::filesystem::path, 1>{request.input});
    if (io::is_picture_file(request.input)) {
        draw_picture(request);
        return kExitDone;
    }
    io::ResultsFile results = io::read_results_file(request.input);
    if (!request.sensors.empty()) keep_only(request.sensors, results, request.input);
    draw_false_colour(plot::picture_of(results, request.options), request.options, request.output);
    return kExitDone;
}

}  // namespace

void add_falsecolor(CommandLine& line) {
    Command command =
        line.add_command("falsecolor", "Draw measured grids or a luminance picture in false colours");
    command.set_examples(
        "  stilb measure office.toml -o office.json\n"
        "  stilb falsecolor office.json -o office.png --isolines\n"
        "  stilb falsecolor office.json -o desk.svg --sensor desk --numbers --errors\n"
        "  stilb falsecolor view.exr -o luminance.png --log --isolines\n");
    auto request = std::make_shared<FalseColourRequest>();
    plot::FalseColourOptions& options = request->options;
    command
        .add("IN", request->input,
             "Results of 'stilb measure --json', or a luminance picture (OpenEXR or Radiance HDR); - for "
             "standard input")
        .required();
    command.add("-o,--output", request->output, "Picture to write: .png or .svg")
        .required()
        .value_name("FILE");
    command.add("--sensor", request->sensors, "Draw only this grid of the results (may be repeated)")
        .repeatable();
    command.add_switch(
        "--log", [&options] { options.scale = plot::ScaleType::logarithmic; }, "Logarithmic scale");
    command.add("--min", options.minimum, "Lower end of the scale (default: a round number)");
    command.add("--max", options.maximum, "Upper end of the scale (default: a round number)");
    command.add("--isolines", options.isolines, "Draw labelled lines of equal value");
    command.add(
        "--numbers", options.numbers,
        "Write the value into each cell (into every second, third ... column and row where the sheet is "
        "too small; the picture says so), or means on a coarse grid over a picture");
    command.add("--errors", options.errors,
                "Write half of the 95 % interval after a ±: of the grids' statistics, and with --numbers of "
                "each value");
    command.run([request] { return run_falsecolor(*request); });
}

}  // namespace stilb::cli
