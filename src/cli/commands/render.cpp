// stilb render: a luminance picture of one camera.
#include "cli/commands/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/version.h"
#include "cli/command_line.h"
#include "cli/commands/results_table.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/run_flags.h"
#include "cli/scene_argument.h"
#include "cli/state_file.h"
#include "io/image/picture_file.h"
#include "io/import/scene_formats.h"
#include "io/import/view_file.h"
#include "io/results/results_text.h"
#include "io/results/solution_file.h"
#include "io/scene/overrides.h"
#include "io/text/file_kind.h"
#include "io/text/table.h"
#include "io/text/text.h"
#include "lights/colour_temperature.h"
#include "rays/ray_caster.h"
#include "run/pictures/picture_sums.h"
#include "run/run.h"
#include "scene/light_groups.h"
#include "scene/whites.h"
#include "sensors/first_look.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

constexpr double kPreviewEvery_s = 3;
/// The value of --preview without a file: a first look by a lamp at the camera.
constexpr std::string_view kHeadlight = "headlight";
constexpr std::uint64_t kFirstLookPasses = 16;
constexpr int kFirstLookWidth = 720;

struct RenderRequest {
    std::string scene, from, sensor, view, output, preview, command;
    bool is_first_look = false;
    std::vector<std::string> overrides;
    std::vector<LightFactor> factors;  ///< of lights, with a solution
    io::ToneOptions tone;
    std::string white = "auto";
    StateFlags state;
    std::optional<std::string> part;
    RunFlags flags;
};

/// What --from names, or neither: light that is known already.
struct KnownLight {
    std::optional<io::StoredSolution> solution;
    std::optional<io::StoredRun> run;
    std::string run_output;  ///< the picture that the run was asked for, if it was
};

/// Progress on the terminal, and the preview file.
class RenderProgress final : public TerminalProgress {
  public:
    RenderProgress(const RenderRequest& request, const Camera& camera, const io::PictureOrigin& origin)
        : TerminalProgress("passes", request.flags.off_terminal()),
          request_(request),
          camera_(camera),
          origin_(origin) {}

    void report_set_up(const SetUp& set_up) override {
        if (!request_.flags.quiet) TerminalProgress::report_set_up(set_up);
    }
    void report(const Progress& progress) override {
        elapsed_s_ = progress.elapsed_s;
        if (!request_.flags.quiet) TerminalProgress::report(progress);
    }
    bool wants_picture() override {
        return !request_.preview.empty() && (shown_s_ == 0 || elapsed_s_ - shown_s_ >= kPreviewEvery_s);
    }
    void show(const Pixels& pixels) override {
        // The disk may be full for a while. The end of the run writes the preview again, and reports a
        // failure.
        Outputs().write(
            [&] { write_picture(picture_of(pixels, camera_, origin_), request_.preview, request_.tone); });
        shown_s_ = elapsed_s_;
    }

  private:
    const RenderRequest& request_;
    const Camera& camera_;
    const io::PictureOrigin& origin_;
    double elapsed_s_ = 0, shown_s_ = 0;
};

/// "24 passes (a pixel takes part in 16.3 on average)", where some pixels take part in fewer.
std::string passes_text(const RenderResult& result) {
    std::string text = fmt::format("{} passes", result.samples);
    if (result.samples_per_pixel < static_cast<double>(result.samples))
        text += fmt::format(" (a pixel takes part in {:.3g} on average)", result.samples_per_pixel);
    return text;
}

/// The mean standard error beside the mean luminance; nothing where all is dark.
std::string share_text(const RenderResult& result) {
    if (!(result.mean_luminance_cd_m2 > 0)) return "";
    return fmt::format(", {} of the mean luminance",
                       io::percent(result.mean_standard_error_cd_m2 / result.mean_luminance_cd_m2));
}

void print_summary(const RenderResult& result, const Sensor& sensor, const std::string& output) {
    std::FILE* const stream = messages_beside(output);
    const auto& [width, height] = sensor.camera()->resolution;
    fmt::print(stream, "{}: {} x {} pixels, mean luminance {:.4g} cd/m²\n", sensor.name, width, height,
               result.mean_luminance_cd_m2);
    if (result.replicates > 1) {
        fmt::print(stream, "mean standard error of a pixel: {:.3g} cd/m²{}\n",
                   result.mean_standard_error_cd_m2, share_text(result));
        fmt::print(stream, "95 % of the pixels have a 95 % interval within {} of their value\n",
                   io::percent(result.attained_error));
    }
    fmt::print(stream, "{}, {} in {:.1f} s: {}\n", io::method_text(result), passes_text(result),
               result.elapsed_s, io::ending(result.stop_reason, "passes"));
    fmt::print(stream, "{}{}", shortfall_text(result, output), maintenance_line(result));
    fmt::print(stream, "{}", io::detail_text(result.levels_of_detail));
    if (result.patches) fmt::print(stream, "{}", io::patch_text(*result.patches));
}

/// Refuses flags of the light computation, which a stored solution cannot follow.
void require_no_run_flags(const RunFlags& flags) {
    const std::vector<std::string> given = flags.given();
    if (given.empty()) return;
    throw InputError(
        fmt::format("{} has no effect with --from, which takes the light from the solution. Give it to "
                    "`stilb solve` (which has no "
                    "--method and --bounces).",
                    given.front()));
}

/// Reads the solution named by --from. Its scene becomes the request's scene unless one is given.
io::StoredSolution read_solution_for(RenderRequest& request) {
    require_no_run_flags(request.flags);
    io::StoredSolution stored = io::read_solution_file(request.from);
    if (!request.scene.empty()) return stored;
    const auto scene = std::filesystem::path(request.from).parent_path() / stored.scene;
    if (!std::filesystem::exists(scene)) {
        throw InputError(
            fmt::format("scene '{}' of this solution was not found. If it has moved: stilb render "
                        "SCENE --from FILE.",
                        scene.string()),
            {request.from});
    }
    request.scene = scene.string();
    return stored;
}

/// Whether the picture of this name has its layers. A part of a picture has no name yet.
bool has_layers(const std::string& output) {
    return output.empty() || io::is_standard_output(output) ||
           io::kind_of_name(output) == io::FileKind::exr_picture;
}

RunOptions options_for(const RenderRequest& request, const io::SceneFile& file, const Sensor& sensor,
                       const std::string& output) {
    RunOptions options = with_picture_reserve(request.flags.over(file.run), sensor.camera()->resolution);
    if (has_layers(output)) return options;
    if (request.flags.is_given("--by"))
        throw InputError(fmt::format(
            "--by writes layers into an OpenEXR picture: end the name of -o {} in .exr.", output));
    options.by = "none";  // of the scene file, for readings
    return options;
}

/// Renders, or makes a part of the passes, and keeps the state.
template <typename Render>
auto with_state(const RenderRequest& request, const io::SceneFile& file, const Sensor& sensor,
                const RunOptions& options, const CommandLine& line, const io::PictureOrigin& origin,
                Outputs& outputs, const Render& render) {
    StateFile state_file(request.state, "render", line, file.sources, [&] {
        return io::traits_of(file, {&sensor, 1}, options);
    });
    run::PictureSums sums;
    state_file.keep(io::sums_of_picture(sensor), sums);
    if (sums.seeds().size() > 1) {
        throw InputError(
            "the state is merged from runs of several seeds, and cannot go on. Make a run with another "
            "--seed, and merge it.",
            {request.state.path});
    }
    RenderProgress progress(request, *sensor.camera(), origin);
    KeepingState keeping(&progress, state_file);
    auto result = state_file.keeping_state([&] { return render(sums, &keeping, &watch_for_interrupt()); });
    result.elapsed_s += state_file.elapsed_before_s();
    outputs.write([&] { state_file.write(result.stop_reason); });
    return result;
}

/// The picture of the sums of a stored run, without more passes.
RenderResult shown(const KnownLight& known, const RenderRequest& request, const io::SceneFile& file,
                   const Sensor& sensor, io::PictureOrigin& origin) {
    const RunOptions options = options_for(request, file, sensor, known.run_output);
    require_same_run(known.run->origin, io::traits_of(file, {&sensor, 1}, options), request.from);
    auto sums = io::read_sums<run::PictureSums>(*known.run, io::sums_of_picture(sensor), request.from);
    origin.method = options.method;
    if (sums.seeds().size() == 1) origin.seed = options.seed;
    RenderResult result = run::result_of(file.scene, sensor, options, sums, &watch_for_interrupt());
    io::set_ending(known.run->origin, result);
    return result;
}

/// Computes the picture, from known light where there is some.
RenderResult rendered(const RenderRequest& request, const io::SceneFile& file, const Sensor& sensor,
                      KnownLight known, const CommandLine& line, io::PictureOrigin& origin,
                      Outputs& outputs) {
    if (known.run) return shown(known, request, file, sensor, origin);
    if (known.solution) {
        origin.method = "solution";
        origin.seed = known.solution->seed;
        const int threads = request.flags.over(file.run).threads;
        RenderProgress progress(request, *sensor.camera(), origin);
        return render_solution(file.scene, sensor, std::move(known.solution->solution), request.factors,
                               threads, &progress, &watch_for_interrupt());
    }
    const RunOptions options = options_for(request, file, sensor, request.output);
    origin.method = options.method;
    origin.seed = options.seed;
    return with_state(request, file, sensor, options, line, origin, outputs,
                      [&](run::PictureSums& sums, PictureSink* sink, const std::atomic<bool>* interrupt) {
                          return render(file.scene, sensor, options, sink, interrupt, &sums);
                      });
}

int make_picture_part(const RenderRequest& request, const io::SceneFile& file, const Sensor& sensor,
                      const CommandLine& line) {
    const run::RunPart part = part_of(*request.part, request.state);
    if (!request.output.empty() || !request.preview.empty())
        throw InputError("--part makes no picture: leave -o and --preview out, and give -o to stilb merge.");
    const RunOptions options = options_for(request, file, sensor, "");
    Outputs outputs;
    const RunSummary summary =
        with_state(request, file, sensor, options, line, {}, outputs,
                   [&](run::PictureSums& sums, PictureSink* sink, const std::atomic<bool>* interrupt) {
                       return run::render_part(file.scene, sensor, options, part, sums, sink, interrupt);
                   });
    if (!request.flags.quiet) {
        fmt::print(
            "{}: part {} of the passes, {} in {:.1f} s. All parts give the picture: stilb merge FILE FILE "
            "... -o PICTURE\n",
            request.state.path, *request.part, summary.samples, summary.elapsed_s);
    }
    return outputs.conclude(summary.stop_reason == StopReason::paths_done ? kExitDone : kExitStoppedEarly);
}

/// The white that --white chooses. With "auto" it is that of the lights, with the factors of the picture.
scene::WhiteRange whites(const RenderRequest& request, const Scene& scene) {
    if (request.white == "auto") {
        const LightGroups groups = scene::light_groups(scene);
        return whites_of_lights(
            scene::relit(scene, groups, scene::factors_of_groups(request.factors, groups.names)));
    }
    const std::optional<double> kelvin = io::parse_number(request.white);
    if (!kelvin ||
        !(*kelvin >= lights::kMinColourTemperature_k && *kelvin <= lights::kMaxColourTemperature_k)) {
        throw InputError(fmt::format(
            "--white {}: expected auto or a colour temperature from {:.0f} to {:.0f} K (such as 4000).",
            request.white, lights::kMinColourTemperature_k, lights::kMaxColourTemperature_k));
    }
    const Rgb white = lights::colour_of_temperature(*kelvin);
    return {white, white};
}

/// Throws InputError where a picture cannot be written, or would destroy a file that it is computed from.
void require_pictures(const RenderRequest& request, const io::SceneFile& file) {
    std::vector<std::filesystem::path> inputs = file.sources;
    if (!request.from.empty()) inputs.emplace_back(request.from);
    io::require_luminance_picture_path(request.output, inputs);
    if (!request.preview.empty()) io::require_luminance_picture_path(request.preview, inputs);
}

/// Recognises `--preview` without a file, which may have taken the scene for its value.
void settle_preview(RenderRequest& request) {
    const io::FileKind kind = io::kind_of_name(request.preview);
    const bool is_picture = io::is_luminance_picture(kind) || kind == io::FileKind::png_picture;
    const bool has_origin = !request.scene.empty() || !request.from.empty();
    if (!has_origin && !request.preview.empty() && request.preview != kHeadlight && !is_picture)
        request.scene = std::exchange(request.preview, kHeadlight);
    request.is_first_look = request.preview == kHeadlight;
    if (!request.is_first_look) return;
    request.preview.clear();
    if (!request.from.empty())
        throw InputError(
            "--preview without a file lights the scene by a lamp at the camera; --from has light of "
            "its own. Leave one of them out.");
    if (request.output.empty())
        request.output = std::filesystem::path(request.scene).stem().string() + "-preview.png";
}

/// Adds the camera of --view, and chooses it.
void take_view(RenderRequest& request, io::SceneFile& file) {
    if (request.view.empty()) return;
    if (!request.sensor.empty())
        throw InputError("--view and --sensor both choose the camera. Leave one of them out.");
    request.sensor = io::add_view(request.view, io::placement_beside(request.scene, request.overrides), file);
}

/// Replaces the lamps by one at the camera, and adds a camera where there is none.
void take_first_look(RenderRequest& request, io::SceneFile& file) {
    if (std::ranges::none_of(file.sensors, [](const Sensor& sensor) { return sensor.camera() != nullptr; }))
        file.sensors.push_back(sensors::camera_for_first_look(file.scene, rays::RayCaster(file.scene)));
    Sensor sensor = sensors::choose_camera(file.sensors, request.sensor, request.scene);
    auto& camera = std::get<Camera>(sensor.kind);
    const double scale = std::min(1.0, double{kFirstLookWidth} / camera.resolution[0]);
    for (int& size : camera.resolution) size = std::max(1, static_cast<int>(std::lround(scale * size)));
    file.scene = with_headlight(std::move(file.scene), camera);
    file.sensors = {sensor};
    std::erase_if(file.warnings, is_of(WarningKind::no_light));
    file.run.method = "path";
    file.run.error.reset();
    file.run.time_s.reset();
    file.run.paths = kFirstLookPasses;
    file.run.bounces = 1;  // no noise
}

int render_with(RenderRequest request, KnownLight known, const CommandLine& line) {
    if (request.scene.empty()) {
        throw InputError(
            "the scene is missing. Give a scene (stilb render SCENE -o FILE) or a solution (stilb render "
            "--from FILE -o FILE).");
    }
    io::SceneFile file = read_scene(request.scene, request.overrides, request.flags.show_progress());
    take_view(request, file);
    if (request.is_first_look) take_first_look(request, file);
    if (known.solution) require_same_light(*known.solution, file, request.from);
    const Sensor& sensor = sensors::choose_camera(file.sensors, request.sensor, request.scene);
    if (request.part) return make_picture_part(request, file, sensor, line);
    require_pictures(request, file);
    request.tone.white = whites(request, file.scene);
    io::PictureOrigin origin;
    origin.scene = request.scene;
    origin.scene_name = file.scene.name;
    origin.scene_hash = io::content_hash(file.sources);
    origin.sensor = sensor.name;
    origin.command = request.command;
    origin.version = program_version();
    Outputs outputs;
    RenderResult result = rendered(request, file, sensor, std::move(known), line, origin, outputs);
    if (request.is_first_look) result.warnings.clear();  // of a scene without its lamps
    put_first(file.warnings, result);
    const io::Picture picture = picture_of(result, *sensor.camera(), origin);
    // The files come before all messages: the terminal may be closed by now.
    std::optional<io::ToneCurve> curve;
    outputs.write([&] { curve = write_picture(picture, request.output, request.tone); });
    if (!request.preview.empty())
        outputs.write([&] { write_picture(picture, request.preview, request.tone); });
    if (!request.flags.quiet) print_warnings(result.warnings);
    print_summary(result, sensor, request.output);
    if (request.is_first_look)
        fmt::print(messages_beside(request.output),
                   "A first look: one lamp at the camera lights the scene, its own lamps are off.\n");
    if (curve)
        fmt::print(messages_beside(request.output), "{}: exposure {:.3g} per cd/m², white {:.0f} K\n",
                   request.output, curve->exposure(), curve->white_k());
    return outputs.conclude(result.converged ? kExitDone : kExitStoppedEarly);
}

/// Adds the command with its flags.
Command declare_render(CommandLine& line, RenderRequest& request) {
    Command command =
        line.add_command("render", "Render a luminance picture of one camera, with standard errors");
    command.set_examples(
        "  stilb render office.toml -o office.exr\n"
        "  stilb render office.toml -o office.png --time 20 --sensor desk\n"
        "  stilb render office.toml -o office.hdr --preview now.png --paths 256\n"
        "  stilb render office.toml --preview\n"
        "  stilb render office.rad --view desk.vf -o desk.hdr\n"
        "  stilb render --from office.solution --sensor door -o door.png\n"
        "  stilb render --from office.solution --set desk_lamp=0.4 --set ceiling=0 -o evening.png\n");
    command.add(
        "SCENE", request.scene,
        "Scene (TOML, glTF, OBJ, Radiance), or - for standard input; with --from only if it has moved");
    command
        .add("--from", request.from,
             "Take the light from this solution (written by `stilb solve`), only the view is computed; or "
             "show the picture of this state file, without more passes")
        .value_name("FILE");
    command
        .add("-o,--output", request.output,
             "Picture to write: .exr, .hdr or .png; - writes OpenEXR to stdout (required but for a first "
             "look)")
        .value_name("FILE");
    command.add("--sensor", request.sensor, "The camera, if the scene has several").value_name("NAME");
    command
        .add("--view", request.view,
             "The camera, in place of the scene's: a view file of Radiance (.vf), or a picture (.hdr, .exr) "
             "with "
             "its view and size")
        .value_name("FILE");
    command
        .add(
            "--preview", request.preview,
            "Write also the unfinished picture every few seconds (.exr, .hdr or .png). Without FILE: a first "
            "look, small and quick, by a lamp at the camera instead of the scene's, also where it has no "
            "camera")
        .optional_value(std::string(kHeadlight))
        .value_name("[FILE]");
    command
        .add("--exposure", request.tone.exposure,
             "Exposure of a .png per cd/m2: a luminance of 0.18 / exposure becomes middle grey (default: by "
             "the picture)")
        .above_zero()
        .value_name("E");
    command
        .add("--white", request.white,
             "White of a .png: auto (the light of the scene's white lamps, the default) or the colour "
             "temperature in K of the light that shall look white; 6500 shows the colours as they are")
        .value_name("auto|K");
    add_overrides(command, request.overrides);
    command.find("--set").description(
        "Take this value instead of the scene file's (materials.wall.reflectance=0.4); with --from also a "
        "factor for the light of a group or of a lamp (lamp=0.4, lamp=[1, 0.8, 0.5])");
    add_part(command, request.part);
    request.state.add_to(command);
    request.flags.add_to(command, {"target"});
    command.find("--by").description(
        "Write also a layer for each light or group of lights (light), or each number of reflections "
        "(bounce), into a "
        "picture .exr: Combined_NAME.R ...");
    return command;
}

/// `request`: what concerns the picture file.
int show_picture_of(const io::StoredRun& run, const std::string& name, const RenderRequest& request) {
    if (run.origin.command != "render") {
        throw InputError(
            fmt::format("this is the state of `stilb {}`, not of `stilb render`.", run.origin.command),
            {name});
    }
    CommandLine line;
    RenderRequest own;
    declare_render(line, own).run([] { return kExitDone; });
    read_arguments(run.origin, line);
    own.scene = path_from(own.scene, run.origin, name);
    own.view = path_from(own.view, run.origin, name);
    own.from = name;
    own.part.reset();
    own.preview.clear();
    own.tone = request.tone;
    own.white = request.white;
    own.command = request.command;
    own.flags.quiet = request.flags.quiet;
    const std::string run_output = std::exchange(own.output, request.output);
    return render_with(std::move(own), {std::nullopt, run, run_output}, line);
}

int run_render(RenderRequest request, const CommandLine& line) {
    settle_preview(request);
    if (request.output.empty() && !request.part)
        throw InputError("-o is missing. It gives the picture to write: -o FILE.exr, .hdr or .png.");
    if (request.from.empty()) return render_with(std::move(request), {}, line);
    if (!request.state.path.empty() || request.part)
        throw InputError("--state and --part have no effect with --from: the light is known already.");
    if (io::kind_of_content_of(request.from) == io::FileKind::run) {
        if (!request.scene.empty() || !request.sensor.empty() || !request.view.empty() ||
            !request.overrides.empty() || !request.flags.given().empty())
            throw InputError(
                "--from shows the picture of a state file as it is: it takes no scene, --sensor, --view, "
                "--set or options of a run. Go on with the run: stilb resume FILE.");
        return show_picture_of(io::read_run_file(request.from), request.from, request);
    }
    request.factors = io::take_light_factors(request.overrides);
    io::StoredSolution solution = read_solution_for(request);
    return render_with(std::move(request), {std::move(solution), std::nullopt, ""}, line);
}

}  // namespace

int show_stored_picture(const io::StoredRun& stored, const std::string& name, const std::string& output,
                        bool is_quiet) {
    RenderRequest request;
    request.output = output;
    request.flags.quiet = is_quiet;
    return show_picture_of(stored, name, request);
}

void add_render(CommandLine& line) {
    auto request = std::make_shared<RenderRequest>();
    declare_render(line, *request).run([request, &line] {
        request->command = line.text();
        return run_render(*request, line);
    });
}

}  // namespace stilb::cli
