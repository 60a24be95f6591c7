// TOML as text.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

#include "io/scene/toml.h"
#include "materials/shares_by_angle.h"

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
/// The value of a field.
template <typename Value>
TomlValue toml_value(const Value& value) {
    if constexpr (std::is_same_v<Value, bool>) {
        return {value};
    } else if constexpr (std::is_same_v<Value, materials::SharesByAngle>) {
        if (value.is_along_normal()) return toml_rgb(value.rows[0].share);
        TomlArray rows;
        for (const auto& [degrees, share] : value.rows)
            rows.push_back({TomlArray{toml_number(degrees), toml_rgb(share)}});
        return {std::move(rows)};
    } else if constexpr (std::is_integral_v<Value>) {
        return {static_cast<std::int64_t>(value)};
    } else if constexpr (std::is_same_v<Value, double>) {
        return toml_number(value);
    } else if constexpr (std::is_same_v<Value, Rgb>) {
        return toml_rgb(value);
    } else if constexpr (std::is_same_v<Value, Vec3>) {
        return toml_vector(value);
    } else if constexpr (std::is_same_v<Value, std::string>) {
        return toml_text(value);
    } else {
        TomlArray array;
        for (const auto& element : value) array.push_back(toml_value(element));
        return {std::move(array)};
    }
}

}  // namespace stilb::io
