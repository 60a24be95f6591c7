#include "papers/first_shot_convergence.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "base/parallel.h"
#include "estimators/patch_light/patch_readings.h"
#include "estimators/patch_light/patch_transport.h"
#include "estimators/patch_light/ray_bundle/bundle_iteration.h"
#include "run/schedule.h"

namespace stilb::papers {
namespace {

constexpr std::uint64_t kReferenceWalks = 8;
enum Purpose : std::uint64_t { kReference, kWalk };

/// Pixels that show each side.
std::vector<double> pixels_of_sides(const estimators::PictureTracing& tracing,
                                    const estimators::PatchTransport& transport) {
    std::vector<double> pixels(2 * transport.patches.count());
    const estimators::PixelBlock all{0, 0, tracing.camera.resolution[0], tracing.camera.resolution[1]};
    std::vector<estimators::ViewedHit> points;
    for (transport::Path& path : tracing.start_paths(pixels_of(all), {math::RandomKey{1}, 0}).paths) {
        if (tracing.tracer.follow_to_scattering(path)) points.push_back({path.hit, path.outgoing});
    }
    for (const auto& seen : find_patch_locations(transport.patch_caster, points)) {
        if (seen) pixels[seen->side] += 1;
    }
    return pixels;
}

/// What first shot does not store, as from the patches' middles.
void add_not_stored(const estimators::PatchTransport& transport, const Vec3& eye,
                    std::vector<estimators::FloatRgb>& sides) {
    for (std::uint32_t side = 0; side < sides.size(); ++side) {
        const Vec3 middle = transport.patches.middle(transport.patches.patch_of(side));
        estimators::add_to(sides[side],
                           transport.first_reflected_at(side, middle, {}, normalized(eye - middle)));
    }
}

double difference(const std::vector<estimators::FloatRgb>& sides,
                  const std::vector<estimators::FloatRgb>& reference, const std::vector<double>& pixels) {
    double sum = 0, all = 0;
    for (std::size_t side = 0; side < pixels.size(); ++side) {
        if (pixels[side] == 0) continue;
        const double expected = estimators::to_rgb(reference[side]).luminance();
        sum += pixels[side] * std::abs(estimators::to_rgb(sides[side]).luminance() - expected);
        all += pixels[side] * expected;
    }
    return sum / all;
}

std::vector<estimators::FloatRgb> reference_of(const estimators::PatchTransport& transport,
                                               const estimators::VisibleSides& seen, int steps) {
    std::array<std::vector<estimators::FloatRgb>, kReferenceWalks> sums;
    parallel_for(kReferenceWalks, [&](std::uint64_t walk) {
        sums[walk].resize(seen.count());
        estimators::BundleIteration iteration(transport, {math::RandomKey{kReference}.derived(walk)});
        for (std::uint64_t i = 0; i < first_steps(transport); ++i) iteration.step();
        for (int step = 0; step < steps; ++step) {
            iteration.step();
            seen.add(iteration, sums[walk]);
        }
    });
    for (std::size_t walk = 1; walk < sums.size(); ++walk) estimators::add_to(sums[0], sums[walk]);
    return seen.mean_cd_m2(sums[0], double{kReferenceWalks} * steps);
}

/// 1, 2, 3, 5, 7, 10 ... and the last.
bool is_looked_at(int step, int last) {
    int digits = step;
    while (digits >= 100 && digits % 10 == 0) digits /= 10;
    const bool round = digits == 1 || digits == 2 || digits == 3 || digits == 5 || digits == 7 ||
                       digits == 10 || digits == 20 || digits == 30 || digits == 50 || digits == 70;
    return round || step == last;
}

}  // namespace

std::vector<ConvergenceCurve> converge(const estimators::PictureTracing& tracing,
                                       const std::vector<ConvergenceMethod>& methods, int steps,
                                       double most_time_s,
                                       const std::function<void(const ConvergenceState&)>& look) {
    estimators::PatchOptions of_reference;
    of_reference.patch_m = methods.front().options.patch_m;
    for (const ConvergenceMethod& method : methods) {
        if (method.options.patch_m != of_reference.patch_m)
            throw std::invalid_argument("methods with patches of different sizes have no common reference");
    }
    const estimators::PatchTransport best(tracing.scene, tracing.caster, of_reference);
    const Vec3& eye = tracing.view.position();
    const std::vector<double> pixels = pixels_of_sides(tracing, best);
    const std::vector<estimators::FloatRgb> reference =
        reference_of(best, estimators::VisibleSides(best, eye), steps);
    std::vector<ConvergenceCurve> curves;
    for (const ConvergenceMethod& method : methods) {
        ConvergenceCurve curve{method.name, {}};
        const estimators::PatchTransport transport(tracing.scene, tracing.caster, method.options);
        const run::Clock clock;
        estimators::BundleIteration iteration(transport, {math::RandomKey{kWalk}});
        const estimators::VisibleSides seen(transport, eye);
        std::vector<estimators::FloatRgb> sums(seen.count()), not_stored(seen.count());
        add_not_stored(transport, eye, not_stored);
        double looking_s = 0;
        for (int step = 1; step <= steps; ++step) {
            iteration.step();
            seen.add(iteration, sums);
            if (!is_looked_at(step, steps)) continue;
            const double elapsed_s = clock.elapsed_s() - looking_s;
            const ConvergenceState state{method, transport, step, seen.mean_cd_m2(sums, step)};
            std::vector<estimators::FloatRgb> sides = state.sides_cd_m2;
            estimators::add_to(sides, not_stored);
            curve.points.push_back({static_cast<double>(step), transport.first_shot.set_up_s() + elapsed_s,
                                    difference(sides, reference, pixels)});
            look(state);
            if (!method.is_shown && elapsed_s > most_time_s) break;
            looking_s = clock.elapsed_s() - elapsed_s;
        }
        curves.push_back(std::move(curve));
    }
    return curves;
}

}  // namespace stilb::papers
