// stilb export: a scene as files of other programs.
#include "io/export/export.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/progress.h"
#include "cli/scene_argument.h"

namespace stilb::cli {
namespace {

struct ExportRequest {
    std::string scene, format, output;
    std::vector<std::string> overrides;
    bool quiet = false;
};

int run_export(const ExportRequest& request) {
    const io::ExportFormat format = io::export_format(request.format);
    const io::SceneFile file = read_scene(request.scene, request.overrides,
                                          request.quiet ? ShowProgress::never : ShowProgress::on_terminal);
    const io::ExportReport report = io::export_scene(file, format, request.output);
    if (!request.quiet) {
        print_warnings(file.warnings);
        for (const std::string& warning : report.warnings) print_warning(warning);
    }
    fmt::print("{}: {} files for {}\n", request.output, report.files.size(), request.format);
    return kExitDone;
}

}  // namespace

void add_export(CommandLine& line) {
    Command command = line.add_command("export", "Write a scene for Mitsuba 3 or Radiance");
    command.set_examples(
        "  stilb export office.toml --format mitsuba -o office-mitsuba\n"
        "  python3 office-mitsuba/measure.py office-mitsuba/desk_a.pts\n"
        "  stilb export office.toml --format radiance -o office-radiance\n");
    auto request = std::make_shared<ExportRequest>();
    command.add("SCENE", request->scene, "Scene (TOML, glTF, OBJ, Radiance), or - for standard input")
        .required();
    command.add("--format", request->format, "mitsuba or radiance").required().value_name("NAME");
    command.add("-o,--output", request->output, "Folder to write; it is made where it does not exist")
        .required()
        .value_name("DIR");
    add_overrides(command, request->overrides);
    command.add("--quiet", request->quiet, "No warnings on stderr");
    command.run([request] { return run_export(*request); });
}

}  // namespace stilb::cli
