// stilb reproduce: the figures of the papers, computed anew.
#include "cli/reproduce.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "cli/commands.h"

namespace stilb {
namespace {

namespace fs = std::filesystem;

struct Figure {
    std::string_view name, summary, files;
    void (*reproduce)(const fs::path& directory);
};

constexpr std::array kFigures{
    Figure{"sobolev", "illuminance in Sobolev's problem: local and double local estimation, exact (figure 4)",
           "sobolev.csv, .svg and .png", reproduce_sobolev},
    Figure{"room", "a picture of a simple room with an isotropic source (figure 5, without the head)",
           "room.exr and .png", reproduce_room},
    Figure{"polar", "light reflected more than once in Sobolev's problem, over its direction (figure 6)",
           "polar.csv, .svg and .png", reproduce_polar},
    Figure{"first-shot", "error of ray-bundle pictures with every first shot (the other paper's figure 6)",
           "first-shot-*.csv, .svg and .png", reproduce_first_shot},
    Figure{"directions", "error of ray bundles over rays, by the directions of a step",
           "directions.csv, .svg and .png", reproduce_directions}};

std::vector<Figure> chosen_figures(const std::string& name) {
    std::vector<std::string_view> known;
    for (const Figure& figure : kFigures) {
        if (figure.name == name) return {figure};
        known.push_back(figure.name);
    }
    if (name.empty()) return {kFigures.begin(), kFigures.end()};
    const std::string nearest = nearest_name(name, known);
    throw InputError(fmt::format("there is no figure \"{}\".{} Figures: {}.", name,
                                 nearest.empty() ? "" : fmt::format(" Did you mean \"{}\"?", nearest),
                                 fmt::join(known, ", ")));
}

int run_reproduce(const std::string& name, const fs::path& directory) {
    const std::vector<Figure> figures = chosen_figures(name);
    std::error_code error;
    fs::create_directories(directory, error);
    if (error) throw InputError("the folder cannot be made: " + error.message(), {directory.string()});
    for (const Figure& figure : figures) {
        figure.reproduce(directory);
        fmt::print("{}: {} are in {}\n", figure.name, figure.files, directory.string());
    }
    return kExitDone;
}

}  // namespace

void add_reproduce(CLI::App& app, int& exit_code) {
    CLI::App* command = app.add_subcommand(
        "reproduce", "The figures of the papers on local estimations and on first shot, computed anew");
    set_examples(*command,
                 "  stilb reproduce sobolev -o figures\n"
                 "  stilb reproduce -o figures\n");
    std::string description = "Figure (default: all)";
    for (const Figure& figure : kFigures)
        description += fmt::format("\n  {}: {}", figure.name, figure.summary);
    auto name = std::make_shared<std::string>();
    auto directory = std::make_shared<std::string>();
    command->add_option("FIGURE", *name, description);
    command->add_option("-o,--output", *directory, "Folder for the files; made where it is missing")
        ->type_name("DIR")
        ->required();
    command->callback([name, directory, &exit_code] { exit_code = run_reproduce(*name, *directory); });
}

}  // namespace stilb
