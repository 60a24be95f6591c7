// stilb info: what a scene, a luminaire file or a mesh file holds, and what is odd about it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>

#include "cli/commands.h"
#include "cli/info_report.h"
#include "io/text/text.h"

namespace stilb::cli {
namespace {

struct InfoRequest {
    std::string file;
    bool json = false;
};

InfoReport report_file(const std::string& file) {
    const std::string extension = io::extension_of(file);
    const auto is_one_of = [&](const auto& extensions) {
        return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
    };
    if (is_one_of(std::array{".ies", ".ldt"})) return report_luminaire(file);
    if (is_one_of(std::array{".obj", ".ply"})) return report_mesh(file);
    return report_scene(io::read_scene_file(file), file);
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
    CLI::App* command =
        app.add_subcommand("info", "What a scene, luminaire or mesh file holds, with warnings");
    set_examples(*command,
                 "  stilb info office.toml\n"
                 "  stilb info downlight.ies\n"
                 "  stilb info room.obj --json\n");
    auto request = std::make_shared<InfoRequest>();
    command->add_option("FILE", request->file, "Scene (TOML), luminaire (.ies, .ldt) or mesh (.obj, .ply)")
        ->required();
    command->add_flag(
        "--json", request->json,
        "One JSON document instead: {\"file\", \"materials\", \"objects\", \"lights\", "
        "\"total_flux_lm\", \"luminaires\", \"sensors\", \"run\", \"warnings\", \"memory\"}, those "
        "that the file has; units are in the keys");
    command->callback([request, &exit_code] {
        const InfoReport report = report_file(request->file);
        fmt::print("{}", request->json ? report.dump(1) + "\n" : to_text(report));
        exit_code = kExitDone;
    });
}

}  // namespace stilb::cli
