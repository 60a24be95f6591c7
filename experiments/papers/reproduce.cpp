// stilb reproduce: the figures of the papers, computed anew.
#include "papers/reproduce.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "stilb/error.h"

namespace stilb::papers {
namespace {

namespace fs = std::filesystem;

struct Request {
    std::string figure, directory, mesh;
};

struct Figure {
    std::string_view name, summary, files;
    void (*reproduce)(const Request& request);
};

/// Of a figure that only needs to know where its files go.
template <void (*kReproduce)(const fs::path& directory)>
void without_mesh(const Request& request) {
    kReproduce(request.directory);
}

constexpr std::string_view kHarmonics = "harmonics";

constexpr std::array kFigures{
    Figure{"sobolev", "illuminance in Sobolev's problem: local and double local estimation, exact (figure 4)",
           "sobolev.csv, .svg and .png", without_mesh<reproduce_sobolev>},
    Figure{"room", "a picture of a simple room with an isotropic source (figure 5, without the head)",
           "room.exr and .png", without_mesh<reproduce_room>},
    Figure{kHarmonics, "the room with a head as a mesh and as series of spherical harmonics (figure 5)",
           "harmonics.csv, .svg and .png, harmonics-degrees.png, harmonics-room.* and others",
           [](const Request& request) { reproduce_harmonics(request.directory, request.mesh); }},
    Figure{"polar", "light reflected more than once in Sobolev's problem, over its direction (figure 6)",
           "polar.csv, .svg and .png", without_mesh<reproduce_polar>},
    Figure{"first-shot", "error of ray-bundle pictures with every first shot (the other paper's figure 6)",
           "first-shot-*.csv, .svg and .png", without_mesh<reproduce_first_shot>},
    Figure{"directions", "error of ray bundles over rays, by the directions of a step",
           "directions.csv, .svg and .png", without_mesh<reproduce_directions>}};

std::vector<Figure> chosen_figures(const std::string& name) {
    std::vector<std::string_view> known;
    for (const Figure& figure : kFigures) {
        if (figure.name == name) return {figure};
        known.push_back(figure.name);
    }
    if (name.empty()) return {kFigures.begin(), kFigures.end()};
    throw InputError(fmt::format("there is no figure \"{}\".{} Figures: {}.", name, did_you_mean(name, known),
                                 fmt::join(known, ", ")));
}

int run_reproduce(const Request& request) {
    const std::vector<Figure> figures = chosen_figures(request.figure);
    if (!request.mesh.empty() && request.figure != kHarmonics) {
        throw InputError(
            fmt::format("--mesh gives the head of the figure {0}, and no other figure has one. "
                        "Leave it out, or write: stilb reproduce {0} --mesh FILE -o DIR",
                        kHarmonics));
    }
    std::error_code error;
    fs::create_directories(request.directory, error);
    if (error) throw InputError("the folder cannot be made: " + error.message(), {request.directory});
    for (const Figure& figure : figures) {
        figure.reproduce(request);
        fmt::print("{}: {} are in {}\n", figure.name, figure.files, request.directory);
    }
    return cli::kExitDone;
}

}  // namespace

void add_reproduce(cli::CommandLine& line) {
    cli::Command command = line.add_command(
        "reproduce", "The figures of the papers on local estimations and on first shot, computed anew");
    command.set_examples(
        "  stilb reproduce sobolev -o figures\n"
        "  stilb reproduce harmonics --mesh head.ply -o figures\n"
        "  stilb reproduce -o figures\n");
    std::string description = "Figure (default: all)";
    for (const Figure& figure : kFigures)
        description += fmt::format("\n  {}: {}", figure.name, figure.summary);
    auto request = std::make_shared<Request>();
    command.add("FIGURE", request->figure, description);
    command.add("-o,--output", request->directory, "Folder for the files; made where it is missing")
        .value_name("DIR")
        .required();
    command
        .add("--mesh", request->mesh,
             "Another head for the figure harmonics (.obj, .ply), of any size: y up, its face along z")
        .value_name("FILE");
    command.run([request] { return run_reproduce(*request); });
}

}  // namespace stilb::papers
