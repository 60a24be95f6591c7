// The one table of all estimators: --help, verify, the agreement tests and the scene reader go by it.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "estimators/estimator.h"

namespace stilb::estimators {

class Estimator;
struct Problem;

/// One method. estimator.h says what it is made for and what it does.
struct EstimatorEntry {
    std::string_view name;
    std::string_view summary;
    std::unique_ptr<Estimator> (*make)(const Problem& problem) = nullptr;
    /// Readings of luminance, and pictures.
    bool measures_luminance = true;
    /// Whether the variance is infinite in some scenes: then single contributions are watched.
    bool has_heavy_tails = false;
    /// Whether it always lights patches: then it is biased by their size.
    bool lights_patches = false;
    /// Whether chance has no part in it: Estimator::known_part() is then all there is, and the error unknown.
    bool is_deterministic = false;
    /// The names of what it goes by of PatchOptions: "patch", "first-shot" ...
    std::span<const std::string_view> patch_options = {};
};

std::span<const EstimatorEntry> estimator_list();

/// Those without patches (unless they are asked for), which all have the same expectations: the exact ones.
std::vector<EstimatorEntry> unbiased_estimators();

/// For messages.
std::vector<std::string_view> luminance_methods();

/// Throws InputError, with the nearest name, where there is no such method.
const EstimatorEntry& find_estimator(std::string_view name);

// The methods, each in the file of its name: estimator_list.cpp has one entry for each.

/// Local estimation balanced with path tracing, and as published: local/local_estimation.cpp.
std::unique_ptr<Estimator> make_auto(const Problem& problem);
std::unique_ptr<Estimator> make_local(const Problem& problem);
/// path/path.cpp
std::unique_ptr<Estimator> make_path(const Problem& problem);
/// patch_light/ray_bundle/ray_bundle.cpp
std::unique_ptr<Estimator> make_ray_bundle(const Problem& problem);
/// patch_light/radiosity/radiosity.cpp
std::unique_ptr<Estimator> make_radiosity(const Problem& problem);
/// patch_light/particles/particles.cpp
std::unique_ptr<Estimator> make_particles(const Problem& problem);

}  // namespace stilb::estimators
