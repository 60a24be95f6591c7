#include "io/scene/toml_document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <tuple>

#include "base/error.h"

namespace stilb::io {
namespace {

TomlValue converted(const toml::node& node);

TomlArray converted_array(const toml::array& array) {
    TomlArray result;
    result.reserve(array.size());
    for (const toml::node& element : array) result.push_back(converted(element));
    return result;
}

/// toml++ keeps a table sorted by its keys; the order of the file is in their positions.
TomlMembers converted_table(const toml::table& table) {
    std::vector<std::pair<const toml::key*, const toml::node*>> members;
    for (const auto& [key, node] : table) members.emplace_back(&key, &node);
    std::sort(members.begin(), members.end(), [](const auto& a, const auto& b) {
        const auto position = [](const auto& member) {
            const toml::source_position begin = member.first->source().begin;
            return std::tuple(begin.line, begin.column);
        };
        return position(a) < position(b);
    });
    TomlMembers result;
    result.reserve(members.size());
    for (const auto& [key, node] : members) {
        result.push_back({std::string(key->str()), key->source().begin.line, converted(*node)});
    }
    return result;
}

TomlValue converted(const toml::node& node) {
    TomlValue value;
    value.line = node.source().begin.line;
    if (const toml::table* table = node.as_table()) {
        value.content = converted_table(*table);
    } else if (const toml::array* array = node.as_array()) {
        value.content = converted_array(*array);
    } else if (const auto* text = node.as_string()) {
        value.content = text->get();
    } else if (const auto* integer = node.as_integer()) {
        value.content = integer->get();
    } else if (const auto* number = node.as_floating_point()) {
        value.content = number->get();
    } else if (const auto* truth = node.as_boolean()) {
        value.content = truth->get();
    }
    return value;
}

/// toml++ limits the nesting of brackets, but follows a.b.c... by recursion until the stack is full. Between
/// the dots of one key stands none of the separators.
void expect_shallow_keys(std::string_view text, const std::string& name) {
    constexpr int most_dots = 1000;
    constexpr std::string_view separators = "\n=,[]{}";
    std::size_t line = 1;
    int dots = 0;
    for (const char c : text) {
        if (c == '.' && ++dots > most_dots) {
            throw InputError(
                fmt::format("a key of more than {} parts. No key needs more than four.", most_dots),
                {name, line});
        }
        if (separators.find(c) != std::string_view::npos) dots = 0;
        if (c == '\n') ++line;
    }
}

}  // namespace

TomlValue parse_toml(std::string_view text, const std::string& name) {
    expect_shallow_keys(text, name);
    try {
        return converted(toml::parse(text));
    } catch (const toml::parse_error& error) {
        throw InputError(fmt::format("not valid TOML: {}", error.description()),
                         {name, error.source().begin.line});
    }
}

}  // namespace stilb::io
