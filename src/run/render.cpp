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
#include "math/random.h"
#include "run/level_of_detail.h"
#include "run/picture_comparison.h"
#include "run/picture_sums.h"
#include "run/run.h"
#include "run/schedule.h"
#include "statistics/interval.h"
#include "stilb/error.h"

namespace stilb::run {
namespace {

/// Replicates of a picture. The fewer there are, the more evenly lie the low-discrepancy points of each; four
/// suffice where neighbours help to estimate the errors.
constexpr std::uint64_t kPictureReplicates = 4, kPatchPictureReplicates = 8;
constexpr double kDefaultTime_s = 60;
/// 95 % of the pixels have a bias of less than about twice the root mean square.
constexpr double kBiasesOfMostPixels = 2;
/// Passes for smooth edges.
constexpr std::uint64_t kSmoothingPasses = 16;
enum PicturePurpose : std::uint64_t {
    kPicturePreparation,
    kPictureSamples,
    kPictureOffset,
    kPictureComparison
};

constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();

/// The number of pixels outside of the camera's field.
std::vector<bool> blind_pixels(const Camera& camera) {
    const sensors::CameraView view(camera);
    std::vector<bool> blind;
    for (int y = 0; y < camera.resolution[1]; ++y) {
        for (int x = 0; x < camera.resolution[0]; ++x) blind.push_back(!view.direction_at(x + 0.5, y + 0.5));
    }
    return blind;
}

/// A picture that accumulates one pass after another over all blocks.
class Passes final : public Work {
  public:
    /// `sink` may be null, and `comparison`, for methods without patches.
    Passes(const estimators::Estimator& estimator, const Camera& camera, const std::vector<bool>& blind,
           PictureSums sums, std::uint64_t seed, PictureSink* sink, const Monitor& monitor,
           const PictureComparison* comparison)
        : estimator_(estimator),
          comparison_(comparison),
          monitor_(monitor),
          blind_(blind),
          sink_(sink),
          resolution_(camera.resolution),
          width_(static_cast<std::size_t>(camera.resolution[0])),
          key_(math::RandomKey{seed}.derived(kPictureSamples)),
          offset_key_(math::RandomKey{seed}.derived(kPictureOffset)),
          pixels_(width_ * static_cast<std::size_t>(camera.resolution[1])),
          sums_(std::move(sums)) {}

    const PictureSums& sums() const { return sums_; }
    std::uint64_t samples() const override { return sums_.passes(); }
    std::uint64_t samples_in_all() const override { return sums_.passes(); }
    std::uint64_t samples_for(std::uint64_t paths) const override { return paths; }
    std::uint64_t most_samples() const override { return std::numeric_limits<std::uint64_t>::max(); }
    /// There is no error without two replicates.
    bool has_result() const override { return sums_.passes() >= 2; }
    /// After 1, 2, 3, 4, 6, 8, 12 ... passes of each replicate.
    std::uint64_t next_check() const override {
        const std::uint64_t replicates = sums_.all_replicates();
        return replicates * statistics::next_check(sums_.passes() / replicates, 1);
    }
    std::uint64_t most_at_once() const override { return 1; }
    double attained_error() const override {
        return sums_.attained_error(blind_) + kBiasesOfMostPixels * bias().at_most;
    }
    bool is_beyond_reach(double error) const override {
        return kBiasesOfMostPixels * bias().at_least > error;
    }
    /// That of the patches; 0 for other methods.
    PictureComparison::Bias bias() const {
        if (!comparison_) return {};
        return comparison_->bias_of([&](std::size_t pixel) {
            return PictureComparison::Shown{sums_.luminance_cd_m2(pixel),
                                            sums_.own_standard_error_cd_m2(pixel)};
        });
    }
    void show() override {
        if (sink_ && sink_->wants_picture()) sink_->show(sums_.pixels());
    }

    void advance(std::uint64_t) override {
        const std::uint64_t p = sums_.passes(), replicates = sums_.all_replicates();
        const estimators::Pass pass{key_.derived(p % replicates), p / replicates, p % replicates};
        const std::vector<estimators::PixelBlock> blocks = estimators::blocks_of(resolution_, offset_of(p));
        const auto started = estimator_.start(pass);
        parallel_for(blocks.size(), [&](std::size_t b) {
            monitor_.require_more();
            sample(blocks[b], *started);
        });
        sums_.add(pixels_);
        const double all = static_cast<double>(sums_.passes()) * static_cast<double>(pixels_.size());
        require_mostly_finite(invalid_, all);
    }

  private:
    /// Blocks have another offset in every pass, so that their edges do not show.
    std::array<int, 2> offset_of(std::uint64_t pass) const {
        const auto [u, v] = math::SampleStream(offset_key_, pass).next_two();
        return {1 + static_cast<int>(u * estimators::kBlockSize),
                1 + static_cast<int>(v * estimators::kBlockSize)};
    }

    void sample(const estimators::PixelBlock& block, const estimators::PicturePass& pass) {
        std::array<Rgb, std::size_t{estimators::kBlockSize} * estimators::kBlockSize> samples;
        const std::size_t count =
            static_cast<std::size_t>(block.width) * static_cast<std::size_t>(block.height);
        invalid_ += pass.sample(block, {samples.data(), count});
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t x =
                static_cast<std::size_t>(block.left) + i % static_cast<std::size_t>(block.width);
            const std::size_t y =
                static_cast<std::size_t>(block.top) + i / static_cast<std::size_t>(block.width);
            for (std::size_t b = 0; b < kBands; ++b) {
                pixels_[y * width_ + x][b] = static_cast<float>(samples[i][b]);
            }
        }
    }

    const estimators::Estimator& estimator_;
    const PictureComparison* comparison_;
    const Monitor& monitor_;
    const std::vector<bool>& blind_;
    PictureSink* sink_;
    std::array<int, 2> resolution_;
    std::size_t width_;
    math::RandomKey key_, offset_key_;
    std::vector<std::array<float, 3>> pixels_;  ///< of the last pass
    PictureSums sums_;
    std::atomic<std::uint64_t> invalid_ = 0;
};

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
    auto& [rgb_cd_m2, standard_error_cd_m2] = result.pixels;
    for (std::size_t i = 0; i < blind.size(); ++i) {
        if (blind[i]) {
            rgb_cd_m2[i] = {kNoValue, kNoValue, kNoValue};
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
};

/// Warns where the patches' error is much of the whole.
void add_patch_error(const PictureComparison::Bias& bias, RenderResult& result) {
    constexpr double much = 0.5;
    result.patch_error = bias.at_most;
    if (kBiasesOfMostPixels * bias.at_most <= much * result.attained_error) return;
    result.warnings.push_back(fmt::format(
        "path tracing through some pixels differs by up to {:.2g} % (root mean square) from this "
        "picture, whose light is stored on patches. The stated error of the pixels includes this, "
        "their standard errors do not. Choose smaller patches, or method auto, which needs none.",
        100 * bias.at_most));
}

/// `options`: `asked` with defaults.
RenderResult render_by(const PictureMethod& method, const Scene& scene, const Sensor& sensor,
                       const RunOptions& asked, const RunOptions& options, PictureSink* sink,
                       const std::atomic<bool>* interrupt) {
    const Camera& camera = *sensor.camera();
    Session session(scene, asked, options, sink, interrupt);
    std::vector<std::string> of_scene = session.scene_warnings({&sensor, 1});
    const std::vector<bool> blind = blind_pixels(camera);
    RenderResult result;
    session.on_threads([&] {
        estimators::Problem problem =
            session.problem(math::RandomKey{options.seed}.derived(kPicturePreparation));
        problem.camera = camera;
        const auto estimator = method.make(problem);
        add_geometry(camera, session.caster(), result);  // before the samples, so that it counts in the time
        std::optional<PictureComparison> comparison;
        if (method.lights_patches)
            comparison.emplace(problem, blind, math::RandomKey{options.seed}.derived(kPictureComparison));
        const auto errors = method.lights_patches ? PictureSums::Errors::own : PictureSums::Errors::pooled;
        Passes passes(*estimator, camera, blind, PictureSums(camera.resolution, method.replicates, errors),
                      options.seed, sink, session.monitor(), comparison ? &*comparison : nullptr);
        session.run(passes, result);
        session.describe(*estimator, result);
        result.replicates = static_cast<int>(passes.sums().replicates());
        result.pixels = passes.sums().pixels();
        add_means(blind, result);
        if (comparison) add_patch_error(passes.bias(), result);
    });
    std::ranges::move(of_scene, std::back_inserter(result.warnings));
    session.finish(result);
    return result;
}

}  // namespace

RenderResult render(const Scene& scene, const Sensor& camera, const RunOptions& asked_options,
                    PictureSink* sink, const std::atomic<bool>* interrupt) {
    if (has_levels_of_detail(scene)) {
        DetailedScene detailed = with_levels_of_detail(scene, {&camera, 1});
        RenderResult result = render(detailed.scene, camera, asked_options, sink, interrupt);
        result.levels_of_detail = std::move(detailed.levels);
        return result;
    }
    require_valid(asked_options);
    const estimators::EstimatorEntry& method = estimators::find_estimator(asked_options.method);
    const RunOptions options = with_picture_target(asked_options);
    if (!method.measures_luminance) {
        throw InputError(fmt::format("method {} measures illuminance only. Pictures: {}.", method.name,
                                     fmt::join(estimators::luminance_methods(), ", ")));
    }
    const std::uint64_t replicates = method.lights_patches ? kPatchPictureReplicates : kPictureReplicates;
    RenderResult result = render_by({method.make, replicates, method.lights_patches}, scene, camera,
                                    asked_options, options, sink, interrupt);
    if (method.has_heavy_tails) {
        result.warnings.push_back(
            fmt::format("method {} has infinite variance in corners: the standard errors of pixels there are "
                        "unreliable. Use method "
                        "auto.",
                        method.name));
    }
    return result;
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
    return render_by({[&](const estimators::Problem& problem) {
                          return make_solution_picture(problem, std::move(solution));
                      },
                      replicates, true},
                     relit_scene, camera, options, options, sink, interrupt);
}

}  // namespace stilb::run
