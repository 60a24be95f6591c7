// Values given beside a scene file, which replace those in it or are added to them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/scene/toml.h"
#include "scene/light_groups.h"

namespace stilb::io {

/// Each override is a key and a value as in TOML, "materials.wall.reflectance = 0.4"; a value that is no TOML
/// is a text, so that "run.method=path" needs no quotes. Throws InputError, which names the override, where
/// it cannot be read, or a table on the way to its key is missing. Sections of the scene may be missing; then
/// the overrides make all of its tables.
void override_values(TomlMembers& document, std::span<const std::string> overrides);

/// Takes the factors of lights out of the overrides: those whose key has no dot, "lamp=0.4" or
/// "lamp=[1, 0.8, 0.5]". Throws InputError, which names the override, where the value is no number of 0 or
/// more, and no three of them.
std::vector<LightFactor> take_light_factors(std::vector<std::string>& overrides);

}  // namespace stilb::io
