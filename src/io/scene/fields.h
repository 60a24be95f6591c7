// Reads the parameters of a material, a light or a sensor by the list that its type has of them.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "base/field.h"
#include "io/scene/toml.h"

namespace stilb::io {

inline void read_value(const TomlItem& item, const Range& range, double& value) {
    value = item.number(range);
}
inline void read_value(const TomlItem& item, const Range& range, Rgb& value) { value = item.rgb(range); }
template <std::size_t count>
void read_value(const TomlItem& item, const Range& range, std::array<double, count>& values) {
    const std::vector<double> numbers = item.numbers(count, range);
    std::copy(numbers.begin(), numbers.end(), values.begin());
}

/// The keys of a type's parameters.
template <typename Parameters>
std::vector<std::string_view> keys_of() {
    std::vector<std::string_view> keys;
    for_each_field<Parameters>([&](const auto& field) { keys.push_back(field.key); });
    return keys;
}

/// The parameters that the table's keys give; throws where one is missing or wrong. Does not look for keys
/// that are no parameters.
template <typename Parameters>
Parameters read_fields(const TomlTable& table) {
    Parameters parameters;
    for_each_field<Parameters>([&](const auto& field) {
        const bool is_required = field.presence == Presence::required;
        const auto item = is_required ? std::optional(table.at(field.key)) : table.find(field.key);
        if (item) read_value(*item, field.range, parameters.*field.member);
    });
    if (const auto message = contradiction_in(parameters)) table.fail(*message);
    return parameters;
}

/// The same of a table that has these keys and "type", which is `type`, and no others.
template <typename Parameters>
Parameters read_typed_fields(TomlTable& table, std::string_view type) {
    std::vector<std::string_view> keys = keys_of<Parameters>();
    keys.insert(keys.begin(), "type");
    table.expect_keys(keys, fmt::format("type \"{}\"", type));
    return read_fields<Parameters>(table);
}

}  // namespace stilb::io
