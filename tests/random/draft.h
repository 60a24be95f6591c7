// A scene file in parts, from which parts can be left out and whose keys can be changed.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "io/scene/toml.h"
#include "io/scene/toml_text.h"

namespace stilb::random {

using io::TomlArray;
using io::TomlMembers;
using io::TomlValue;

struct Part {
    std::string name;
    TomlMembers keys;

    TomlValue* find(std::string_view key);
    const TomlValue* find(std::string_view key) const { return const_cast<Part*>(this)->find(key); }
    /// Replaces the value, or adds the key.
    Part& set(std::string_view key, TomlValue value);
    void erase(std::string_view key);
    /// The text under the key; empty where there is none.
    std::string text(std::string_view key) const;
    /// The value under a key that is there.
    double number(std::string_view key) const;
    Vec3 vector(std::string_view key) const;
};

struct Draft {
    std::vector<Part> materials, objects, lights, sensors;
    std::optional<int> bounces;

    Part& add_material(std::string_view type) { return added(materials, "m", "type", type); }
    Part& add_object(std::string_view shape, const std::string& material);
    Part& add_light(std::string_view type) { return added(lights, "l", "type", type); }
    Part& add_sensor(std::string_view type) { return added(sensors, "s", "type", type); }
    const Part* object(std::string_view name) const;
    Part* object(std::string_view name) {
        return const_cast<Part*>(static_cast<const Draft*>(this)->object(name));
    }
    /// A name that no part has: the letter and a number.
    std::string new_name(std::string letter);

    TomlMembers document() const;
    std::string text() const { return io::to_toml(document()); }

  private:
    Part& added(std::vector<Part>& parts, std::string letter, std::string_view key, std::string_view type);

    std::size_t next_ = 0;
};

TomlValue number(double value);
TomlValue vector(const Vec3& value);
TomlValue vectors(const std::vector<Vec3>& values);
TomlValue text(std::string_view value);
TomlValue integers(const std::vector<std::size_t>& values);
/// Of polygons: indices of their corners.
TomlValue faces(const std::vector<std::vector<std::int64_t>>& corners);
double as_number(const TomlValue& value);
Vec3 as_vector(const TomlValue& value);

}  // namespace stilb::random
