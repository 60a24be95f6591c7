// TOML as text.
#pragma once

#include <string>

#include "io/scene/toml.h"

namespace stilb::io {

/// A document whose top tables hold tables, as scene files do: [section.name] and keys below it. Numbers have
/// enough digits to read back the same double.
std::string to_toml(const TomlMembers& document);

// Values for such documents.

TomlValue toml_number(double number);
/// [x, y, z].
TomlValue toml_vector(const Vec3& vector);
/// One number where the bands are equal, else [r, g, b].
TomlValue toml_rgb(const Rgb& rgb);
TomlValue toml_text(std::string text);

}  // namespace stilb::io
