// Values given beside a scene file, which replace those in it or are added to them.
#pragma once

#include <span>
#include <string>

#include "io/scene/toml.h"

namespace stilb::io {

/// Each override is a key and a value as in TOML, "materials.wall.reflectance = 0.4"; a value that is no TOML
/// is a text, so that "run.method=path" needs no quotes. Throws InputError, which names the override, where
/// it cannot be read, or a table on the way to its key is missing (sections of the scene may be missing).
void override_values(TomlMembers& document, std::span<const std::string> overrides);

}  // namespace stilb::io
