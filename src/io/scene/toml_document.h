// A TOML file as a tree of plain values that know their lines. The only header of the TOML parser's wrapper.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace stilb::io {

struct TomlMember;
struct TomlValue;

using TomlArray = std::vector<TomlValue>;
/// In the order of the file.
using TomlMembers = std::vector<TomlMember>;
/// Dates and times, which no key takes.
struct TomlDate {};

struct TomlValue {
    std::variant<TomlDate, bool, std::int64_t, double, std::string, TomlArray, TomlMembers> content;
    std::size_t line = 0;
};

struct TomlMember {
    std::string key;
    std::size_t line = 0;  ///< of the key
    TomlValue value;
};

/// The top table of a TOML 1.0 text. Throws InputError for what is not TOML; `name` is used in messages.
TomlValue parse_toml(std::string_view text, const std::string& name);

}  // namespace stilb::io
