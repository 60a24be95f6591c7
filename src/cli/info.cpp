// stilb info: what a scene, a luminaire file or a mesh file holds, and what is odd about it.
#include <fmt/format.h>

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

void add_info(CommandLine& line) {
    Command command = line.add_command("info", "What a scene, luminaire or mesh file holds, with warnings");
    command.set_examples(
        "  stilb info office.toml\n"
        "  stilb info downlight.ies\n"
        "  stilb info room.obj --json\n");
    auto request = std::make_shared<InfoRequest>();
    command.add("FILE", request->file, "Scene (TOML), luminaire (.ies, .ldt) or mesh (.obj, .ply)")
        .required();
    command.add("--json", request->json,
                "One JSON document instead: {\"file\", \"materials\", \"objects\", \"lights\", "
                "\"total_flux_lm\", \"luminaires\", \"sensors\", \"run\", \"warnings\", \"memory\"}, those "
                "that the file has; units are in the keys");
    command.run([request] {
        const InfoReport report = report_file(request->file);
        fmt::print("{}", request->json ? report.dump(1) + "\n" : to_text(report));
        return kExitDone;
    });
}

}  // namespace stilb::cli
