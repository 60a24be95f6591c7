// The table of all estimators, for --help, verify, the agreement tests and the scene reader.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "estimators/estimator.h"

namespace stilb::estimators {

class Estimator;
struct Problem;

/// One method. estimator.h describes its input and its result.
struct EstimatorEntry {
    std::string_view name;
    std::string_view summary;
    std::unique_ptr<Estimator> (*make)(const Problem& problem) = nullptr;
    /// Measures luminance and renders pictures.
    bool measures_luminance = true;
    /// Whether the variance is infinite in some scenes.
    bool has_heavy_tails = false;
    /// Whether the method always computes light on patches, which biases it by their size.
    bool lights_patches = false;
    /// The word for its samples in tables of readings, and what one of them is.
    std::string_view samples = "paths", sample;
    /// One of those from which `auto` chooses: to be forced, and not in short lists.
    bool is_technique = false;
    /// The names of the members of PatchOptions that it uses: "patch", "first-shot" ...
    std::span<const std::string_view> patch_options = {};
};

/// All methods, the techniques of `auto` at the end.
std::span<const EstimatorEntry> estimator_list();

/// What one sample of a picture is, of all methods.
inline constexpr std::string_view kPictureSample = "a ray through every pixel";

/// The methods without patches (unless requested), which all have the same expectation: the exact value.
/// Without the techniques of `auto`.
std::vector<EstimatorEntry> unbiased_estimators();

/// The names of the methods for luminance, for messages.
std::vector<std::string_view> luminance_methods();

/// Throws InputError, with the nearest name, where there is no such method.
const EstimatorEntry& find_estimator(std::string_view name);

// The constructors, each in the file of its method: estimator_list.cpp has one entry for each.

/// auto.cpp
std::unique_ptr<Estimator> make_auto(const Problem& problem);
/// Local estimation balanced with path tracing, and as published: local/local_estimation.cpp.
std::unique_ptr<Estimator> make_balanced(const Problem& problem);
/// The same by a guess of the light where reflections have no limit.
std::unique_ptr<Estimator> make_guided(const Problem& problem);
/// Makes what make_guided() does, for parts of a problem that share the guess of the whole.
using EstimatorMaker = std::function<std::unique_ptr<Estimator>(const Problem& part)>;
EstimatorMaker with_guess(const Problem& problem);
std::unique_ptr<Estimator> make_local(const Problem& problem);
std::unique_ptr<Estimator> make_double_local(const Problem& problem);
/// path/path.cpp
std::unique_ptr<Estimator> make_path(const Problem& problem);
/// patch_light/ray_bundle/ray_bundle.cpp
std::unique_ptr<Estimator> make_ray_bundle(const Problem& problem);
/// patch_light/radiosity/radiosity.cpp
std::unique_ptr<Estimator> make_radiosity(const Problem& problem);
/// patch_light/particles/particles.cpp
std::unique_ptr<Estimator> make_particles(const Problem& problem);

}  // namespace stilb::estimators
