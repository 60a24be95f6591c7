#include "io/scene/toml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace stilb::io {
namespace {

bool is_bare(std::string_view key) {
    return !key.empty() && std::ranges::all_of(key, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    });
}

std::string toml_quoted(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            result += '\\';
            result += c;
        } else if (byte < 0x20 || byte == 0x7f) {
            result += fmt::format("\\u{:04x}", byte);
        } else {
            result += c;
        }
    }
    return result + '"';
}

std::string key_text(std::string_view key) { return is_bare(key) ? std::string(key) : toml_quoted(key); }

/// A value on one line.
struct InlineText {
    std::string operator()(TomlDate) const { return "\"\""; }
    std::string operator()(bool truth) const { return truth ? "true" : "false"; }
    std::string operator()(std::int64_t integer) const { return fmt::format("{}", integer); }
    std::string operator()(double number) const { return fmt::format("{}", number); }
    std::string operator()(const std::string& text) const { return toml_quoted(text); }
    std::string operator()(const TomlArray& array) const {
        std::string text;
        for (const TomlValue& value : array)
            text += (text.empty() ? "" : ", ") + std::visit(*this, value.content);
        return "[" + text + "]";
    }
    std::string operator()(const TomlMembers& members) const {
        std::string text;
        for (const auto& [key, line, value] : members)
            text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key_text(key),
                                std::visit(*this, value.content));
        return "{ " + text + " }";
    }
    std::string operator()(const TomlVertices& vertices) const {
        std::string text;
        for (const auto& [x, y, z] : *vertices)
            text += fmt::format("{}[{}, {}, {}]", text.empty() ? "" : ", ", x, y, z);
        return "[" + text + "]";
    }
    std::string operator()(const TomlTriangles& triangles) const {
        std::string text;
        for (const auto& [a, b, c] : *triangles)
            text += fmt::format("{}[{}, {}, {}]", text.empty() ? "" : ", ", a, b, c);
        return "[" + text + "]";
    }
};

void append_keys(std::string& text, const TomlMembers& members) {
    for (const auto& [key, line, value] : members)
        text += fmt::format("{} = {}\n", key_text(key), std::visit(InlineText{}, value.content));
}

bool holds_tables(const TomlMembers& members) {
    return std::ranges::all_of(members, [](const TomlMember& member) {
        return std::holds_alternative<TomlMembers>(member.value.content);
    });
}

}  // namespace

std::string to_toml(const TomlMembers& document) {
    std::string text;
    for (const auto& [section, line, value] : document) {
        const auto& members = std::get<TomlMembers>(value.content);
        if (!holds_tables(members)) {
            text += fmt::format("\n[{}]\n", key_text(section));
            append_keys(text, members);
            continue;
        }
        for (const auto& [name, inner_line, table] : members) {
            text += fmt::format("\n[{}.{}]\n", key_text(section), key_text(name));
            append_keys(text, std::get<TomlMembers>(table.content));
        }
    }
    return text;
}

TomlValue toml_number(double number) { return {number + 0.0}; }  // no -0

TomlValue toml_vector(const Vec3& vector) {
    return {TomlArray{toml_number(vector.x), toml_number(vector.y), toml_number(vector.z)}};
}

TomlValue toml_rgb(const Rgb& rgb) {
    if (rgb.max() == rgb.min()) return toml_number(rgb.max());
    return toml_vector({rgb[0], rgb[1], rgb[2]});
}

TomlValue toml_text(std::string text) { return {std::move(text)}; }

}  // namespace stilb::io
