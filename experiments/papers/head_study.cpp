#include "papers/head_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <span>
#include <utility>

#include "fit/outward.h"
#include "geometry/harmonics/surface.h"
#include "math/spherical_harmonics.h"
#include "papers/head_in_room.h"
#include "rays/ray_caster.h"
#include "run/schedule.h"
#include "stilb/error.h"

namespace stilb::papers {
namespace {

constexpr int kPaperDegree = 32;

cli::FitReport fit_report_of(const Mesh& mesh, const std::string& name, int degree) {
    cli::FitReport report;
    report.mesh = name;
    report.faces = mesh.triangles.size();
    report.vertices = mesh.vertices.size();
    const run::Clock clock;
    report.fit =
        fit::fit_mesh(mesh, {.degree = degree, .otherwise = fit::NotStarShaped::take_outermost}, name);
    report.elapsed_s = clock.elapsed_s();
    return report;
}

/// The series cut off at a degree.
Harmonics series_of(const fit::MeshFit& fit, int degree, const std::string& name) {
    try {
        const std::span<const double> all(fit.coefficients);
        Harmonics series(
            geometry::HarmonicSurface(math::HarmonicSeries<double>(all.first(math::harmonic_count(degree)))));
        series.center = fit.center;
        return series;
    } catch (const InputError& error) {
        throw InputError(fmt::format("the series of degree {} is no surface: {}", degree, error.what()),
                         {name});
    }
}

/// Of all threads: unlike the time that passes, it hardly depends on what else the machine does.
double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double set_up_s(const Scene& scene) {
    const double start_s = processor_s();
    const rays::RayCaster caster(scene);
    return processor_s() - start_s;
}

void render_round(const Scene& scene, const RunOptions& options, PictureSink* progress, RenderedHead& head) {
    head.set_up_s = std::min(head.set_up_s, set_up_s(scene));
    const double start_s = processor_s();
    head.rounds.push_back(render(scene, head.view, options, progress));
    head.processor_s = std::min(head.processor_s, processor_s() - start_s);
}

/// All scenes in turn, round by round, so that what slows the machine down for a while meets all of them.
std::vector<RenderedHead> render_in_turn(const std::vector<Scene>& scenes, const Sensor& view,
                                         const HeadStudyOptions& options, PictureSink* progress) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<RenderedHead> heads(scenes.size(), {view, {}, infinity, infinity});
    for (int round = 0; round < options.rounds; ++round) {
        RunOptions run;
        run.paths = options.passes;
        run.seed = static_cast<std::uint64_t>(round) + 1;
        for (std::size_t i = 0; i < scenes.size(); ++i) render_round(scenes[i], run, progress, heads[i]);
    }
    return heads;
}

double luminance_cd_m2(const RenderResult& picture, std::size_t pixel) {
    const auto& [red, green, blue] = picture.pixels.rgb_cd_m2[pixel];
    return Rgb{{red, green, blue}}.luminance();
}

/// The rounds' differences have the same noise each. So half the difference between the means of even and of
/// odd rounds, in which all but the noise cancels, is as large as what noise is left in the mean of all.
void compare(const RenderedHead& mesh, const std::vector<HeadPoint>& points, HeadSeries& series) {
    const auto rounds = static_cast<double>(mesh.rounds.size());
    double luminance = 0, differences = 0, noise = 0;
    for (const HeadPoint& point : points) {
        double sum = 0, alternating = 0;
        for (std::size_t round = 0; round < mesh.rounds.size(); ++round) {
            const double expected = luminance_cd_m2(mesh.rounds[round], point.pixel);
            const double difference = luminance_cd_m2(series.rendered.rounds[round], point.pixel) - expected;
            luminance += expected / rounds;
            sum += difference;
            alternating += round % 2 == 0 ? difference : -difference;
        }
        differences += std::abs(sum) / rounds;
        noise += std::abs(alternating) / rounds;
    }
    series.luminance_difference = differences / luminance;
    series.noise = noise / luminance;
}

double normal_error_rad(const std::vector<HeadPoint>& points, const Harmonics& series) {
    double squares = 0;
    for (const HeadPoint& point : points) {
        const Vec3 normal = series.normal_towards(point.position - series.center);
        squares += std::pow(std::acos(std::clamp(dot(normal, point.smooth_normal), -1., 1.)), 2);
    }
    return std::sqrt(squares / static_cast<double>(points.size()));
}

void study_series(const std::vector<Scene>& scenes, const HeadStudyOptions& options, PictureSink* progress,
                  HeadStudy& study) {
    const Sensor view = view_of_head(options.resolution);
    const std::vector<HeadPoint> points = visible_points(scenes.front(), *view.camera());
    study.head_share = static_cast<double>(points.size()) / (options.resolution[0] * options.resolution[1]);
    std::vector<RenderedHead> heads = render_in_turn(scenes, view, options, progress);
    study.mesh = std::move(heads.front());
    for (std::size_t i = 0; i < options.degrees.size(); ++i) {
        HeadSeries series{options.degrees[i], std::move(heads[i + 1])};
        compare(study.mesh, points, series);
        series.normal_error_rad =
            normal_error_rad(points, std::get<Harmonics>(scenes[i + 1].objects.back().shape));
        study.series.push_back(std::move(series));
    }
}

void study_room(const Scene& with_mesh, const Scene& with_series, const HeadStudyOptions& options,
                PictureSink* progress, HeadStudy& study) {
    std::vector<RenderedHead> heads =
        render_in_turn({with_mesh, with_series}, view_of_room(options.room_resolution), options, progress);
    study.room_with_mesh = std::move(heads[0]);
    study.room_with_series = std::move(heads[1]);
}

}  // namespace

HeadStudy study_head(const Mesh& head, const std::string& name, const HeadStudyOptions& options,
                     PictureSink* progress) {
    const Mesh mesh = placed_in_room(fit::outward(head).mesh);
    HeadStudy study;
    study.report = fit_report_of(mesh, name, options.degrees.back());
    std::vector<Scene> scenes{room_with(mesh)};
    std::size_t shown = 0;
    for (const int degree : options.degrees) {
        if (degree <= kPaperDegree) shown = scenes.size(), study.room_degree = degree;
        scenes.push_back(room_with(series_of(study.report.fit, degree, name)));
    }
    study_series(scenes, options, progress, study);
    study_room(scenes[0], scenes[shown], options, progress, study);
    return study;
}

}  // namespace stilb::papers
