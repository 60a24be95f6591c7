#include "papers/first_shot_convergence.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "estimators/patch_light/patch_picture.h"
#include "estimators/patch_light/patch_place.h"
#include "estimators/patch_light/ray_bundle/bundle_iteration.h"
#include "run/clock.h"

namespace stilb {
namespace {

constexpr std::uint64_t kReferenceWalks = 8;
constexpr int kReferenceSteps = 1000;
enum Purpose : std::uint64_t { kReference, kWalk };

/// Pixels that show each side.
std::vector<double> pixels_of_sides(const PictureTracing& tracing, const PatchTransport& transport) {
    std::vector<double> pixels(2 * transport.patches.count());
    const PixelBlock all{0, 0, tracing.camera.resolution[0], tracing.camera.resolution[1]};
    std::vector<SeenPoint> points;
    for (Path& path : tracing.start_paths(pixels_of(all), {RandomKey{1}, 0}).paths) {
        if (tracing.tracer.look_through(path)) points.push_back({path.hit, path.outgoing});
    }
    for (const auto& seen : find_places(transport.patch_caster, points)) {
        if (seen) pixels[seen->side] += 1;
    }
    return pixels;
}

/// What first shot does not store, as from the patches' middles.
void add_not_stored(const PatchTransport& transport, const Vec3& eye, std::vector<Rgb>& sides) {
    for (std::uint32_t side = 0; side < sides.size(); ++side) {
        const Vec3 middle = transport.patches.middle(transport.patches.patch_of(side));
        add_to(sides[side], transport.first_reflected_at(side, middle, {}, normalized(eye - middle)));
    }
}

double difference(const std::vector<Rgb>& sides, const std::vector<Rgb>& reference,
                  const std::vector<double>& pixels) {
    double sum = 0, all = 0;
    for (std::size_t side = 0; side < pixels.size(); ++side) {
        if (pixels[side] == 0) continue;
        const double expected = spectrum_of(reference[side]).luminance();
        sum += pixels[side] * std::abs(spectrum_of(sides[side]).luminance() - expected);
        all += pixels[side] * expected;
    }
    return sum / all;
}

std::vector<Rgb> reference_of(const PatchTransport& transport, const SeenSides& seen) {
    std::array<std::vector<Rgb>, kReferenceWalks> sums;
    tbb::parallel_for(std::uint64_t{0}, kReferenceWalks, [&](std::uint64_t walk) {
        sums[walk].resize(seen.count());
        BundleIteration iteration(transport, RandomKey{kReference}.derived(walk));
        for (std::uint64_t i = 0; i < first_steps(transport); ++i) iteration.step();
        for (int step = 0; step < kReferenceSteps; ++step) {
            iteration.step();
            seen.add(iteration, sums[walk]);
        }
    });
    for (std::size_t walk = 1; walk < sums.size(); ++walk) add_to(sums[0], sums[walk]);
    return seen.mean_cd_m2(sums[0], double{kReferenceWalks} * kReferenceSteps);
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

std::vector<ConvergenceCurve> converge(const PictureTracing& tracing,
                                       const std::vector<ConvergenceMethod>& methods, int steps,
                                       double most_time_s,
                                       const std::function<void(const ConvergenceState&)>& look) {
    const PatchTransport best(tracing.scene, tracing.caster, {});
    const Vec3& eye = tracing.view.position();
    const std::vector<double> pixels = pixels_of_sides(tracing, best);
    const std::vector<Rgb> reference = reference_of(best, SeenSides(best, eye));
    std::vector<ConvergenceCurve> curves;
    for (const ConvergenceMethod& method : methods) {
        ConvergenceCurve curve{method.name, {}};
        const PatchTransport transport(tracing.scene, tracing.caster, method.options);
        const Clock clock;
        BundleIteration iteration(transport, RandomKey{kWalk});
        const SeenSides seen(transport, eye);
        std::vector<Rgb> sums(seen.count()), not_stored(seen.count());
        add_not_stored(transport, eye, not_stored);
        double looking_s = 0;
        for (int step = 1; step <= steps; ++step) {
            iteration.step();
            seen.add(iteration, sums);
            if (!is_looked_at(step, steps)) continue;
            const double elapsed_s = clock.elapsed_s() - looking_s;
            const ConvergenceState state{method, transport, step, seen.mean_cd_m2(sums, step)};
            std::vector<Rgb> sides = state.sides_cd_m2;
            add_to(sides, not_stored);
            curve.points.push_back({static_cast<double>(step), transport.first_shot.set_up_s() + elapsed_s,
                                    difference(sides, reference, pixels)});
            if (elapsed_s > most_time_s) break;
            look(state);
            looking_s = clock.elapsed_s() - elapsed_s;
        }
        curves.push_back(std::move(curve));
    }
    return curves;
}

}  // namespace stilb
