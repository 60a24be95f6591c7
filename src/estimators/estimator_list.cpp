
#include "estimators/estimator_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "stilb/error.h"
#include "stilb/options.h"

namespace stilb::estimators {

namespace {

constexpr std::array<std::string_view, 6> kBundleOptions{"patch",      "first-shot", "window",
                                                         "resolution", "visibility", "directions"};
constexpr std::span kFirstShotOptions = std::span(kBundleOptions).first<5>();
constexpr std::span kParticlesOptions = std::span(kBundleOptions).first<1>();

constexpr std::string_view kLightPath = "a path of light from a lamp, which all readings share";

}  // namespace

std::span<const EstimatorEntry> estimator_list() {
    static constexpr std::array list{
        EstimatorEntry{
            .name = "auto",
            .summary =
                "local estimation and path tracing, weighted at every point: unbiased, finite variance",
            .make = make_auto,
            .samples = "samples",
            .sample = "that of the technique that it chooses"},
        EstimatorEntry{
            .name = "local",
            .summary = "local estimation as published: fast, but with infinite variance in corners",
            .make = make_local,
            .measures_luminance = false,
            .has_heavy_tails = true,
            .samples = "light paths",
            .sample = kLightPath},
        EstimatorEntry{.name = "double-local",
                       .summary =
                           "local estimation of luminance at the surfaces seen; without light that "
                           "leaves a point source, meets a mirror or glass first and reaches them by a "
                           "mirror or glass",
                       .make = make_double_local,
                       .has_heavy_tails = true,
                       .samples = "light paths",
                       .sample = kLightPath},
        EstimatorEntry{.name = "path",
                       .summary = "path tracing from every point with next-event estimation: the reference "
                                  "method; unbiased unless first shot replaces small lights",
                       .make = make_path,
                       .sample = "a path from every reading",
                       .patch_options = kFirstShotOptions},
        EstimatorEntry{.name = "ray-bundle",
                       .summary = "stochastic iteration with bundles of parallel rays and first shot over "
                                  "patches: the whole scene at once, biased by the size of the patches",
                       .make = make_ray_bundle,
                       .lights_patches = true,
                       .samples = "steps",
                       .sample = "a step of the iteration, in which every patch emits once",
                       .patch_options = kBundleOptions},
        EstimatorEntry{.name = "radiosity",
                       .summary = "progressive shooting between patches until convergence, for diffuse "
                                  "scenes: a baseline, biased by the size of the patches",
                       .make = make_radiosity,
                       .lights_patches = true,
                       .samples = "samples",
                       .sample = "a path from every reading to the patches",
                       .patch_options = kFirstShotOptions},
        EstimatorEntry{.name = "particles",
                       .summary = "light particles counted on patches, for diffuse scenes: a baseline, "
                                  "biased by the size of the patches",
                       .make = make_particles,
                       .lights_patches = true,
                       .samples = "particles",
                       .sample = "a particle from a lamp, until it is absorbed",
                       .patch_options = kParticlesOptions},
        EstimatorEntry{.name = "light-paths",
                       .summary = "local estimation balanced with path tracing",
                       .make = make_balanced,
                       .samples = "light paths",
                       .sample = kLightPath,
                       .is_technique = true},
        EstimatorEntry{.name = "guided",
                       .summary = "the same by a guess of the light, where reflections have no limit",
                       .make = make_guided,
                       .samples = "samples",
                       .sample = "a ray from every reading, with a share of the light that the guess lacks",
                       .is_technique = true},
    };
    return list;
}

std::vector<EstimatorEntry> unbiased_estimators() {
    std::vector<EstimatorEntry> entries;
    std::ranges::copy_if(estimator_list(), std::back_inserter(entries), [](const EstimatorEntry& entry) {
        return !entry.lights_patches && !entry.is_technique;
    });
    return entries;
}

std::vector<std::string_view> luminance_methods() {
    std::vector<std::string_view> names;
    for (const EstimatorEntry& entry : estimator_list()) {
        if (entry.measures_luminance && !entry.is_technique) names.push_back(entry.name);
    }
    return names;
}

const EstimatorEntry& find_estimator(std::string_view name) {
    const std::span<const std::string_view> names = api::method_names();
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return estimator_list()[static_cast<std::size_t>(found - names.begin())];
    throw InputError(fmt::format("unknown method \"{}\".{} Methods: {}.", name, did_you_mean(name, names),
                                 fmt::join(names, ", ")));
}

}  // namespace stilb::estimators

namespace stilb::api {

std::span<const std::string_view> method_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> all;
        for (const estimators::EstimatorEntry& entry : estimators::estimator_list())
            all.push_back(entry.name);
        return all;
    }();
    return names;
}

}  // namespace stilb::api
