#include "estimators/estimator_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "base/error.h"
#include "estimators/local/local_estimation.h"
#include "estimators/local/picture_local.h"
#include "estimators/patch_light/particles/particles.h"
#include "estimators/patch_light/radiosity/radiosity.h"
#include "estimators/patch_light/ray_bundle/picture_bundle.h"
#include "estimators/patch_light/ray_bundle/ray_bundle.h"
#include "estimators/path/path.h"
#include "estimators/path/picture_path.h"

namespace stilb::estimators {
namespace {

constexpr std::array<std::string_view, 6> kBundleFlags{"--patch",      "--first-shot", "--window",
                                                       "--resolution", "--visibility", "--directions"};
constexpr std::span kFirstShotFlags = std::span(kBundleFlags).first<5>();
constexpr std::span kParticlesFlags = std::span(kBundleFlags).first<1>();

}  // namespace

std::span<const EstimatorEntry> estimator_list() {
    static constexpr std::array list{
        EstimatorEntry{
            "auto", "local estimation and path tracing, balanced at every point: unbiased, finite variance",
            false, make_auto_estimator, make_auto_picture},
        EstimatorEntry{"local", "local estimation as published: fast, but of infinite variance in corners",
                       true, make_local_estimator, nullptr},
        EstimatorEntry{"double-local",
                       "the same for luminance, of the surfaces that are seen; no light that leaves a point "
                       "source, meets mirror or glass first and comes to them by mirror or glass",
                       true, make_local_estimator, make_local_picture},
        EstimatorEntry{"path",
                       "path tracing from every point with next-event estimation: the naive reference; "
                       "unbiased unless small lights are left to --first-shot",
                       false, make_path_estimator, make_path_picture, false, kFirstShotFlags},
        EstimatorEntry{"ray-bundle",
                       "stochastic iteration with bundles of parallel rays and first shot over patches: the "
                       "whole scene at once, biased by the size of the patches (--patch)",
                       false, make_ray_bundle_estimator, make_ray_bundle_picture, true, kBundleFlags},
        EstimatorEntry{"radiosity",
                       "progressive shooting between patches until nothing is left, for diffuse scenes: a "
                       "baseline, without standard errors and biased by the size of the patches",
                       false, make_radiosity_estimator, make_radiosity_picture, true, kFirstShotFlags, true},
        EstimatorEntry{"particles",
                       "particles of light counted in patches, for diffuse scenes: a baseline, biased by the "
                       "size of the patches",
                       false, make_particles_estimator, make_particles_picture, true, kParticlesFlags},
    };
    return list;
}

std::vector<EstimatorEntry> unbiased_estimators() {
    std::vector<EstimatorEntry> entries;
    std::ranges::copy_if(estimator_list(), std::back_inserter(entries),
                         [](const EstimatorEntry& entry) { return !entry.lights_patches; });
    return entries;
}

std::vector<std::string_view> luminance_methods() {
    std::vector<std::string_view> names;
    for (const EstimatorEntry& entry : estimator_list()) {
        if (entry.measures_luminance()) names.push_back(entry.name);
    }
    return names;
}

const EstimatorEntry& find_estimator(std::string_view name) {
    std::vector<std::string_view> names;
    for (const EstimatorEntry& entry : estimator_list()) {
        if (entry.name == name) return entry;
        names.push_back(entry.name);
    }
    const std::string nearest = nearest_name(name, names);
    throw InputError(fmt::format("unknown method \"{}\".{} Methods: {}.", name,
                                 nearest.empty() ? "" : fmt::format(" Did you mean \"{}\"?", nearest),
                                 fmt::join(names, ", ")));
}

}  // namespace stilb::estimators
