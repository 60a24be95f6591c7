// Limitations of estimators, reported to the user as warnings or errors.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "estimators/patch_light/patch_options.h"
#include "scene/scene.h"

namespace stilb::estimators {

bool has_specular_surfaces(const Scene& scene);
/// Whether there may be light that path tracing cannot find: it leaves a point or photometry light and meets
/// a mirror or glass before anything else.
bool has_light_for_light_paths_only(const Scene& scene);

/// The number of light paths whose vertices are in memory at a time, `wanted` at most: fewer where surfaces
/// are so white that the paths have thousands of vertices.
std::uint64_t paths_at_once(const Scene& scene, std::uint64_t wanted);

/// Warnings of light that path tracing, solutions and local estimation leave out, where the scene has mirrors
/// or glass and point or photometry lights; empty elsewhere.
std::vector<std::string> path_warnings(const Scene& scene);
std::vector<std::string> solution_warnings(const Scene& scene);
std::vector<std::string> local_warnings(const Scene& scene);
/// For methods on patches, where the scene has mirrors or glass.
std::vector<std::string> patch_warnings(const Scene& scene, std::string_view method);

/// Throws InputError, with object and material, where a material is neither diffuse nor
/// black.
void require_diffuse(const Scene& scene, std::string_view method);
/// The same scene. Throws InputError, with object and material, where a material is composed: patches keep
/// the light that surfaces reflect.
const Scene& require_reflection_only(const Scene& scene);
/// Throws InputError where there are lights other than surfaces but no first shot: nothing else brings their
/// light to patches.
void require_first_shot_of_points(const Scene& scene, FirstShotVariant variant, std::string_view method);
/// Throws InputError where light comes from infinity.
void require_no_light_from_outside(const Scene& scene, std::string_view method);
/// Throws InputError where the number of reflections is limited.
void require_all_reflections(int max_reflections, std::string_view method);

}  // namespace stilb::estimators
