// Runs of the library: options and results in public types.
#include "run/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "api/run_state.h"
#include "api/scene_data.h"
#include "api/stored.h"
#include "base/field.h"
#include "base/version.h"
#include "base/warning.h"
#include "io/image/picture_file.h"
#include "io/results/results_writer.h"
#include "io/results/run_file.h"
#include "io/results/solution_file.h"
#include "math/zernike.h"
#include "run/solve.h"
#include "scene/light_groups.h"
#include "scene/whites.h"
#include "stilb/error.h"
#include "stilb/measure.h"
#include "stilb/render.h"

namespace stilb::api {
namespace {

/// Passes on what runs report.
class ControlSink final : public PictureSink {
  public:
    explicit ControlSink(const Control& control) : control_(control) {}

    void report_set_up(const SetUp& set_up) override {
        constexpr double unknown = std::numeric_limits<double>::infinity();
        pass_on({std::string(set_up.stage), set_up.elapsed_s, unknown, unknown});
    }
    void report(const ProgressSink::Progress& progress) override {
        pass_on({"", progress.elapsed_s, progress.remaining_s, progress.attained_error});
    }
    bool wants_picture() override { return false; }
    void show(const Pixels&) override {}

  private:
    void pass_on(const api::Progress& progress) const {
        if (control_.report) control_.report(progress);
    }

    const Control& control_;
};

Triple triple(const Rgb& rgb) { return {rgb[0], rgb[1], rgb[2]}; }
Triple triple(const Vec3& v) { return {v.x, v.y, v.z}; }

Estimate estimate(const statistics::Estimate& e) { return {e.value, e.standard_error, e.lower, e.upper}; }

Summary summary(const RunSummary& run, std::span<const Warning> of_file) {
    Summary summary{.method = run.method,
                    .technique = run.technique,
                    .seed = run.seed,
                    .samples = run.samples,
                    .replicates = run.replicates,
                    .elapsed_s = run.elapsed_s,
                    .stopped = std::string(run::name_of(run.stop_reason)),
                    .converged = run.converged,
                    .requested_error = run.requested_error,
                    .attained_error = run.attained_error,
                    .warnings = {},
                    .warning_kinds = {}};
    for (const std::span<const Warning> all : {of_file, std::span<const Warning>(run.warnings)}) {
        for (const Warning& warning : all) {
            summary.warnings.push_back(warning.text);
            summary.warning_kinds.emplace_back(warning.kind_name());
        }
    }
    return summary;
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr Triple kNowhere{kNone, kNone, kNone};

Ray ray_of(const Measurand& measurand) {
    const Location location = location_of(measurand);
    return {triple(location.position),
            location.directions.empty() ? kNowhere : triple(location.directions.front().value)};
}

LightShare share_of(run::Share& measured) {
    LightShare share{.name = measured.name,
                     .readings = {},
                     .mean = estimate(measured.summary.mean),
                     .minimum = estimate(measured.summary.minimum),
                     .maximum = estimate(measured.summary.maximum),
                     .uniformity = estimate(measured.summary.uniformity),
                     .diversity = estimate(measured.summary.diversity),
                     .replicates = std::move(measured.replicate_means)};
    for (const statistics::Estimate& reading : measured.readings) share.readings.push_back(estimate(reading));
    return share;
}

SensorResult sensor_result(run::SensorResult& measured) {
    const Sensor& sensor = measured.sensor;
    SensorResult result{.name = sensor.name,
                        .type = std::string(sensor.type()),
                        .quantity = std::string(sensor.quantity().name),
                        .unit = std::string(sensor.quantity().unit),
                        .count = sensor.count().value_or(std::array{0, 0}),
                        .readings = {},
                        .mean = estimate(measured.summary.mean),
                        .minimum = estimate(measured.summary.minimum),
                        .maximum = estimate(measured.summary.maximum),
                        .uniformity = estimate(measured.summary.uniformity),
                        .attained_error = measured.attained_error,
                        .diversity = estimate(measured.summary.diversity),
                        .requirements = {},
                        .replicates = std::move(measured.replicate_means),
                        .shares = {}};
    for (run::Share& share : measured.shares) result.shares.push_back(share_of(share));
    for (const auto& [requirement, verdict, reason] : measured.requirements) {
        result.requirements.push_back({std::string(requirement.criterion->key), requirement.limit,
                                       static_cast<Verdict>(verdict), reason});
    }
    for (std::size_t j = 0; j < measured.readings.size(); ++j) {
        const run::Reading& reading = measured.readings[j];
        const auto [position, direction] =
            sensor.derived() ? Ray{kNowhere, kNowhere} : ray_of(sensor.measurand(j));
        result.readings.push_back({estimate(reading.estimate), triple(reading.rgb), position, direction});
    }
    return result;
}

}  // namespace

const SensorResult& Result::operator[](std::string_view sensor) const {
    std::vector<std::string_view> names;
    for (const SensorResult& result : sensors) {
        if (result.name == sensor) return result;
        names.push_back(result.name);
    }
    throw InputError(
        fmt::format("there is no result of a sensor \"{}\". Allowed: {}.", sensor, fmt::join(names, ", ")));
}

std::string Result::json() const {
    if (const auto* const text = std::get_if<std::string>(&data->document)) return *text;
    const auto& [run, scene] = std::get<Data::Source>(data->document);
    return io::to_json(run, scene);
}

Result restored_result(const Summary& summary, std::vector<SensorResult> sensors, double confidence,
                       std::string json, std::vector<LightSceneResult> light_scenes) {
    return {summary, std::move(sensors), confidence,
            std::make_shared<const Result::Data>(Result::Data{std::move(json)}), std::move(light_scenes)};
}

namespace {

LightFactor light_factor(const std::string& light, const Triple& factor) {
    for (const double band : factor) {
        if (band >= 0 && std::isfinite(band)) continue;
        throw InputError(
            fmt::format("lights.{}: {} is not allowed. Allowed: a factor of 0 or more.", light, band));
    }
    return {light, {{factor[0], factor[1], factor[2]}}};
}

Result result_from(const Scene& scene, RunResult run) {
    const io::SceneFile& file = scene.data().file;
    add_hashes(file, run);
    run.warnings.insert(run.warnings.begin(), file.warnings.begin(), file.warnings.end());
    Result result{summary(run, {}), {}, run.confidence, {}};
    std::ranges::transform(run.sensors, std::back_inserter(result.sensors), sensor_result);
    for (RunResult& lit : run.light_scenes) {
        LightSceneResult& own = result.light_scenes.emplace_back();
        own.name = lit.scene_name;
        own.power_w = lit.power.power_w;
        std::ranges::transform(lit.sensors, std::back_inserter(own.sensors), sensor_result);
    }
    result.data = std::make_shared<const Result::Data>(
        Result::Data{Result::Data::Source{std::move(run), scene.data().path.string()}});
    return result;
}

Result measure_sensors(const Scene& scene, const std::vector<Sensor>& sensors, const RunOptions& options,
                       const Control& control, RunState* state) {
    ControlSink sink(control);
    if (state) state->data().require(scene, sensors, options);
    RunResult run = run::measure(scene.data().prepared, sensors, options, &sink, control.interrupt,
                                 state ? &state->data().sums : nullptr);
    if (state) state->data().end(run);
    return result_from(scene, std::move(run));
}

Result measure_sensors(const Scene& scene, const std::vector<Sensor>& sensors,
                       const std::optional<Options>& options, const Control& control,
                       RunState* state = nullptr) {
    return measure_sensors(scene, sensors, run_options(scene, options), control, state);
}

Vec3 position_of(const Ray& ray) { return {ray.position[0], ray.position[1], ray.position[2]}; }

/// `what`: the kind of ray, for messages.
Vec3 direction_of(const Ray& ray, std::size_t index, std::string_view what) {
    const Vec3 direction{ray.direction[0], ray.direction[1], ray.direction[2]};
    const double size = length(direction);
    constexpr double smallest = 1e-100, largest = 1e100;
    const Vec3 position = position_of(ray);
    const bool is_point = std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z);
    if (!is_point || !(size > smallest && size < largest)) {
        throw InputError(
            fmt::format("{} {}: the position or the direction is not finite, or the direction is [0, 0, "
                        "0]. Allowed: finite numbers, and any other direction.",
                        what, index));
    }
    return direction / size;
}

}  // namespace

Result measure(const Scene& scene, const std::optional<Options>& options, const Control& control,
               const std::vector<std::string>& sensors, RunState* state) {
    return measure_sensors(scene, sensors::choose_meters(scene.data().file.sensors, sensors), options,
                           control, state);
}

Result measure_to_next_check(const Scene& scene, const std::optional<Options>& options,
                             const Control& control, const std::vector<std::string>& sensors,
                             RunState& state) {
    RunOptions run = run_options(scene, options);
    run.stops_at_check = true;
    return measure_sensors(scene, sensors::choose_meters(scene.data().file.sensors, sensors), run, control,
                           &state);
}

namespace {

Summary measure_own_part(const Scene& scene, const Options& options, run::RunPart part, RunState& state,
                         const Control& control, const std::vector<std::string>& sensors) {
    const std::vector<Sensor> meters = sensors::choose_meters(scene.data().file.sensors, sensors);
    const RunOptions run = run_options(scene, options);
    state.data().require(scene, meters, run);
    ControlSink sink(control);
    RunSummary made = run::measure_part(scene.data().prepared, meters, run, part, state.data().sums, &sink,
                                        control.interrupt);
    state.data().end(made);
    return summary(made, scene.data().file.warnings);
}

}  // namespace

Summary measure_part(const Scene& scene, const Options& options, std::size_t part, std::size_t parts,
                     RunState& state, const Control& control, const std::vector<std::string>& sensors) {
    return measure_own_part(scene, options, {part, parts}, state, control, sensors);
}

void plan_parts(const Scene& scene, const Options& options, RunState& state, const Control& control,
                const std::vector<std::string>& sensors) {
    // A part without strands: no run has so many.
    constexpr std::size_t many = std::numeric_limits<std::size_t>::max();
    measure_own_part(scene, options, {many - 1, many}, state, control, sensors);
    state.data().origin.elapsed_s = 0;  // which all parts would add
    state.data().origin.ending.clear();
}

Result result_of(const Scene& scene, const RunState& state, const std::optional<Options>& options,
                 const std::vector<std::string>& sensors, const std::map<std::string, Triple>& factors) {
    const std::vector<Sensor> meters = sensors::choose_meters(scene.data().file.sensors, sensors);
    const RunOptions run = run_options(scene, options);
    if (state.samples() == 0) throw InputError("the run has no samples yet");
    RunState::Data own = state.data();
    own.require(scene, meters, run);
    LightScene dimmed;
    for (const auto& [name, factor] : factors) dimmed.factors.push_back(light_factor(name, factor));
    RunResult result =
        run::result_of(scene.data().prepared, meters, run, own.sums, factors.empty() ? nullptr : &dimmed);
    io::set_ending(own.origin, result);
    return result_from(scene, std::move(result));
}

Result illuminance(const Scene& scene, std::span<const Ray> elements, const std::optional<Options>& options,
                   const Control& control) {
    IlluminancePoints points;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const Vec3 normal = direction_of(elements[i], i, "point");
        points.points.push_back({position_of(elements[i]), normal});
    }
    return measure_sensors(scene, {Sensor{"illuminance", std::move(points)}}, options, control);
}

Result luminance(const Scene& scene, std::span<const Ray> sights, const std::optional<Options>& options,
                 const Control& control) {
    Luminance lines;
    for (std::size_t i = 0; i < sights.size(); ++i) {
        const Vec3 direction = direction_of(sights[i], i, "line of sight");
        lines.sights.emplace_back(LineOfSight{position_of(sights[i]), direction});
    }
    return measure_sensors(scene, {Sensor{"luminance", std::move(lines)}}, options, control);
}

namespace {

/// `white`: that of the light in the picture.
Picture picture_of(const Summary& summary, io::Picture pixels, const scene::WhiteRange& white) {
    Picture picture;
    static_cast<Summary&>(picture) = summary;
    picture.width = pixels.width;
    picture.height = pixels.height;
    picture.rgb_cd_m2 = pixels.rgb_cd_m2;
    picture.standard_error_cd_m2 = pixels.standard_error_cd_m2;
    picture.depth_m = pixels.depth_m;
    picture.normals = pixels.normals;
    for (std::size_t pixel = 0; pixel < pixels.pixel_count(); ++pixel)
        picture.luminance_cd_m2.push_back(static_cast<float>(pixels.luminance_cd_m2(pixel)));
    picture.data = std::make_shared<const Picture::Data>(Picture::Data{std::move(pixels), white});
    return picture;
}

Picture to_picture(const RenderResult& rendered, const Scene& scene, const Sensor& camera,
                   const scene::WhiteRange& white) {
    io::PictureOrigin origin;
    origin.scene = scene.data().path.string();
    origin.scene_name = scene.data().file.scene.name;
    origin.sensor = camera.name;
    origin.method = rendered.method;
    origin.seed = rendered.seed;
    origin.version = program_version();
    return picture_of(summary(rendered, scene.data().file.warnings),
                      io::picture_of(rendered, *camera.camera(), origin), white);
}

}  // namespace

Picture restored_picture(const Summary& summary, const StoredPicture& stored) {
    return picture_of(summary, io::read_exr(stored.exr, "picture"), {stored.warmest, stored.coolest});
}

StoredPicture stored(const Picture& picture) {
    const auto& [pixels, white] = *picture.data;
    return {io::to_exr(pixels), white.warmest, white.coolest};
}

void Picture::save(const std::filesystem::path& path) const {
    io::write_picture(data->picture, path, {.exposure = {}, .white = data->white});
}

Picture render(const Scene& scene, const std::string& camera, const std::optional<Options>& options,
               const Control& control) {
    const io::SceneFile& file = scene.data().file;
    const Sensor& sensor = sensors::choose_camera(file.sensors, camera);
    ControlSink sink(control);
    return to_picture(
        run::render(scene.data().prepared, sensor, run_options(scene, options), &sink, control.interrupt),
        scene, sensor, scene::whites_of_lights(file.scene));
}

namespace {

SolveResult result_of(io::StoredSolution stored) {
    SolveResult result;
    result.method = result.technique = "ray-bundle";
    result.seed = stored.seed;
    result.samples = stored.steps;
    result.attained_error = stored.attained_error;
    result.solution = std::move(stored.solution);
    return result;
}

}  // namespace

const Summary& Solution::summary() const { return data_->summary; }

Solution Solution::load(const std::filesystem::path& path) {
    io::StoredSolution stored = io::read_solution_file(path);
    const std::filesystem::path scene_path = path.parent_path() / stored.scene;
    if (!std::filesystem::exists(scene_path)) {
        throw InputError(fmt::format("scene '{}' of this solution was not found. Put it there again.",
                                     scene_path.string()),
                         {path.string()});
    }
    const Scene scene = Scene::load(scene_path);
    const io::SceneFile& file = scene.data().file;
    io::require_same_light(stored, file, path.string());
    SolveResult result = result_of(std::move(stored));
    const Summary all = api::summary(result, file.warnings);
    return Solution(std::make_shared<const Data>(Data{scene, all, std::move(result), file.run.threads}));
}

std::string stored(const Solution& solution) {
    const SolveResult& result = solution.data().result;
    io::StoredSolution stored;  // without the scene's file: it comes with the scene
    stored.version = program_version();
    stored.seed = result.seed;
    stored.steps = result.samples;
    stored.attained_error = result.attained_error;
    stored.solution = result.solution;
    return to_bytes(stored);
}

Solution restored_solution(const Scene& scene, const Summary& summary, std::string_view bytes) {
    return Solution(std::make_shared<const Solution::Data>(Solution::Data{
        scene, summary, result_of(io::read_solution(bytes, "solution")), scene.data().file.run.threads}));
}

std::vector<std::string> Solution::lights() const {
    return scene::light_groups(data_->scene.data().file.scene).names;
}

Picture Solution::render(const std::string& camera, const Control& control,
                         const std::map<std::string, Triple>& factors) const {
    const io::SceneFile& file = data_->scene.data().file;
    const Sensor& sensor = sensors::choose_camera(file.sensors, camera);
    std::vector<LightFactor> of_groups;
    for (const auto& [name, factor] : factors) of_groups.push_back(light_factor(name, factor));
    ControlSink sink(control);
    const RenderResult rendered = run::render_solution(file.scene, sensor, data_->result.solution, of_groups,
                                                       data_->threads, &sink, control.interrupt);
    const LightGroups groups = scene::light_groups(file.scene);
    const scene::Scene dimmed =
        scene::relit(file.scene, groups, scene::factors_of_groups(of_groups, groups.names));
    return to_picture(rendered, data_->scene, sensor, scene::whites_of_lights(dimmed));
}

void Solution::save(const std::filesystem::path& path) const {
    const io::SceneFile& file = data_->scene.data().file;
    if (data_->scene.data().path.empty()) {
        throw InputError(
            "a solution's file refers to the scene's file, and this scene was built in code. Save the scene "
            "as a scene file, and solve that.",
            {path.string()});
    }
    write_solution_file(io::stored_solution(data_->result, data_->result.solution, file, path), path);
}

Solution solve(const Scene& scene, const std::optional<Options>& options, const Control& control,
               const std::optional<int>& degree) {
    constexpr int most = math::ZernikeBasis::kMostDegree;
    if (degree && (*degree < 0 || *degree > most))
        fail_at("degree", fmt::format("{} is not allowed. Allowed: from 0 to {}.", *degree, most));
    const io::SceneFile& file = scene.data().file;
    std::optional<Options> by_bundles = options ? options : scene.options();
    by_bundles->method = "ray-bundle";
    const RunOptions run = run_options(scene, by_bundles);
    ControlSink sink(control);
    SolveResult result = run::solve(scene.data().prepared, run, degree.value_or(run::kDefaultDegree), &sink,
                                    control.interrupt);
    const Summary all = summary(result, file.warnings);
    return Solution(
        std::make_shared<const Solution::Data>(Solution::Data{scene, all, std::move(result), run.threads}));
}

}  // namespace stilb::api
