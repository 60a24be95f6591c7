// The experiment of [FirstShot]: error of ray-bundle pictures over steps and over time, with every first shot
// (figure 6), and the pictures after 10, 100 and 1000 steps.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "estimators/estimator.h"
#include "estimators/patch_light/patch_readings.h"
#include "io/image/picture_file.h"
#include "io/scene/scene_file.h"
#include "io/text/table.h"
#include "papers/first_shot_convergence.h"
#include "papers/furnished_room.h"
#include "papers/plot.h"
#include "papers/reproduce.h"
#include "transport/receiver.h"

namespace stilb::papers {
namespace {

constexpr int kSteps = 1000;
constexpr double kMostTime_s = 60;
constexpr std::array kShownSteps{10, 100, 1000};
constexpr double kExposure = 0.03;  ///< of all pictures
constexpr const char* kSceneFile = "scenes/paper/furnished.toml";

/// With only the lights whose names begin so.
io::SceneFile furnished_room(std::string_view lights) {
    io::SceneFile file = io::read_scene(kFurnishedRoom, kSceneFile, {});
    std::erase_if(file.scene.lights, [&](const Light& light) { return !light.name.starts_with(lights); });
    return file;
}

ConvergenceMethod method(const std::string& name, estimators::FirstShotVariant variant,
                         estimators::BundleDirections directions = estimators::BundleDirections::frame) {
    estimators::PatchOptions options;
    options.first_shot.variant = variant;
    options.directions = directions;
    return {name, options,
            directions == estimators::BundleDirections::frame &&
                (variant == estimators::FirstShotVariant::incoming ||
                 variant == estimators::FirstShotVariant::none)};
}

/// Without first shot a point light lights nothing.
std::vector<ConvergenceMethod> methods_for(bool are_points) {
    std::vector<ConvergenceMethod> methods{
        method("incoming first shot", estimators::FirstShotVariant::incoming),
        method("classical", estimators::FirstShotVariant::classical),
        method("diffuse", estimators::FirstShotVariant::diffuse),
        method("on the fly", estimators::FirstShotVariant::on_the_fly),
        method("incoming, single directions", estimators::FirstShotVariant::incoming,
               estimators::BundleDirections::single)};
    if (!are_points) methods.push_back(method("no first shot", estimators::FirstShotVariant::none));
    return methods;
}

void write_curves(const std::vector<ConvergenceCurve>& curves, const std::filesystem::path& directory,
                  const std::string& name) {
    std::vector<std::string> names;
    std::vector<double> steps, times_s, errors;
    Plot over_steps{"Error of the picture over steps, " + name, {"steps", plot::ScaleType::logarithmic}, {}};
    Plot over_time{"Error of the picture over time, " + name, {"time [s]", plot::ScaleType::logarithmic}, {}};
    PlotPanel step_panel{{"relative error", plot::ScaleType::logarithmic}, {}}, time_panel = step_panel;
    for (const ConvergenceCurve& curve : curves) {
        Series by_steps{curve.name, {}, {}}, by_time = by_steps;
        for (const auto& [step, elapsed_s, error] : curve.points) {
            names.push_back(curve.name), steps.push_back(step), times_s.push_back(elapsed_s);
            errors.push_back(error);
            by_steps.x.push_back(step), by_time.x.push_back(elapsed_s);
            by_steps.y.push_back(error), by_time.y.push_back(error);
        }
        step_panel.series.push_back(by_steps), time_panel.series.push_back(by_time);
    }
    over_steps.panels = {step_panel}, over_time.panels = {time_panel};
    write_csv(
        std::vector<io::Column>{
            {"first_shot", names}, {"steps", steps}, {"time_s", times_s}, {"relative_error", errors}},
        directory / fmt::format("first-shot-{}.csv", name));
    for (const char* extension : {"svg", "png"}) {
        draw_plot(over_steps, directory / fmt::format("first-shot-{}-steps.{}", name, extension));
        draw_plot(over_time, directory / fmt::format("first-shot-{}-time.{}", name, extension));
    }
}

io::Picture picture_of(const estimators::PictureTracing& tracing, const ConvergenceState& state) {
    constexpr std::uint64_t passes = 4;
    const auto [width, height] = tracing.camera.resolution;
    io::Picture picture;
    picture.width = width, picture.height = height;
    picture.rgb_cd_m2.resize(picture.pixel_count());
    const auto row = static_cast<std::size_t>(width);
    for (std::uint64_t i = 0; i < passes; ++i) {
        const estimators::PatchPass pass(tracing, state.transport, {math::RandomKey{1}, i},
                                         state.sides_cd_m2);
        for (const estimators::PixelBlock& block : estimators::blocks_of(tracing.camera.resolution)) {
            const std::vector<estimators::Pixel> places = pixels_of(block);
            estimators::Tally values(places.size());
            pass.sample(block, values);
            for (std::size_t k = 0; k < places.size(); ++k) {
                const std::size_t pixel =
                    static_cast<std::size_t>(places[k].y) * row + static_cast<std::size_t>(places[k].x);
                estimators::add_to(picture.rgb_cd_m2[pixel], values.sum[k] * (1. / passes));
            }
        }
    }
    return picture;
}

void reproduce_scene(std::string_view lights, const std::filesystem::path& directory) {
    const io::SceneFile file = furnished_room(lights);
    const rays::RayCaster caster(file.scene);
    const transport::LightSampler lights_of_scene(file.scene, caster);
    const estimators::PictureTracing tracing({.scene = file.scene,
                                              .caster = caster,
                                              .max_reflections = transport::kUnlimited,
                                              .preparation_key = math::RandomKey{1},
                                              .camera = *file.sensors.front().camera()},
                                             lights_of_scene);
    const auto look = [&](const ConvergenceState& state) {
        if (!state.method.is_shown || std::ranges::find(kShownSteps, state.steps) == kShownSteps.end())
            return;
        const std::string variant(name_of(state.transport.first_shot.variant()));
        write_picture(picture_of(tracing, state),
                      directory / fmt::format("first-shot-{}s-{}-{}.png", lights, variant, state.steps),
                      {kExposure});
    };
    const auto curves = converge(tracing, methods_for(lights == "point"), kSteps, kMostTime_s, look);
    write_curves(curves, directory, std::string(lights) + "s");
}

}  // namespace

void reproduce_first_shot(const std::filesystem::path& directory) {
    for (const std::string_view lights : {"point", "panel"}) reproduce_scene(lights, directory);
}

}  // namespace stilb::papers
