// stilb import: a scene of another format as a folder with a scene file that can be edited.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands/import_ifc.h"
#include "cli/progress.h"
#include "cli/scene_argument.h"
#include "io/import/scene_folder.h"
#include "io/import/scene_formats.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

struct ImportRequest {
    std::string file, output, reflectances;
    std::optional<std::string> scale, up;
    std::optional<double> light_scale;
    bool textures = false;
    std::vector<std::string> overrides, views;
    bool quiet = false;
};

std::string count_text(std::size_t count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

int run_import(ImportRequest request) {
    const io::FileKind kind = io::kind_of_file(request.file);
    if (kind == io::FileKind::ifc_building) {
        if (request.scale || request.up || request.light_scale || request.textures ||
            !request.overrides.empty() || !request.views.empty()) {
            throw InputError(
                "--scale, --up, --light-scale, --textures, --view and --set do not go with IFC, which states "
                "its "
                "units. Change the scene file that import writes.",
                {request.file});
        }
        return import_ifc({request.file, request.output, request.reflectances});
    }
    if (!request.reflectances.empty())
        throw InputError("--reflectances is for buildings in IFC.", {request.file});
    if (io::may_be_scene_file(kind) || !io::is_scene(kind)) {
        throw InputError(
            "this is no scene of another format. Allowed: glTF (.gltf, .glb), OBJ with MTL (.obj), Radiance "
            "(.rad) and IFC (.ifc).",
            {request.file});
    }
    if (request.scale) request.overrides.push_back("import.scale=" + *request.scale);
    if (request.up) request.overrides.push_back("import.up=" + *request.up);
    if (request.light_scale)
        request.overrides.push_back(fmt::format("import.light_scale={}", *request.light_scale));
    if (request.textures) request.overrides.emplace_back("import.textures=true");
    const io::SceneFile file = read_scene(request.file, request.overrides, request.views,
                                          request.quiet ? ShowProgress::never : ShowProgress::on_terminal);
    const auto files = io::write_scene_folder(file, request.output);
    if (!request.quiet) {
        print_warnings(file.warnings);
        for (const std::string& note : file.notes) fmt::print("{}\n", note);
    }
    const Scene& scene = file.scene;
    fmt::print("{}: {}, {}, {}, {} in {}\n", files.front().string(),
               count_text(scene.objects.size(), "object"), count_text(scene.materials.size(), "material"),
               count_text(scene.lights.size(), "light"), count_text(file.sensors.size(), "sensor"),
               count_text(files.size(), "file"));
    return kExitDone;
}

}  // namespace

void add_import(CommandLine& line) {
    Command command =
        line.add_command("import", "Make a scene file, which can be edited, of a scene in another format");
    command.set_examples(
        "  stilb import room.glb -o room\n"
        "  stilb measure room/scene.toml\n"
        "  stilb import house.obj -o house --scale 0.01 --up y\n");
    auto request = std::make_shared<ImportRequest>();
    command
        .add("FILE", request->file,
             "Scene: glTF (.gltf, .glb), OBJ with MTL (.obj), Radiance (.rad) or, with the Python package, "
             "IFC (.ifc)")
        .required();
    command
        .add("-o,--output", request->output,
             "Folder to write scene.toml, meshes and luminaires to; it is made where it does not exist")
        .required()
        .value_name("DIR");
    command
        .add("--scale", request->scale,
             "Metres per unit of the file, or auto (the default of OBJ); the same as --set import.scale=S")
        .value_name("S");
    command
        .add("--up", request->up, "Axis of the file that points upwards: y, z or auto (the default of OBJ)")
        .value_name("AXIS");
    command
        .add("--light-scale", request->light_scale,
             "Factor on all light, such as 683 for files that give watts in place of lumens")
        .value_name("F");
    command.add(
        "--textures", request->textures,
        "Show textures as small faces of their colours; otherwise the mean of each counts (glTF, OBJ)");
    command
        .add(
            "--reflectances", request->reflectances,
            "For IFC: a file (TOML) with the reflectances of materials, in lines such as \"Concrete\" = 0.35")
        .value_name("FILE");
    add_views(command, request->views);
    add_overrides(command, request->overrides);
    command.add("--quiet", request->quiet, "No warnings on stderr");
    command.run([request] { return run_import(*request); });
}

}  // namespace stilb::cli
