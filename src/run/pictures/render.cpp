#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "base/parallel.h"
#include "estimators/estimator_list.h"
#include "estimators/patch_light/solution/solution_picture.h"
#include "run/level_of_detail.h"
#include "run/pictures/passes.h"
#include "run/pictures/picture_comparison.h"
#include "run/readings/division.h"
#include "run/run.h"
#include "run/schedule.h"
#include "run/streams.h"
#include "statistics/interval.h"
#include "stilb/error.h"

namespace stilb::run {
namespace {

/// Replicates of a picture. The fewer there are, the more evenly lie the low-discrepancy points of each; four
/// suffice where neighbours help to estimate the errors.
constexpr std::uint64_t kPictureReplicates = 4, kPatchPictureReplicates = 8;
constexpr double kDefaultTime_s = 60;
/// Passes for smooth edges.
constexpr std::uint64_t kSmoothingPasses = 16;
constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();

void add_geometry(const Camera& camera, const rays::RayCaster& caster, RenderResult& result) {
    const sensors::CameraView view(camera);
    const auto width = static_cast<std::size_t>(camera.resolution[0]);
    const auto height = static_cast<std::size_t>(camera.resolution[1]);
    result.normals.resize(width * height, {kNoValue, kNoValue, kNoValue});
    result.depth_m.resize(width * height, kNoValue);
    parallel_for(height, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            const auto direction =
                view.direction_at(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
            const auto hit = direction ? caster.closest(view.position(), *direction) : std::nullopt;
            if (!hit) continue;
            const Vec3& n = hit->normal;
            result.normals[y * width + x] = {static_cast<float>(n.x), static_cast<float>(n.y),
                                             static_cast<float>(n.z)};
            result.depth_m[y * width + x] = static_cast<float>(hit->distance_m);
        }
    });
}

void add_means(const std::vector<bool>& blind, RenderResult& result) {
    double luminance = 0, error = 0, pixels = 0;
    auto& [rgb_cd_m2, standard_error_cd_m2, layers_cd_m2] = result.pixels;
    for (std::size_t i = 0; i < blind.size(); ++i) {
        if (blind[i]) {
            rgb_cd_m2[i] = {kNoValue, kNoValue, kNoValue};
            for (auto& layer : layers_cd_m2) layer[i] = {kNoValue, kNoValue, kNoValue};
            if (!standard_error_cd_m2.empty()) standard_error_cd_m2[i] = kNoValue;
            continue;
        }
        const auto& [r, g, b] = rgb_cd_m2[i];
        luminance += Rgb{{r, g, b}}.luminance();
        if (!standard_error_cd_m2.empty()) error += standard_error_cd_m2[i];
        ++pixels;
    }
    result.mean_luminance_cd_m2 = luminance / pixels;
    result.mean_standard_error_cd_m2 =
        standard_error_cd_m2.empty() ? std::numeric_limits<double>::infinity() : error / pixels;
}

/// The options with defaults for a picture without targets.
RunOptions with_picture_target(RunOptions options) {
    if (!options.error && !options.time_s && !options.paths) options.time_s = kDefaultTime_s;
    if (options.paths) options.paths = std::max<std::uint64_t>(*options.paths, 2);
    return options;
}

/// The method of a picture.
struct PictureMethod {
    std::function<std::unique_ptr<estimators::Estimator>(const estimators::Problem&)> make;
    std::uint64_t replicates = kPictureReplicates;
    bool lights_patches = false;

    RunPlan plan(std::string_view technique, std::uint64_t seed) const {
        return {std::string(technique), seed, replicates, !lights_patches, !lights_patches};
    }
};

/// Warns where the patches' error is much of the whole.
void add_patch_error(const PictureComparison::Bias& bias, RenderResult& result) {
    constexpr double much = 0.5;
    result.patch_error = bias.at_most;
    if (kBiasesOfMostPixels * bias.at_most <= much * result.attained_error) return;
    result.warnings.emplace_back(
        WarningKind::patches,
        fmt::format(
            "path tracing through some pixels differs by up to {:.2g} % (root mean square) from this "
            "picture, whose light is stored on patches. The stated error of the pixels includes this, "
            "their standard errors do not. Choose smaller patches, or method auto, which needs none.",
            100 * bias.at_most));
}

/// The layers of a picture are what "by" asks for. Throws InputError where the method keeps light together.
LightDivision picture_division(const Scene& scene, const RunOptions& options, bool lights_patches) {
    RunOptions own = options;
    own.light_scenes.clear();
    LightDivision division(scene, own);
    if (division.channels() && lights_patches) {
        throw InputError(
            fmt::format("by: method {} with its patches keeps the light of lamps and of bounces together. "
                        "Pictures with layers: path, "
                        "light-paths, guided, auto.",
                        options.method));
    }
    return division;
}

/// Begins a picture, or continues one whose sums have a plan. `options`: `asked` with defaults. A part of a
/// run has no pixels.
RenderResult render_by(const PictureMethod& method, const PreparedScene& scene, const Sensor& sensor,
                       const RunOptions& asked, const RunOptions& options, PictureSink* sink,
                       const std::atomic<bool>* interrupt, PictureSums& sums, RunPart part = {}) {
    const Camera& camera = *sensor.camera();
    Session session(scene, {&sensor, 1}, asked, options, sink, interrupt);
    std::vector<Warning> of_scene = session.scene_warnings({&sensor, 1});
    const std::vector<bool> blind = sensors::blind_pixels(camera);
    const LightDivision division = picture_division(scene.scene(), options, method.lights_patches);
    RenderResult result;
    session.on_threads([&] {
        estimators::Problem problem = session.problem();
        problem.camera = camera;
        problem.channels = division.channels();
        const auto estimator = method.make(problem);
        add_geometry(camera, session.caster(), result);  // before the samples, so that it counts in the time
        std::optional<PictureComparison> comparison;
        if (method.lights_patches)
            comparison.emplace(problem, blind,
                               math::KeyOf<PictureComparison::Stream>{
                                   key_of_seed(options.seed).derived(RunStream::picture_comparison)});
        const auto begin = [&](RunPlan plan) {
            return PictureSums(camera.resolution, std::move(plan), division.count());
        };
        const auto passes_of = [&](PictureSums& own, RunPart replicates) {
            return std::make_unique<Passes>(*estimator, blind, own, sink, session.monitor(),
                                            comparison ? &*comparison : nullptr, replicates);
        };
        if (sums.plan().technique.empty()) sums = begin(method.plan(estimator->technique(), options.seed));
        if (sums.resolution() != camera.resolution || sums.layers() != division.count())
            throw std::invalid_argument(
                "the sums are those of a picture of another size, or with other layers");
        if (part.of > 1 && !sums.plan().is_complete()) {
            PictureSums first = begin(sums.plan());
            passes_of(first, {})->complete_plan(options.paths.value());
            if (first.paces()) sums = begin(first.plan());
        }
        const std::unique_ptr<Passes> passes = passes_of(sums, part);
        session.run(*passes, result);
        session.describe(*estimator, result);
        if (part.of > 1) return;
        result.replicates = static_cast<int>(sums.replicates());
        result.pixels = sums.pixels();
        for (const LightDivision::Part& share : division.shares()) result.layers.push_back(share.name);
        if (division.count() == 0 && !result.layers.empty())
            result.pixels.layers_cd_m2 = {result.pixels.rgb_cd_m2};
        result.samples_per_pixel = sums.samples_per_pixel(blind);
        add_means(blind, result);
        if (comparison) add_patch_error(passes->bias(), result);
    });
    std::ranges::move(of_scene, std::back_inserter(result.warnings));
    session.finish(result);
    return result;
}

/// Begins or continues a picture, or a part of it, by the method of the options or of the sums.
RenderResult render_picture(const PreparedScene& scene, const Sensor& camera, const RunOptions& asked_options,
                            RunPart part, PictureSink* sink, const std::atomic<bool>* interrupt,
                            PictureSums& sums, Samples samples = Samples::as_asked) {
    if (has_levels_of_detail(scene.scene())) {
        DetailedScene detailed = with_levels_of_detail(scene.scene(), {&camera, 1});
        RenderResult result =
            render_picture(detailed.scene, camera, asked_options, part, sink, interrupt, sums, samples);
        result.levels_of_detail = std::move(detailed.levels);
        return result;
    }
    require_valid(asked_options);
    const bool begins = sums.plan().technique.empty();
    const estimators::EstimatorEntry& method =
        estimators::find_estimator(begins ? asked_options.method : sums.plan().technique);
    RunOptions options = with_picture_target(asked_options);
    if (!begins) options.seed = sums.plan().seed;
    if (samples == Samples::no_more)
        options.paths = 0;  // there are as many
    else if (sums.seeds().size() > 1)
        throw std::invalid_argument("the sums are of several seeds, and cannot be continued");
    if (!method.measures_luminance) {
        throw InputError(fmt::format("method {} measures illuminance only. Pictures: {}.", method.name,
                                     fmt::join(estimators::luminance_methods(), ", ")));
    }
    const std::uint64_t replicates = method.lights_patches ? kPatchPictureReplicates : kPictureReplicates;
    if (part.of > replicates) {
        throw InputError(
            fmt::format("{} parts: a picture by method {} has {} replicates, so that it comes apart into at "
                        "most as many. For more machines give each a seed of its own, and merge their "
                        "states.",
                        part.of, method.name, replicates));
    }
    RenderResult result = render_by({method.make, replicates, method.lights_patches}, scene, camera,
                                    asked_options, options, sink, interrupt, sums, part);
    if (method.has_heavy_tails) {
        result.warnings.emplace_back(
            WarningKind::method,
            fmt::format("method {} has infinite variance in corners: the standard errors of pixels there are "
                        "unreliable. Use method "
                        "auto.",
                        method.name));
    }
    return result;
}

}  // namespace

RenderResult render(const PreparedScene& scene, const Sensor& camera, const RunOptions& options,
                    PictureSink* sink, const std::atomic<bool>* interrupt, PictureSums* state) {
    PictureSums own;
    return render_picture(scene, camera, options, {}, sink, interrupt, state ? *state : own);
}

RunSummary render_part(const PreparedScene& scene, const Sensor& camera, const RunOptions& options,
                       RunPart part, PictureSums& state, PictureSink* sink,
                       const std::atomic<bool>* interrupt) {
    require_part(options, part);
    return render_picture(scene, camera, options, part, sink, interrupt, state);
}

RenderResult result_of(const PreparedScene& scene, const Sensor& camera, const RunOptions& options,
                       PictureSums& state, const std::atomic<bool>* interrupt) {
    const std::uint64_t begun = state.replicates(), all = state.plan().replicates;
    if (begun < std::min<std::uint64_t>(all, options.paths.value_or(all))) {
        throw InputError(fmt::format(
            "only {} of the {} replicates of the picture have passes: merge all of its parts.", begun, all));
    }
    RunOptions without_limit = options;
    without_limit.time_s.reset();
    return render_picture(scene, camera, without_limit, {}, nullptr, interrupt, state, Samples::no_more);
}

RenderResult render_solution(const Scene& scene, const Sensor& camera, estimators::PatchSolution solution,
                             std::span<const LightFactor> factors, int threads, PictureSink* sink,
                             const std::atomic<bool>* interrupt) {
    require_consistency(solution, scene);
    const std::vector<Rgb> of_groups = scene::factors_of_groups(factors, solution.groups);
    const Scene relit_scene = scene::relit(scene, scene::light_groups(scene), of_groups);
    solution = relit(std::move(solution), of_groups);
    const std::uint64_t replicates = solution.replicates.size();
    RunOptions options;
    options.method = "solution";
    options.threads = threads;
    options.paths = std::max(kSmoothingPasses / replicates, std::uint64_t{1}) * replicates;
    PictureSums sums;
    return render_by({[&](const estimators::Problem& problem) {
                          return make_solution_picture(problem, std::move(solution));
                      },
                      replicates, true},
                     relit_scene, camera, options, options, sink, interrupt, sums);
}

}  // namespace stilb::run
