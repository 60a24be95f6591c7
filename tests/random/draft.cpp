#include "random/draft.h"

#include <algorithm>
#include <stdexcept>

namespace stilb::random {

TomlValue* Part::find(std::string_view key) {
    const auto found = std::ranges::find(keys, key, &io::TomlMember::key);
    return found == keys.end() ? nullptr : &found->value;
}

Part& Part::set(std::string_view key, TomlValue value) {
    if (TomlValue* const old = find(key))
        *old = std::move(value);
    else
        keys.push_back({std::string(key), 0, std::move(value)});
    return *this;
}

void Part::erase(std::string_view key) {
    std::erase_if(keys, [key](const io::TomlMember& member) { return member.key == key; });
}

std::string Part::text(std::string_view key) const {
    const TomlValue* const value = find(key);
    const auto* const content = value ? std::get_if<std::string>(&value->content) : nullptr;
    return content ? *content : "";
}

double Part::number(std::string_view key) const { return as_number(*find(key)); }

Vec3 Part::vector(std::string_view key) const { return as_vector(*find(key)); }

std::string Draft::new_name(std::string letter) { return std::move(letter) + std::to_string(++next_); }

Part& Draft::added(std::vector<Part>& parts, std::string letter, std::string_view key,
                   std::string_view type) {
    parts.push_back({new_name(std::move(letter)), {}});
    return parts.back().set(key, random::text(type));
}

Part& Draft::add_object(std::string_view shape, const std::string& material) {
    return added(objects, "o", "shape", shape).set("material", random::text(material));
}

const Part* Draft::object(std::string_view name) const {
    const auto found = std::ranges::find(objects, name, &Part::name);
    return found == objects.end() ? nullptr : &*found;
}

TomlMembers Draft::document() const {
    TomlMembers sections;
    const auto add = [&](const char* section, const std::vector<Part>& parts) {
        TomlMembers tables;
        for (const Part& part : parts) tables.push_back({part.name, 0, {part.keys}});
        if (!tables.empty()) sections.push_back({section, 0, {std::move(tables)}});
    };
    add("materials", materials);
    add("objects", objects);
    add("lights", lights);
    add("sensors", sensors);
    if (bounces) sections.push_back({"run", 0, {TomlMembers{{"bounces", 0, {std::int64_t{*bounces}}}}}});
    return sections;
}

TomlValue number(double value) { return io::toml_number(value); }

TomlValue vector(const Vec3& value) { return io::toml_vector(value); }

TomlValue vectors(const std::vector<Vec3>& values) {
    TomlArray array;
    for (const Vec3& value : values) array.push_back(vector(value));
    return {std::move(array)};
}

TomlValue text(std::string_view value) { return {std::string(value)}; }

TomlValue integers(const std::vector<std::size_t>& values) {
    TomlArray array(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) array[i].content = static_cast<std::int64_t>(values[i]);
    TomlValue value;
    value.content = std::move(array);
    return value;
}

TomlValue faces(const std::vector<std::vector<std::int64_t>>& corners) {
    TomlArray array;
    for (const auto& face : corners) {
        TomlArray indices(face.size());
        for (std::size_t i = 0; i < face.size(); ++i) indices[i].content = face[i];
        array.emplace_back().content = std::move(indices);
    }
    TomlValue value;
    value.content = std::move(array);
    return value;
}

double as_number(const TomlValue& value) {
    if (const auto* const whole = std::get_if<std::int64_t>(&value.content))
        return static_cast<double>(*whole);
    return std::get<double>(value.content);
}

Vec3 as_vector(const TomlValue& value) {
    const auto& array = std::get<TomlArray>(value.content);
    return {as_number(array[0]), as_number(array[1]), as_number(array[2])};
}

}  // namespace stilb::random
