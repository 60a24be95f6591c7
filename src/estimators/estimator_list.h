// The one table of all estimators: --help, verify, the agreement tests and the scene reader go by it.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/patch_light/patch_options.h"
#include "estimators/picture_estimator.h"
#include "rays/ray_caster.h"
#include "sensors/sensor.h"

namespace stilb::estimators {

/// What every estimator is made from. The estimator keeps references to scene and caster, and copies the
/// measurands.
struct EstimatorInput {
    const Scene& scene;
    const rays::RayCaster& caster;
    std::span<const Measurand> measurands;
    int max_reflections;
    /// For decisions that are taken before sampling starts; independent of all batches' keys.
    math::RandomKey preparation_key;
    /// How much each point's relative variance matters beside the others'. Empty: all alike.
    std::span<const double> weights = {};
    /// For methods that light patches, and first shot.
    PatchOptions patches = {};
};

struct EstimatorEntry {
    std::string_view name;
    std::string_view summary;
    /// Whether the variance is infinite in some scenes: then single contributions are watched.
    bool has_heavy_tails;
    std::unique_ptr<Estimator> (*make)(const EstimatorInput& input);
    /// Null where the method does not measure luminance.
    std::unique_ptr<PictureEstimator> (*make_picture)(const PictureInput& input);
    /// Whether it always lights patches: then it is biased by their size.
    bool lights_patches = false;
    /// What of PatchOptions it goes by, as flags of the command line.
    std::span<const std::string_view> patch_flags = {};
    /// Whether chance has no part in it: Estimator::known_part() is then all there is, and the error unknown.
    bool is_deterministic = false;

    bool measures_luminance() const { return make_picture != nullptr; }
};

std::span<const EstimatorEntry> estimator_list();

/// Those without patches (unless they are asked for), which all have the same expectations: the exact ones.
std::vector<EstimatorEntry> unbiased_estimators();

/// For messages.
std::vector<std::string_view> luminance_methods();

/// Throws InputError, with the nearest name, where there is no such method.
const EstimatorEntry& find_estimator(std::string_view name);

}  // namespace stilb::estimators
